#!/usr/bin/env python3
"""Writes the counts of the last whole scripts/test into docs/testing.md: what ran, checked and is there to run.

  scripts/test && python3 scripts/test_counts.py [REPORT…]

REPORT: of programs that were run again since (ctest --output-junit), whose results count instead; the page says how many."""
import datetime
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

from testing_page import ROOT, put

REPORT = os.path.join(ROOT, "build", "release", "tests.xml")

# What a program of tests says at its end: test cases, assertions.
SAID = [
    (re.compile(r"(\d+) test cases? out of \d+ passed"), "cases"),
    (re.compile(r"(\d+) assertions? out of \d+ passed"), "assertions"),
    (re.compile(r"^(\d+) passed", re.MULTILINE), "cases"),  # pytest
    (re.compile(r"^# pass (\d+)", re.MULTILINE), "cases"),  # node
    (re.compile(r"^Ran (\d+) tests?", re.MULTILINE), "cases"),  # unittest
]
# Rooms of the tests, by the beginnings of their programs' names.
ROOMS = [
    ("models against exact times, and RTL in lock-step", ("pl_", "xilinx_", "ps_", "axi_", "board_", "appendix")),
    ("kernel of the platform: clocks, buses, waveforms", ("vp_",)),
    ("PS software, drivers, costs", ("sw_", "calibration_", "chip")),
    ("platform: designs, figures, studies, pages", ("platform_", "web_", "bare", "words")),
    ("whole runs from outside", ("integration_", "python_", "install", "slurm")),
    ("bad input, and what ends a run", ("negative", "fuzz")),
]


def cases_of(report):
    """By program."""
    return {case.get("name"): case for case in ElementTree.parse(report).getroot().iter("testcase")}


def counted(cases):
    """By room: programs, test cases, assertions, seconds; and the programs that did not pass."""
    rooms, bad = {}, []
    for name, case in cases.items():
        status = case.get("status")
        if status != "run":
            bad.append("%s (%s)" % (name, status))
        room = next((title for title, begins in ROOMS if name.startswith(begins)), "other")
        row = rooms.setdefault(room, {"programs": 0, "cases": 0, "assertions": 0, "seconds": 0.0})
        row["programs"] += 1
        row["seconds"] += float(case.get("time", 0))
        output = case.findtext("system-out") or ""
        for pattern, what in SAID:
            row[what] += sum(int(number) for number in pattern.findall(output))
    return rooms, bad


def lines(*patterns):
    files = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, check=True, capture_output=True,
                           text=True).stdout.split()
    total = 0
    for path in files:
        with open(os.path.join(ROOT, path), "rb") as file:
            total += file.read().count(b"\n")
    return total


def table(rooms):
    text = "| What | Programs | Test cases | Assertions | s |\n|---|---|---|---|---|\n"
    total = {"programs": 0, "cases": 0, "assertions": 0, "seconds": 0.0}
    for title in [title for title, _ in ROOMS] + ["other"]:
        if title not in rooms:
            continue
        row = rooms[title]
        for key in total:
            total[key] += row[key]
        text += "| %s | %d | %d | %d | %.0f |\n" % (title, row["programs"], row["cases"], row["assertions"],
                                                    row["seconds"])
    return text + "| all | %d | %d | %d | %.0f |\n" % (total["programs"], total["cases"],
                                                      total["assertions"], total["seconds"])


def main():
    if not os.path.exists(REPORT):
        sys.exit("test_counts: there is no %s: run scripts/test first" % os.path.relpath(REPORT, ROOT))
    again = {name: case for report in sys.argv[1:] for name, case in cases_of(report).items()}
    rooms, bad = counted({**cases_of(REPORT), **again})
    if bad:
        sys.exit("test_counts: the last run was not whole: " + ", ".join(bad))
    if sum(row["programs"] for row in rooms.values()) < 100:
        sys.exit("test_counts: the last run had few tests: run scripts/test without a selection")
    day = datetime.date.fromtimestamp(os.path.getmtime(REPORT)).isoformat()
    seeds = subprocess.run(["git", "ls-files", "tests/fuzz/corpus"], cwd=ROOT, check=True, capture_output=True,
                           text=True).stdout.split()
    repeated = ", %d of its programs run again after a mend" % len(again) if again else ""
    text = ("%s, of `scripts/test`%s; seconds are of programs side by side on one machine:\n\n%s\n"
            "%d lines of C++ in the product, %d in its tests; %d seeds of hostile files of %d kinds.\n" %
            (day, repeated, table(rooms),
             lines("platform/*.cpp", "platform/*.h", "vp/*.cpp", "vp/*.h", "models/*.cpp", "models/*.h",
                   "sw/*.cpp", "sw/*.h", "sw/*.c"),
             lines("tests/*.cpp", "tests/*.h"), len(seeds), len({path.split("/")[3] for path in seeds})))
    put("counts", "scripts/test_counts.py", text)


if __name__ == "__main__":
    main()
