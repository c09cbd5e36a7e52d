#!/usr/bin/env bash
# A sweep on a real Slurm of three nodes, of which one is lost in the middle, and a search: every point is computed once, and
# the results are those of the local engine, byte for byte.
#   slurm_test.sh MARKERVP
# Exit code 77: skipped, because Slurm is not installed or may not be started.
set -euo pipefail
markervp=$(realpath "$1")
here=$(dirname "$(realpath "$0")")

skip() { echo "SKIPPED: $1"; exit 77; }
for tool in slurmctld slurmd munged sbatch squeue scontrol; do
  command -v "$tool" >/dev/null || PATH=$PATH:/usr/sbin:/sbin command -v "$tool" >/dev/null \
    || skip "$tool is not installed (scripts/setup --test installs slurm-wlm and munge)"
done
[ "$(id -u)" -eq 0 ] || skip "starting a private Slurm needs root"
export PATH=$PATH:/usr/sbin:/sbin

work=$(mktemp -d /tmp/markervp_slurm_XXXXXX)
finish() {
  "$here/slurm_local.sh" stop "$work/slurm" || true
  sleep 1
  rm -rf "$work"
}
chmod 755 "$work"  # munge looks at all folders above its socket
trap finish EXIT
fail() { echo "FAILED: $1"; tail -n 20 "$work"/*.log "$work"/slurm/log/slurmctld.log 2>/dev/null; exit 1; }

port=$((20000 + $$ % 20000))
SLURM_CONF=$("$here/slurm_local.sh" start "$work/slurm" 3 "$port") || fail "Slurm does not start"
export SLURM_CONF
cd "$work"
cat >s.yaml <<'Y'
repeat: 10
parameters:
  ps.fclk_clk1.frequency: {start: 20 MHz, stop: 79 MHz, step: 1 MHz}
Y

"$markervp" sweep s.yaml --output local --keep-results >local.log 2>&1 || fail "the local sweep"
"$markervp" sweep s.yaml --output cluster --engine slurm --chunk 5 --keep-results >cluster.log 2>&1 &
sweep=$!
count() { find cluster/points -name '*.json' 2>/dev/null | wc -l; }
for _ in $(seq 600); do [ "$(count)" -ge 6 ] && break; sleep .1; done
[ "$(count)" -ge 6 ] || fail "no points arrive"
# The node is lost, with what ran on it.
kill -9 "$(cat slurm/run/slurmd.n1.pid)"
scontrol update NodeName=n1 State=DOWN Reason=test
wait "$sweep" || fail "the sweep on the cluster"

diff -r local/points cluster/points || fail "points differ from those of the local engine"
cmp local/sweep.csv cluster/sweep.csv || fail "sweep.csv differs"
# runs FOLDER COLUMNS: what the database says of who computed what.
runs() { sqlite3 "$1/sweep.sqlite" "select $2 from runs"; }
# each_once FOLDER POINTS
each_once() {
  local computed different
  computed=$(runs "$1" "count(*)")
  different=$(runs "$1" "count(distinct key)")
  [ "$different" = "$2" ] && [ "$computed" = "$2" ] || fail "$1: $computed computations of $different points, not $2"
}
each_once cluster 60
[ "$(grep -c '"key"' cluster/slurm/1/task-0.json)" = 5 ] || fail "a task reads other points than its own"
runs cluster engine | grep -q slurm || fail "nothing was computed on the cluster"
"$markervp" sweep s.yaml --output cluster --engine slurm >again.log 2>&1 || fail "the sweep again"
grep -q '0 computed now, 60 there before' again.log || fail "points were computed again"

# Without --chunk the first point says how many make a task: some run here, the rest on the cluster.
scontrol update NodeName=n1 State=RESUME || true
"$markervp" sweep s.yaml --limit 12 --output measured --engine slurm --keep-results >measured.log 2>&1 || fail "the sweep without --chunk"
each_once measured 12
for point in measured/points/*.json; do cmp "$point" "local/points/${point##*/}" || fail "points differ"; done
runs measured engine | grep -q local || fail "the first point was not measured here"
runs measured engine | grep -q slurm || fail "nothing but the first point was computed"

# The terminal is gone, the job continues: the same command waits for it.
"$markervp" sweep s.yaml --output left --engine slurm --chunk 10 --keep-results >left.log 2>&1 &
sweep=$!
for _ in $(seq 600); do [ -n "$(find left/points -name '*.json' 2>/dev/null)" ] && break; sleep .1; done
kill -9 "$sweep"
wait "$sweep" 2>/dev/null || true
"$markervp" sweep s.yaml --output left --engine slurm --chunk 10 --keep-results >attached.log 2>&1 || fail "the sweep that was left"
grep -q 'of an earlier call is still in the queue: waiting for it' attached.log || fail "the job was not found again"
[ "$(ls left/slurm | grep -c '^[0-9]*$')" = 1 ] || fail "the points were handed in again"
each_once left 60
diff -r local/points left/points || fail "points differ from those of the local engine"

# A search hands in a generation at a time, and finds what it finds here.
cat >search.yaml <<'Y'
parameters:
  ps.fclk_clk1.frequency: {start: 20 MHz, stop: 79 MHz, step: 1 MHz}
  ps.cpu_clk.frequency: {start: 200 MHz, stop: 650 MHz, step: 10 MHz}
objectives: [max summary.fps.mean, min power.total_w.nominal]
search: {points: 24, generation: 12}
Y
"$markervp" explore search.yaml --output found --keep-results >found.log 2>&1 || fail "the local search"
"$markervp" explore search.yaml --output searched --engine slurm --chunk 4 --keep-results >searched.log 2>&1 || fail "the search on the cluster"
grep -q 'The search looked at 24 of 2760 points' searched.log || fail "the search did not say what it looked at"
diff -r found/points searched/points || fail "the search on the cluster computed other points"
cmp found/sweep.csv searched/sweep.csv || fail "sweep.csv of the searches differs"
each_once searched 24
runs searched engine | grep -q slurm || fail "nothing of the search was computed on the cluster"

echo "60 points, each once, on $(runs cluster 'distinct host' | sort | tr '\n' ' ')"
