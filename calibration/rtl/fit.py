#!/usr/bin/env python3
"""How long nets are on a routed 7-series chip: the model of data/rtl/xc7.json from public timing reports.

  fit.py PATHS.csv                     prints the model, its band and its errors
  fit.py --check PATHS.csv MODEL.json  the same, and ends with 1 where the file says otherwise
  fit.py --markdown PATHS.csv          the errors as a table
  fit.py --figures FIGURES.json        what `markervp rtl synth` found, as a table
  fit.py --documented PATHS.csv FIGURES.json DOC.md  ends with 1 where one of the two is not in the document

A path's nets take, in ns:

  per_net * n + fan_out * (cube root of the largest fan-out - 1) + slack * min(2 n, requested period - cells)

n counts the nets that leave a slice. The loads of a net with a large fan-out are spread over an area. And nets that need not
be short are not: the third term is the time that the requested clock leaves to them, at most 2 ns each. At the highest clock they
take what the cells leave. Designs that ask for such a clock are worse than that: `tight` is how much longer their data paths are, the
median of the repositories. It moves what is most likely; the ends of the band hold without it. Cells are those of the report: synthesis knows them. Every repository has one vote. Errors are those on repositories that were left out, and the band
for them comes from yet others.
"""

import csv
import json
import math
import os
import statistics
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from fit import solve  # noqa: E402

MOST_SLACK_NS = 2  # of a net; from 1.5 to 4 the errors are the same within 0.5 %
TIGHT = 1.25  # requested period over data path, up to which a clock leaves nothing to spare
BAND = (0.05, 0.95)  # quantiles of true over predicted data path
PLACES = 3  # digits after the point
NUMBERS = ("speed_grade", "levels", "cells_ns", "nets_ns", "requested_ns", "fan_out", "nets", "skew_ns", "uncertainty_ns")


class Path:
    def __init__(self, row):
        self.repository, self.fabric = row["repository"], row["fabric"]
        for key in NUMBERS:
            setattr(self, key, float(row[key]))
        self.data_ns = self.cells_ns + self.nets_ns


def read_paths(path):
    with open(path, encoding="utf-8") as file:
        return [Path(row) for row in csv.DictReader(line for line in file if not line.startswith("#"))]


def groups(paths):
    """Of each repository its paths."""
    found = {}
    for p in paths:
        found.setdefault(p.repository, []).append(p)
    return found


# ---- models: what the nets of a path take is linear in these


def constant_share(p):
    return (p.cells_ns,)


def two_terms(p):
    return (1, p.nets)


def three_terms(p):
    return (1, p.nets, math.log2(max(1, p.fan_out)))


def chosen(p):
    nets = max(1, p.nets)
    slack = min(MOST_SLACK_NS * nets, max(0, p.requested_ns - p.cells_ns))
    return (nets, p.fan_out ** (1 / 3) - 1 if p.fan_out > 0 else 0, slack)


def predicted(model, coefficients, p):
    return p.cells_ns + sum(c * x for c, x in zip(coefficients, model(p)))


class Fit:
    """Least squares of errors relative to the data path. What one repository adds can be taken out again."""

    def __init__(self, model, paths):
        self.model = model
        self.parts = {}
        for name, group in groups(paths).items():
            size = len(model(group[0]))
            matrix, right = [[0.0] * size for _ in range(size)], [0.0] * size
            for p in group:
                x, weight = model(p), 1 / (len(group) * p.data_ns ** 2)
                for i in range(size):
                    right[i] += weight * x[i] * p.nets_ns
                    for j in range(size):
                        matrix[i][j] += weight * x[i] * x[j]
            self.parts[name] = (matrix, right)

    def without(self, *names):
        """The coefficients fitted to all repositories but these."""
        kept = [part for name, part in self.parts.items() if name not in names]
        size = len(kept[0][1])
        matrix = [[sum(m[i][j] for m, _ in kept) for j in range(size)] for i in range(size)]
        return solve(matrix, [sum(r[i] for _, r in kept) for i in range(size)])


def quantile(votes, share):
    """Of pairs of a value and its weight."""
    ordered, total = sorted(votes), 0
    for value, weight in ordered:
        total += weight
        if total >= share * sum(w for _, w in ordered):
            return value
    return ordered[-1][0]


