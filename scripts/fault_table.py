#!/usr/bin/env python3
"""Puts what came of campaigns of faults into docs/testing.md: a table a campaign, by class.

  scripts/fault_table.py FOLDER…   each the output of `markervp faults`"""
import json
import os
import sys

from testing_page import put

OUTCOMES = ["masked", "recovered", "reported", "unnoticed", "hang", "broken"]


def row(name, counts):
    def interval(outcome):
        low, high = counts["interval"][outcome]
        return "%.2f (%.2f to %.2f)" % (100 * counts[outcome] / counts["faults"], 100 * low, 100 * high)

    return "| %s | %d | %s | %s | %s |\n" % (name, counts["faults"], " | ".join(str(counts[one]) for one in OUTCOMES),
                                            interval("unnoticed"), interval("hang"))


def table(folder):
    with open(os.path.join(folder, "faults.json"), encoding="utf-8") as file:
        campaign = json.load(file)
    known = campaign["known"]
    text = "**%s**, %d units in %.3f ms; seed %d; %d faults simulated, %d without effect by the record of a run, %d twins:\n\n" % (
        os.path.basename(os.path.normpath(folder)), campaign["units"], campaign["end_us"] / 1000, campaign["seed"], known["run"], known["record"],
        known["twin"])
    text += "| Class | Faults | %s | %% unnoticed | %% hang |\n|---|%s\n" % (" | ".join(OUTCOMES),
                                                                       "---|" * (len(OUTCOMES) + 3))
    for name, counts in sorted(campaign["classes"].items()):
        text += row(name, counts)
    return text + row("all", campaign["all"])


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    put("campaigns", "scripts/fault_table.py FOLDER…", "\n".join(table(folder) for folder in sys.argv[1:]))


if __name__ == "__main__":
    main()
