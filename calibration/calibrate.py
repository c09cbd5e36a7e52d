#!/usr/bin/env python3
"""How long the PS software takes on a Cortex-A9: makes the cost tables in data/profiles.

The kernels of sw/ are compiled for the chip and run under qemu-arm, whose plug-in counts what they
execute; natively they count their units of work. Least squares finds the instructions of a unit,
llvm-mca's pipeline model and a cache model the time of an instruction. See docs/calibration.md.
"""
import argparse
import datetime
import glob
import hashlib
import json
import os
import subprocess
import sys

import fit
import fit_thesis
import pipeline

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LIMIT_PERCENT = 1.0

# A miss of level 1 that hits level 2 stalls so many CPU cycles, one that goes to DDR so many ns
# (assumed: UG585 and the PL310's manual give latencies of the parts, not of the whole).
L2_HIT_CYCLES = 25
DDR_NS = 150.0

# Code around the kernels in the application, in instructions a frame (assumed).
GLUE = {"O0": 900, "O2": 300}

# What code that counts no work takes, as a multiple of what it does compiled with -O0: the mean of
# 33 small programs (0.04 to 0.9), for those who want -O2 (derived; docs/calibration.md).
CODE_SCALE = {"O2": 0.35}

# Units by kernel, as platform/chip/run/cost_profile.cpp; the unit that streams through memory comes
# first, those that matter least last. "call" is what does not depend on the input.
KERNELS = {
    "receive": ["words_received", "call"],
    "interrupt": ["interrupts"],
    "decode": ["packets_decoded", "boxes_decoded", "call"],
    "evaluation": ["corner_tests", "box_tests", "corners_inside", "blobs_evaluated",
                   "quadrant_tests", "score_evaluations", "quads_checked", "corners_freed",
                   "candidates", "call"],
    "identification": ["grid_samples", "dictionary_compares", "homographies", "cells", "rotations"],
    "pose": ["posit_iterations", "poses"],
    "corner_detection": ["corner_pixels", "corner_survivors", "corner_bright", "corner_points",
                         "corner_rows", "corners_found", "corner_frames"],
    "threshold": ["threshold_pixels", "threshold_frames"],
    "blob_check": ["blobs_checked", "hulls_tested", "quads_spanned"],
    "quad_fit": ["crossings", "level_pixels", "level_reads", "strips", "lens_steps", "side_fits",
                 "transitions", "points_refitted", "corners_met", "fit_passes", "quads_refined",
                 "quads_fitted"],
    "code_reading": ["code_cells", "code_turns", "code_parts", "code_compares", "codes_read"],
    "board_pose": ["marker_weighings", "markers_weighted", "pose_steps", "board_poses"],
    "pose_filter": ["poses_weighed", "poses_corrected", "poses_predicted", "tracks_begun"],
    "lit_fit": ["lit_crossings", "lit_level_pixels", "lit_level_reads", "lit_strips",
                "lens_bends", "lens_angles", "lens_radii", "lens_tangents", "lit_side_fits",
                "lit_transitions", "lit_refitted", "lit_passes", "lit_corners", "lit_fits"],
    "inner_edges": ["inner_pixels", "inner_strips", "inner_blurs", "inner_edges", "inner_cells"],
    "response": ["curves_made"],
    "outline": ["outline_looks", "outline_points", "outline_distances", "outline_samples",
                "outline_fitted", "outline_meets", "outline_covers", "outlines"],
    "packet_sum": ["words_summed", "packets_summed"],
    "local_blobs": ["local_pixels", "local_runs", "local_joins", "local_rows", "local_frames"],
    "blob_detection": ["blob_pixels", "blob_dark", "blob_runs", "blob_rows", "blob_label_checks",
                       "blob_rivals", "blob_labels", "blobs_ended", "blob_frames"],
}

# Units of other kernels that a kernel does, too: their costs are taken off before it is fitted.
BORROWED = {"code_reading": ["homographies"], "board_pose": ["homographies"]}
# Units that say what memory costs that a DMA engine wrote, with the kernel and its first unit.
COLD = {"grid_samples_dma": "identification", "crossings_dma": "quad_fit",
        "code_cells_dma": "code_reading"}

