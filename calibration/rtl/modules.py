#!/usr/bin/env python3
"""What counts of Yosys are worth: public modules that Vivado has synthesised, too.

  modules.py MODULES.csv                    prints the comparison as tables
  modules.py --documented MODULES.csv DOC.md  ends with 1 where they are not in the document

LUT are those of Yosys, less the pairs that fit into one, and those that only let a signal through to a carry chain, and memory.
Instances of one routed design are judged by their sum, for Vivado moves logic across their boundaries. Every repository has one
vote. The bias is the geometric mean of ours over Vivado's; errors are what is left without it, with the bias of all repositories
and with that of the others.
"""

import csv
import math
import statistics
import sys

KINDS = {"LUT, pairs counted once": "lut", "LUT, each counted": "each", "FF": "ff", "block memories": "bram"}


class Module:
    def __init__(self, row):
        self.repository, self.name, self.scope = row["repository"], row["module"], row["scope"]
        self.vivado = {kind: float(row["vivado_lut" if kind == "each" else f"vivado_{kind}"]) for kind in KINDS.values()}
        each = int(row["lut"]) + int(row["through"]) + int(row["memory"])
        self.ours = {"lut": each - int(row["pairs"]), "each": each, "ff": int(row["ff"]), "bram": float(row["bram"])}


class Sum:
    """Of the instances of one design."""

    def __init__(self, modules):
        self.repository = modules[0].repository
        self.vivado = {kind: sum(m.vivado[kind] for m in modules) for kind in KINDS.values()}
        self.ours = {kind: sum(m.ours[kind] for m in modules) for kind in KINDS.values()}


def read_modules(path):
    with open(path, encoding="utf-8") as file:
        return [Module(row) for row in csv.DictReader(line for line in file if not line.startswith("#"))]


def judged(modules):
    """What is compared: modules whose boundaries are the same on both sides."""
    whole = [m for m in modules if m.scope != "instance"]
    designs = {m.repository: [] for m in modules if m.scope == "instance"}
    for m in modules:
        if m.scope == "instance":
            designs[m.repository].append(m)
    return whole + [Sum(group) for group in designs.values()]


class Errors:
    """Of one kind of primitive; modules that have none of it have no say."""

    def __init__(self, kind, parts):
        votes = {}
        for part in parts:
            if part.vivado[kind] > 0 and part.ours[kind] > 0:
                votes.setdefault(part.repository, []).append(math.log(part.ours[kind] / part.vivado[kind]))
        means = {name: statistics.mean(logs) for name, logs in votes.items()}
        self.repositories = len(means)
        self.bias = math.exp(statistics.mean(means.values()))

        def error(bias_of):
            return statistics.mean(statistics.mean(abs(math.exp(log - bias_of(name)) - 1) for log in logs) for name, logs in votes.items())

        self.mean = error(lambda name: statistics.mean(means.values()))
        self.left_out = None
        if len(means) > 2:
            self.left_out = error(lambda name: statistics.mean(mean for other, mean in means.items() if other != name))


def percent(share):
    return "–" if share is None else f"{100 * share:.0f} %"


def markdown(modules):
    lines = ["| Module | LUT, each | pairs once | LUT, Vivado | FF, ours | FF, Vivado | BRAM36, ours | Vivado |",
             "|---|---:|---:|---:|---:|---:|---:|---:|"]
    for m in modules:
        lines.append(f"| {m.repository} `{m.name}`, {m.scope} | {m.ours['each']} | {m.ours['lut']} | {m.vivado['lut']:g} | "
                     f"{m.ours['ff']} | {m.vivado['ff']:g} | {m.ours['bram']:g} | {m.vivado['bram']:g} |")
    parts = judged(modules)
    lines += ["", "| | Repositories | Bias | Mean error without it | bias of the others |", "|---|---:|---:|---:|---:|"]
    for name, kind in KINDS.items():
        e = Errors(kind, parts)
        lines.append(f"| {name} | {e.repositories} | {e.bias:.2f} | {percent(e.mean)} | {percent(e.left_out)} |")
    return "\n".join(lines)


def main(arguments):
    option = arguments[0] if arguments[:1] and arguments[0].startswith("--") else ""
    files = arguments[1:] if option else arguments
    if (option, len(files)) not in (("", 1), ("--documented", 2)):
        sys.exit(__doc__)
    table = markdown(read_modules(files[0]))
    if not option:
        print(table)
        return 0
    with open(files[1], encoding="utf-8") as file:
        if table in file.read():
            return 0
    print(f"{files[1]} is old: put what 'modules.py {files[0]}' prints into it", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
