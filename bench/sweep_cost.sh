#!/usr/bin/env bash
# What a sweep costs beside its runs, as processor time (user and system):
#   sweep     the whole of `markervp sweep --jobs 1 --no-report`: plan, all its processes, files, CSV, SQLite
#   with page the same without --no-report
#   peer      the same points in one process without a sweep, each from the platform's elaboration to its result.json (as
#             `markervp run --no-pictures --no-report` writes it, in memory's file system)
#   bare      the peer's runs without result.json: the result stays in memory and is dropped
# Each is the least of some rounds, since a busy host only ever adds.
#   sweep_cost.sh MARKERVP PEER [POINTS [ROUNDS]]
# Fails where the sweep costs half as much again as the peer: far above what docs/exploration.md names, so that a busy host
# passes.
set -euo pipefail
markervp=$(realpath "$1")
peer=$(realpath "$2")
points=${3:-1000}
rounds=${4:-3}
work=$(mktemp -d)
memory=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d)
trap 'rm -rf "$work" "$memory"' EXIT
cd "$work"
cat >points.yaml <<'Y'
parameters:
  ps.fclk_clk1.frequency: {start: 10 MHz, stop: 59.95 MHz, step: 0.05 MHz}
Y
TIMEFORMAT='%U %S'
# Seconds of the sweep with these options.
sweep() {
  { time "$markervp" sweep points.yaml --jobs 1 --limit "$points" "$@" >log 2>&1; } 2>&1 || { cat log >&2; exit 1; }
}
for round in $(seq "$rounds"); do
  sweep --no-report --output "sweep-$round" | awk '{ print "sweep", $1 + $2 }' >>seconds
  sweep --output "page-$round" | awk '{ print "page", $1 + $2 }' >>seconds
  "$peer" "sweep-$round" "$memory/run" | awk -v points="$points" '{ print "bare", $1 * points / 1000; print "peer", $2 * points / 1000 }' >>seconds
  computed=$(tail -n +2 "sweep-$round/sweep.csv" | wc -l)
  [ "$computed" = "$points" ] || { echo "$computed points computed, not $points"; exit 1; }
done
awk -v points="$points" '
  !($1 in least) || $2 < least[$1] { least[$1] = $2 }
  function over(what, base) { return sprintf("%+.0f %%", 100 * (least[what] / least[base] - 1)) }
  END {
    printf "%d points: sweep %.2f s, peer %.2f s: %s\n", points, least["sweep"], least["peer"], over("sweep", "peer")
    printf "against bare runs, %.2f s: %s; with the page, %.2f s: %s of the peer\n", least["bare"], over("sweep", "bare"), least["page"], over("page", "peer")
    exit least["sweep"] > 1.5 * least["peer"]
  }' seconds