SOURCES = ["calibration/driver/%s.cpp" % n for n in
           ("detector", "devices", "kernels", "main", "optics", "scene")] + [
    os.path.relpath(path, ROOT) for path in sorted(glob.glob(os.path.join(ROOT, "sw/marker/*.cpp")))] + [
    "sw/apps/hybrid/burst_chain.cpp", "sw/apps/hybrid/pl_link.cpp"] + [
    "sw/drivers/%s.cpp" % n for n in ("axi_dma", "axi_gpio", "gic", "timers")]
INCLUDES = ["sw", "sw/hal/include", "sw/hal/compat/include", "vp/registers/include", "models/xilinx/axi_dma/registers",
            "models/xilinx/axi_gpio/registers", "models/ps/gic/registers", "models/pl/registers",
            "models/ps/global_timer/registers", "models/ps/private_timer/registers"]
# As cmake/MarkervpEigen.cmake.
EIGEN = ["-isystem", "/usr/include/eigen3", "-DEIGEN_DONT_VECTORIZE", "-DEIGEN_NO_DEBUG",
         "-DEIGEN_MPL2_ONLY"]
CHIP = ["arm-linux-gnueabihf-g++", "-marm", "-mcpu=cortex-a9", "-mfpu=neon-vfpv3",
        "-mfloat-abi=hard", "-static", "-DHAL_BARE_METAL", "-fno-exceptions", "-fno-rtti",
        "-Wno-psabi"]
LANGUAGE = ["-std=c++17", "-ffp-contract=off"]


def run(command, **options):
    return subprocess.run(command, cwd=ROOT, check=True, **options)


def measured_digest():
    """Of all that the measurements follow from: the preprocessed kernels, these scripts, the tools."""
    digest = hashlib.sha256()
    for source in SOURCES:
        digest.update(run(CHIP + LANGUAGE + ["-O2", "-E", "-P"] + ["-I" + i for i in INCLUDES] +
                          EIGEN + [source], capture_output=True).stdout)
    for own in sorted(glob.glob(os.path.join(ROOT, "calibration", "*.py"))) + [
            os.path.join(ROOT, "calibration", "plugin", "count.c")]:
        with open(own, "rb") as file:
            digest.update(file.read())
    for tool in ("g++", "arm-linux-gnueabihf-g++", "qemu-arm", "llvm-mca"):
        digest.update(run([tool, "--version"], capture_output=True).stdout)
    return digest.hexdigest()


class Tools:
    """What is built once: the plug-in, and the driver for this machine and for the chip."""

    def __init__(self, folder):
        self.folder = folder
        os.makedirs(folder, exist_ok=True)
        self.plugin = os.path.join(folder, "libcount.so")
        run(["gcc", "-O2", "-Wall", "-Wextra", "-shared", "-fPIC", "-fvisibility=hidden", "-o",
             self.plugin, "calibration/plugin/count.c"])
        self.driver = {"native": self.compile("native", ["g++", "-O2"])}
        for level in ("O0", "O2"):
            self.driver[level] = self.compile(level, CHIP + ["-" + level])

    def compile(self, name, command):
        program = os.path.join(self.folder, "driver-" + name)
        run(command + LANGUAGE + ["-Wall", "-Wextra", "-o", program] +
            ["-I" + i for i in INCLUDES] + EIGEN + SOURCES)
        return program

    def native(self, arguments):
        """Measurements in order: (kernel, checksum, counts by unit)."""
        text = run([self.driver["native"]] + arguments, capture_output=True, text=True).stdout
        found = []
        for line in text.splitlines():
            kernel, checksum, *units = line.split()
            found.append((kernel, checksum, {u.split("=")[0]: int(u.split("=")[1]) for u in units}))
        return found

    def counted(self, level, arguments, cache=False):
        """The same measurements on the chip: (kernel, checksum, counts, runs by block).

        With `cache` the counts have misses, without it there are blocks; also the blocks themselves.
        """
        counts, blocks = (os.path.join(self.folder, n) for n in ("counts.txt", "blocks.txt"))
        plugin = "%s,out=%s,%s" % (self.plugin, counts,
                                   "cache=on" if cache else "blocks=" + blocks)
        text = run(["qemu-arm", "-cpu", "cortex-a9", "-plugin", plugin, self.driver[level]] +
                   arguments, capture_output=True, text=True).stdout
        kernels = [line.split()[:2] for line in text.splitlines()]
        found = []
        with open(counts, encoding="ascii") as file:
            for (kernel, checksum), line in zip(kernels, file):
                words = line.split()
                runs = [word.split("=") for word in words[4:]]
                found.append((kernel, checksum, list(map(int, words[:4])),
                              {int(number): int(times) for number, times in runs}))
        if len(found) != len(kernels):
            sys.exit("calibrate: the plug-in saw %d measurements of %d" %
                     (len(found), len(kernels)))
        return found, {} if cache else pipeline.read_blocks(blocks)

    def both(self, level, arguments, cache=False):
        """By kernel: a list of (counts by unit, counts of the plug-in, runs by block); blocks."""
        found = {}
        there, blocks = self.counted(level, arguments, cache)
        for here, (kernel, checksum, counts, runs) in zip(self.native(arguments), there):
            if here[:2] != (kernel, checksum):
                sys.exit("calibrate: %s computed %s here and %s on the chip" %
                         (here[0], here[1], checksum))
            found.setdefault(kernel, []).append((dict(here[2], call=1), counts, runs))
        return found, blocks