def ratios(model, coefficients, group):
    """True over predicted, of one repository's paths; its one vote is shared among them."""
    return [(p.data_ns / predicted(model, coefficients, p), 1 / len(group)) for p in group]


def band(fit, by_name, *hidden):
    """Of repositories that were left out one after the other; `hidden` ones have no say in it."""
    votes = []
    for name, group in by_name.items():
        if name not in hidden:
            votes += ratios(fit.model, fit.without(name, *hidden), group)
    return tuple(quantile(votes, share) for share in BAND)


def at_highest_clock(coefficients, p):
    """The data path where the clock leaves no other: PathTiming::fmax()."""
    per_net, fan_out, share = coefficients
    nets = max(1, p.nets)
    base = per_net * nets + fan_out * (max(1, p.fan_out) ** (1 / 3) - 1)
    return p.cells_ns + min(base / (1 - share), base + share * MOST_SLACK_NS * nets)


def is_tight(p):
    return p.requested_ns <= TIGHT * p.data_ns


def tight(fit, by_name, *hidden):
    """How much longer data paths are than at_highest_clock() says, where a clock leaves nothing."""
    votes = []
    for name, group in by_name.items():
        found = [p.data_ns / at_highest_clock(fit.without(name, *hidden), p) for p in group if is_tight(p)]
        if found and name not in hidden:
            votes.append(statistics.median(found))
    return statistics.median(votes) if votes else 1.0


class HighestClock:
    """What Fmax is worth: data paths as they were routed, of repositories that neither coefficients nor `tight` saw."""

    def __init__(self, name, paths, corrected):
        fit, by_name = Fit(chosen, paths), groups(paths)
        self.name, of_each, inside = name, [], []
        for repository, group in by_name.items():
            low, high = band(fit, by_name, repository)
            factor = tight(fit, by_name, repository) if corrected else 1
            said = [(at_highest_clock(fit.without(repository), p), p) for p in group]
            of_each.append([abs(factor * ns / p.data_ns - 1) for ns, p in said])
            inside.append([low <= p.data_ns / ns <= high for ns, p in said])
        self.repositories, self.paths = len(of_each), sum(map(len, of_each))
        self.mean = statistics.mean(statistics.mean(e) for e in of_each)
        self.mean_path = statistics.mean(e for group in of_each for e in group)
        self.coverage = statistics.mean(statistics.mean(i) for i in inside)
        self.coverage_path = statistics.mean(i for group in inside for i in group)


class Errors:
    """Of a model on paths of repositories that it never saw."""

    def __init__(self, name, model, fitted, judged):
        fit, by_name = Fit(model, fitted), groups(fitted)
        self.name, self.paths = name, len(judged)
        of_each, inside = [], []
        for repository, group in groups(judged).items():
            coefficients = fit.without(repository)
            low, high = band(fit, by_name, repository)
            of_each.append([abs(predicted(model, coefficients, p) / p.data_ns - 1) for p in group])
            inside.append([low <= ratio <= high for ratio, _ in ratios(model, coefficients, group)])
        self.repositories = len(of_each)
        self.mean = statistics.mean(statistics.mean(e) for e in of_each)
        self.mean_path = statistics.mean(e for group in of_each for e in group)
        self.coverage = statistics.mean(statistics.mean(i) for i in inside)
        self.coverage_path = statistics.mean(i for group in inside for i in group)


def in_scope(p):
    """What the chips of a Zynq 7010 and 7020 of speed grade -1 are made of, and more than one cell between the registers."""
    return p.fabric == "artix" and p.speed_grade == -1 and p.levels >= 2


def cross_validate(paths):
    scope = [p for p in paths if in_scope(p)]
    others = [("one level or none", lambda p: p.fabric == "artix" and p.speed_grade == -1 and p.levels < 2),
              ("speed grades -2 and -3, all fabrics", lambda p: p.speed_grade < -1 and p.levels >= 2)]
    return [Errors("two levels and more, this model", chosen, scope, scope),
            Errors("the same, a constant share of cells", constant_share, scope, scope),
            Errors("the same, a constant and n", two_terms, scope, scope),
            Errors("the same, a constant, n and log2(fan-out)", three_terms, scope, scope),
            HighestClock("the same, Fmax without `tight`", scope, False),
            HighestClock("the same, Fmax", scope, True),
            *(Errors(f"{name}, this model", chosen, scope, [p for p in paths if wanted(p)]) for name, wanted in others)]


