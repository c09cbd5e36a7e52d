#!/usr/bin/env python3
"""How a sweep's folder of a million points bears being used: time and the largest memory of the commands that read it.

    large_store.py MARKERVP FILLER [POINTS [FOLDER]]

A sweep of that many points is begun and stopped. FILLER (bench_store_filler) gives the other points results made from one that was
computed, in a shard as the program writes it, a kilobyte of disk each; a folder that is named stays, and is taken as it is next time. Then
each command is measured, and the table of docs/exploration.md printed. Fails beyond a kilobyte and 0.1 ms a point.
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

STUDY = """
title: Clocks and buffers
parameters:
  ps.cpu_clk.frequency: {start: 200 MHz, stop: 699.5 MHz, step: 0.5 MHz}
  ps.fclk_clk1.frequency: {start: 20 MHz, stop: 69.5 MHz, step: 0.5 MHz}
  pl.blob_detection.label_count: [16, 32, 48, 64, 80, 96, 112, 128, 192, 255]
set: {clocks: exact}
objectives: [max summary.fps.mean, min power.total_w.nominal]
"""


def measured(*command):
    """Seconds, those of the processor, and the largest memory in MB."""
    begin = time.monotonic()
    with open(os.devnull, "w") as nothing:
        process = subprocess.Popen(list(map(str, command)), stdout=nothing)
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"{command} ended with {process.returncode}")
    return time.monotonic() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def begin(markervp, study, folder, points):
    process = subprocess.Popen([markervp, "sweep", study, "--output", folder, "--limit", str(points), "--keep-results"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None and not any(folder.glob("points/*.json")):
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    process.wait()


def main():
    markervp, filler = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
    points = int(sys.argv[3]) if len(sys.argv) > 3 else 1_000_000
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(sys.argv[4] if len(sys.argv) > 4 else temporary) / "sweep"
        study = folder.with_name("study.yaml")
        folder.parent.mkdir(parents=True, exist_ok=True)
        study.write_text(STUDY)
        if not folder.exists():
            begin(markervp, study, folder, points)
            subprocess.run([filler, folder], check=True)
        python = ("import markervp; print(max(markervp.read_sweep(" + repr(str(folder)) +
                  ").sql(\"select value from metrics where name = 'summary.fps.mean'\")))")
        os.environ["PYTHONPATH"] = str(pathlib.Path(__file__).parents[1] / "python")
        bad = False
        print("| Command | Time | Of the processor | Memory |\n|---|---:|---:|---:|")
        for name, command in [
                ("`sweep`, all points there", (markervp, "sweep", study, "--output", folder, "--limit", points)),
                ("`pareto`", (markervp, "pareto", folder)),
                ("`sensitivity`", (markervp, "sensitivity", folder)),
                ("`report`", (markervp, "report", folder)),
                ("Python: one figure of each point", (sys.executable, "-c", python))]:
            seconds, processor, megabytes = measured(*command)
            print(f"| {name} | {seconds:.1f} s | {processor:.1f} s | {megabytes:.0f} MB |", flush=True)
            bad = bad or megabytes > 200 + points / 1000 or processor > 20 + points / 10_000
        return bad


if __name__ == "__main__":
    sys.exit(main())