def memory_costs(tools, level, images):
    """By kernel: misses of level 1 that hit level 2, and of level 2, for each of its first unit."""
    found, _ = tools.both(level, [str(images), "640", "480"], cache=True)
    costs = {}
    for kernel, samples in found.items():
        unit = KERNELS[kernel.replace("_cold", "")][0]
        units = sum(s[0].get(unit, 0) for s in samples)
        level1, level2 = (sum(s[1][i] for s in samples) for i in (2, 3))
        costs[kernel] = ((level1 - level2) / units, level2 / units)
    return costs


def borrowed(kernel, counts, kernels, what):
    """Instructions or cycles of the units that the kernel borrows."""
    return sum(counts.get(unit, 0) * entry["units"][unit][what]
               for unit in BORROWED.get(kernel, []) for entry in kernels.values()
               if unit in entry["units"])


def calibrate(tools, level, scenes, images):
    """The kernels of a cost table, and whether all fits are good enough."""
    samples, blocks = tools.both(level, [str(scenes)])
    cycles, unknown = pipeline.cycles_of_blocks(blocks)
    memory = memory_costs(tools, level, images)
    kernels, good, calls = {}, True, GLUE[level]
    print("-%s                leave one out: instructions     cycles     cycles per   misses a unit"
          % level)
    print("kernel                    mean %    max %    mean %    max %  instruction  level 1  level 2")
    for kernel, units in KERNELS.items():
        executed = [(counts, numbers[0] - borrowed(kernel, counts, kernels, "instructions"))
                    for counts, numbers, _ in samples[kernel]]
        taken = [(counts, sum(cycles[b] * n for b, n in runs.items()) -
                  borrowed(kernel, counts, kernels, "cycles"))
                 for counts, _, runs in samples[kernel]]
        errors = fit.leave_one_out(executed, units)
        errors_taken = fit.leave_one_out(taken, units)
        mean, worst = sum(errors) / len(errors), max(errors)
        mean_taken = sum(errors_taken) / len(errors_taken)
        cpi = sum(t for _, t in taken) / sum(t for _, t in executed)
        near, far = memory[kernel]
        print("%-22s %9.3f %8.3f %9.3f %8.3f %12.3f %8.4f %8.4f" %
              (kernel, mean, worst, mean_taken, max(errors_taken), cpi, near, far))
        good = good and max(mean, mean_taken) <= LIMIT_PERCENT
        instructions, time = fit.fit(executed, units), fit.fit(taken, units)
        calls += instructions.pop("call", 0)
        entry = {u: {"instructions": round(n, 3), "cycles": round(time[u], 3), "stall_ns": 0.0}
                 for u, n in instructions.items()}
        stream = entry[units[0]]
        stream["cycles"] = round(stream["cycles"] + near * L2_HIT_CYCLES, 3)
        stream["stall_ns"] = round(far * DDR_NS, 4)
        kernels[kernel] = {"source": "derived", "cycles_per_instruction": round(cpi, 4),
                           "leave_one_out_percent": {"mean": round(mean, 4), "max": round(worst, 4)},
                           "units": entry}
    if unknown:
        print("not modelled, a cycle each: " + ", ".join(sorted({u.split()[0] for u in unknown})))
    for unit, kernel in COLD.items():
        extra = max(0.0, memory[kernel + "_cold"][1] - memory[kernel][1])
        kernels[kernel]["units"][unit] = {
            "instructions": 0, "cycles": 0, "stall_ns": round(extra * DDR_NS, 4)}
    cpi = kernels["decode"]["cycles_per_instruction"]
    kernels["application"] = {"source": "assumed", "units": {"frames": {
        "instructions": round(calls, 1), "cycles": round(calls * cpi, 1), "stall_ns": 0.0}}}
    return kernels, good


