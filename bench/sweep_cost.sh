#!/usr/bin/env bash
# What a sweep costs beside its runs, as processor time: that of the whole sweep, its children's included, against that of
# the runs alone, each measured in its own process from the platform's elaboration to its result.json.
#   sweep_cost.sh MARKERVP [POINTS]
# Fails where the sweep costs as much again as the runs: far above what docs/exploration.md names, so that a busy host passes.
set -euo pipefail
markervp=$(realpath "$1")
points=${2:-1000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >points.yaml <<'Y'
parameters:
  ps.fclk_clk1.frequency: {start: 10 MHz, stop: 59.95 MHz, step: 0.05 MHz}
Y
TIMEFORMAT='%U %S'
all=$( { time "$markervp" sweep points.yaml --jobs 1 --limit "$points" --output sweep >log 2>&1; } 2>&1 ) || { cat log; exit 1; }
cat sweep/runs/*.jsonl | sed 's/.*"cpu_s":\([0-9.e-]*\).*/\1/' | awk -v all="$all" -v points="$points" '
  { runs += $1 }
  END {
    split(all, parts, " ")
    sweep = parts[1] + parts[2]
    if (NR != points) { printf "%d points computed, not %d\n", NR, points; exit 1 }
    printf "%d points: %.2f s, of which %.2f s in the runs: the sweep adds %.0f %%, %.2f ms a point\n",
      points, sweep, runs, 100 * (sweep / runs - 1), 1000 * (sweep - runs) / points
    exit sweep > 2 * runs
  }'