def fitted_model(paths):
    scope = [p for p in paths if in_scope(p)]
    fit, by_name = Fit(chosen, scope), groups(scope)
    low, high = band(fit, by_name)

    def vote(value):
        return statistics.median(statistics.median(map(value, group)) for group in by_name.values())

    values = dict(zip(("per_net_ns", "fan_out_ns", "slack_share"), fit.without()))
    values.update(most_slack_ns=MOST_SLACK_NS, tight=tight(fit, by_name), low=low, high=high, skew_ns=vote(lambda p: p.skew_ns),
                  uncertainty_ns=vote(lambda p: p.uncertainty_ns))
    return {name: round(value, PLACES) for name, value in values.items()}


def markdown(errors):
    lines = ["| Paths, model | Paths | Repositories | Mean error | of paths | Within the band | of paths |",
             "|---|---:|---:|---:|---:|---:|---:|"]
    for e in errors:
        lines.append(f"| {e.name} | {e.paths} | {e.repositories} | {100 * e.mean:.1f} % | {100 * e.mean_path:.1f} % | "
                     f"{100 * e.coverage:.0f} % | {100 * e.coverage_path:.0f} % |")
    return "\n".join(lines)


def figures_markdown(path):
    with open(path, encoding="utf-8") as file:
        entries = json.load(file)["entries"]
    lines = ["| IP | LUT | pairs | as memory | to let through | FF | CARRY4 | RAMB18 | RAMB36 | DSP | Longest path | Fmax, MHz |",
             "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|---:|"]
    for e in entries:
        parameters = "".join(f" {name}={value}" for name, value in e["parameters"].items())
        where, fmax = "none from register to register", ""
        if "longest_path" in e:
            p, f = e["longest_path"], e["fmax_mhz"]
            where = f"{p['levels']} cells of {p['cells_ns']:.2f} ns, {p['nets']} nets, fan-out {p['fan_out']}"
            fmax = f"{f['nominal']:.0f} ({f['low']:.0f} to {f['high']:.0f})"
            if "limited_by" in e:
                fmax = f"{f['nominal']:.0f}, the limit of the {e['limited_by']}"
        counts = (e["lut"], e["lut_pairs"] or "–", e["lut_memory"] or "–", e["lut_through"] or "–", e["ff"], e["carry4"], e["ramb18"] or "–", e["ramb36"] or "–",
                  e["dsp"] or "–")
        lines.append(f"| `{e['ip']}`{parameters} | {' | '.join(map(str, counts))} | {where} | {fmax} |")
    return "\n".join(lines)


def main(arguments):
    option = arguments[0] if arguments[:1] and arguments[0].startswith("--") else ""
    files = arguments[1:] if option else arguments
    if (option, len(files)) not in (("", 1), ("--check", 2), ("--markdown", 1), ("--figures", 1), ("--documented", 3)):
        sys.exit(__doc__)
    if option == "--figures":
        print(figures_markdown(files[0]))
        return 0
    paths = read_paths(files[0])
    if option in ("--markdown", "--documented"):
        table = markdown(cross_validate(paths))
        if option == "--markdown":
            print(table)
            return 0
        with open(files[2], encoding="utf-8") as file:
            text = file.read()
        if table in text and figures_markdown(files[1]) in text:
            return 0
        print(f"{files[2]} is old: put what 'fit.py --markdown' and '--figures' print into it", file=sys.stderr)
        return 1
    model = fitted_model(paths)
    for name, value in model.items():
        print(f"{name:<15} {value:>8g}")
    if option != "--check":
        print(markdown(cross_validate(paths)))
        return 0
    with open(files[1], encoding="utf-8") as file:
        said = json.load(file)["nets"]
    wrong = [name for name, value in model.items() if said.get(name) != value]
    for name in wrong:
        print(f"{files[1]}: '{name}' is {said.get(name)}, the reports give {model[name]}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