def make_table(tools, level, scenes, images):
    """A cost table, from random scenes and images of full size, and whether its fits are good enough."""
    kernels, good = calibrate(tools, level, scenes, images)
    return {
        "version": 1,
        "profile": "a9-" + level,
        "optimisation": level,
        **({"code_scale": CODE_SCALE[level]} if level in CODE_SCALE else {}),
        "origin": "scripts/calibrate: instructions counted in code compiled for a Cortex-A9, "
                  "cycles by llvm-mca and a cache model; nothing fitted to the thesis",
        "date": datetime.date.today().isoformat(),
        "measured_digest": measured_digest(),
        "memory": {"l2_hit_cycles": L2_HIT_CYCLES, "ddr_ns": DDR_NS, "source": "assumed"},
        "kernels": kernels,
    }, good


def read_table(path):
    with open(path, encoding="ascii") as file:
        return json.load(file)


def stamp(path):
    table = read_table(path)
    members = [(name, value) for name, value in table.items() if name != "measured_digest"]
    at = [name for name, _ in members].index("date") + 1
    members.insert(at, ("measured_digest", measured_digest()))
    with open(path, "w", encoding="ascii") as file:
        json.dump(dict(members), file, indent=2)
        file.write("\n")


def differences(table, path):
    """Units whose instructions are not those of the table in the file."""
    known = read_table(path)["kernels"]
    return [unit for kernel, entry in table["kernels"].items()
            for unit, cost in entry["units"].items()
            if abs(cost["instructions"] - known[kernel]["units"][unit]["instructions"]) >
            0.001 * cost["instructions"] + 0.01]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scenes", type=int, default=24, help="random scenes (default: 24)")
    parser.add_argument("--build", default=os.path.join(ROOT, "build", "calibration"),
                        help="folder for what is built")
    parser.add_argument("--output", default=os.path.join(ROOT, "data", "profiles"),
                        help="folder of the tables")
    parser.add_argument("--check", action="store_true",
                        help="write nothing; fail if the tables are not those of the sources, "
                        "which are measured if they or the tools changed since")
    parser.add_argument("--anew", action="store_true", help="with --check: measure in any case")
    parser.add_argument("--stamp", action="store_true",
                        help="with --check: note in tables that hold what they were compared with, "
                        "so that the next check need not measure")
    parser.add_argument("--markervp", help="executable that runs the thesis' tests, to fit the "
                        "profile `thesis`; without it only the cost tables are made")
    arguments = parser.parse_args()
    tables = {level: os.path.join(arguments.output, "a9-%s.json" % level) for level in ("O0", "O2")}
    if arguments.check and not arguments.anew:
        known = {read_table(path).get("measured_digest") for path in tables.values()}
        if known == {measured_digest()}:
            print("calibrate: the kernels, these scripts and the tools are those of the tables")
            return
        print("calibrate: kernels, scripts or tools changed since the tables were made: measuring")
    tools = Tools(os.path.abspath(arguments.build))
    all_good, stale = True, []
    # What memory costs is not compared: one image shows that kernels compute the same with cold caches.
    images = 1 if arguments.check else 2
    for level, path in tables.items():
        table, good = make_table(tools, level, arguments.scenes, images)
        all_good = all_good and good
        if arguments.check:
            stale += ["%s -%s" % (unit, level) for unit in differences(table, path)]
            continue
        with open(path, "w", encoding="ascii") as file:
            json.dump(table, file, indent=2)
            file.write("\n")
    if not all_good:
        sys.exit("calibrate: a fit is worse than %g %%: a kernel does work that it does not count" %
                 LIMIT_PERCENT)
    if stale:
        sys.exit("calibrate: the kernels changed, run scripts/calibrate: " + ", ".join(stale))
    if arguments.stamp:
        for path in tables.values():
            stamp(path)
    if arguments.markervp and not arguments.check:
        fit_thesis.make_profile(arguments.markervp, arguments.output,
                                os.path.join(ROOT, "data", "published.csv"))


if __name__ == "__main__":
    main()
