#!/usr/bin/env python3
"""How much of a front `markervp explore` finds, beside random and Sobol samples of as many points.

    bench/search_quality.py build/release/bin/markervp FOLDER [SPACE.yaml...]

computes every point of each space of bench/spaces (about 10^5 points, some minutes on two cores; it can be stopped and resumed), then
lets ten searches, ten Sobol and ten random samples use at most 2 % of the points, and compares the hypervolumes of the feasible points:
the part that they dominate of the box between the best and the worst feasible figures, a tenth wider at the worst end. Prints a
table in Markdown. The hypervolume is not computed by the library that the search uses.
"""
import argparse
import csv
import pathlib
import statistics
import subprocess
import sys


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def run(markervp, arguments):
    done = subprocess.run([markervp, *arguments], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 4):  # 4: some points cannot be built
        sys.exit(done.stderr)


def objectives_of(space):
    """[(metric, -1 for max or 1 for min)] of a study whose objectives stand in one line."""
    line = next(l for l in space.read_text(encoding="utf-8").splitlines() if l.startswith("objectives:"))
    parts = [part.strip() for part in line.split("[", 1)[1].rstrip("]").split(",")]
    return [(part[4:], -1 if part.startswith("max") else 1) for part in parts]


def area(points, corner):
    """What points dominate of the rectangle up to `corner`, in two dimensions."""
    total, low = 0.0, corner[1]
    for x, y in sorted(points):
        if x < corner[0] and y < low:
            total += (corner[0] - x) * (low - y)
            low = y
    return total


def hypervolume(points, reference=1.1):
    """Of points of two or three costs."""
    points = list(set(points))
    if not points:
        return 0.0
    if len(points[0]) == 2:
        return area(points, (reference, reference))
    levels = sorted({p[2] for p in points if p[2] < reference})
    volume = 0.0
    for low, high in zip(levels, levels[1:] + [reference]):
        volume += (high - low) * area([p[:2] for p in points if p[2] <= low], (reference, reference))
    return volume


def not_dominated(points):
    front = []
    for point in sorted(set(points)):
        if not any(all(a <= b for a, b in zip(other, point)) for other in front):
            front.append(point)
    return front


class Whole:
    """A space that was computed whole."""

    def __init__(self, markervp, space, folder, share):
        self.markervp, self.space, self.folder = markervp, space, folder
        table = folder / "whole.csv"
        if not table.exists():
            run(markervp, ["sweep", str(space), "--yes", "--no-report", "--output", str(folder)])
            (folder / "sweep.csv").rename(table)
        objectives = objectives_of(space)
        rows = rows_of(table)
        costs = {row["key"]: tuple(sign * float(row[metric]) for metric, sign in objectives)
                 for row in rows if row["feasible"] == "yes"}
        low = [min(column) for column in zip(*costs.values())]
        high = [max(column) for column in zip(*costs.values())]
        self.costs = {key: tuple((c - a) / (b - a) if b > a else 0.0 for c, a, b in zip(cost, low, high))
                      for key, cost in costs.items()}
        self.points, self.feasible = len(rows), len(costs)
        self.most = int(self.points * share / 100)
        front = not_dominated(self.costs.values())
        self.front, self.hypervolume = len(front), hypervolume(front)

    def share(self):
        """Of the whole hypervolume, in percent, what the points of the last command have; and how many they are."""
        keys = [row["key"] for row in rows_of(self.folder / "points.csv")]
        found = [self.costs[key] for key in keys if key in self.costs]
        return 100 * hypervolume(not_dominated(found)) / self.hypervolume, len(keys)

    def searched(self, seed):
        run(self.markervp, ["explore", str(self.space), "--points", str(self.most), "--seed", str(seed), "--no-report",
                            "--output", str(self.folder)])
        return self.share()

    def sampled(self, method, seed):
        study = self.folder / f"{method}.yaml"
        first = seed if method == "random" else seed * self.most  # of Sobol's sequence
        study.write_text(self.space.read_text(encoding="utf-8") +
                         f"sample: {{method: {method}, points: {self.most}, seed: {first}}}\n", encoding="utf-8")
        run(self.markervp, ["sweep", str(study), "--no-report", "--output", str(self.folder)])
        return self.share()


def summary(found):
    shares = [share for share, _ in found]
    return f"{statistics.median(shares):.2f} % ({min(shares):.2f} %)"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("markervp")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("spaces", nargs="*", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--share", type=float, default=2, help="percent of the points")
    options = parser.parse_args()
    spaces = options.spaces or sorted(pathlib.Path(__file__).with_name("spaces").glob("*.yaml"))
    print("| Space | Points, feasible | Front | Looked at | Search: median (least) | Sobol | Random |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    for space in spaces:
        whole = Whole(options.markervp, space, options.folder / space.stem, options.share)
        seeds = range(1, options.seeds + 1)
        search = [whole.searched(seed) for seed in seeds]
        sobol = [whole.sampled("sobol", seed) for seed in seeds]
        drawn = [whole.sampled("random", seed) for seed in seeds]
        looked_at = statistics.median(count for _, count in search)
        print(f"| {space.stem} | {whole.points}, {whole.feasible} | {whole.front} | {looked_at:.0f} "
              f"({100 * looked_at / whole.points:.2f} %) | {summary(search)} | {summary(sobol)} | {summary(drawn)} |",
              flush=True)


if __name__ == "__main__":
    main()
