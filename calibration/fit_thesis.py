"""The profile `thesis`: one factor for each kernel that the thesis measured, found from the named
published values. Everything else of chapter 5 is predicted with it."""
import csv
import datetime
import json
import os
import shutil
import subprocess
import tempfile

SQUARES = 15  # images of the increased-feature test (thesis 5.2.4)
SAMPLES = 36 * 8 * 8  # of a candidate at the canonical width of 60 px


def published(path):
    with open(path, encoding="utf-8", newline="") as file:
        return {row["id"]: float(row["value"]) for row in csv.DictReader(file) if row["value"]}


def frames(markervp, program, profile, folder):
    """The frames of the increased-feature test as result.json has them."""
    subprocess.run([markervp, "run", "squares", "--program", program, "--quiet", "--no-pictures",
                    "--output", folder, "--set", "profile=" + profile],
                   check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(folder, "result.json"), encoding="utf-8") as file:
        found = json.load(file)["frames"]
    if len(found) != SQUARES:
        raise RuntimeError("%s made %d frames of %d" % (program, len(found), SQUARES))
    return found


def stage(frame, name):
    """Duration in ms."""
    return frame["time_us"][name] / 1000


def mean(found, name):
    return sum(stage(f, name) for f in found) / len(found)


def constants(values, hybrid, ps_only):
    """The fitted constants. `hybrid` and `ps_only` are frames with the tables as they are."""

    def scale(kernel, name, target_ms, ids, note):
        return {"kernel": kernel, "scale": round(target_ms / mean(ps_only, name), 4),
                "published": ids, "note": note}

    # Without optimisation Eigen's layers of small functions are most of the time: that says nothing
    # of the thesis' code, so the table of -O2 stays as it is.
    pose = dict(scale("pose", "pose", values["pose.duration"] / 1000, ["pose.duration"],
                      "41.35 us, mean over 15 images"), optimisation="O0")
    # A share s of the frame is identification: i = s / (1 - s) of the rest, its pose scaled.
    share = values["identification.share.hybrid.first"] / 100
    rest = (stage(hybrid[0], "frame") - stage(hybrid[0], "identification") +
            (pose["scale"] - 1) * stage(hybrid[0], "pose"))
    whole = share / (1 - share) * rest
    cached = values["identification.speedup"] * whole
    return [
        scale("corner_detection", "corner_detection",
              values["corner.delta"] + values["corner.hybrid"] / 1000,
              ["corner.delta", "corner.hybrid"], "51.30 ms on the PS, mean over 15 images"),
        scale("threshold", "threshold", values["threshold.ps"], ["threshold.ps"],
              "10.34 ms, mean over 15 images"),
        scale("blob_detection", "blob_detection",
              values["blob.delta"] + values["blob.hybrid"] / 1000, ["blob.delta", "blob.hybrid"],
              "19.04 ms on the PS, mean over 15 images"),
        {"kernel": "identification",
         "scale": round(cached / stage(ps_only[0], "identification"), 4),
         "published": ["identification.share.hybrid.first", "identification.speedup"],
         "note": "12 % of the frame with one square; the mean of 3.24 ms depends on the order in "
                 "which squares are added, which is not published"},
        {"unit": "grid_samples_dma",
         "stall_ns": round(1e6 * (whole - cached) / SAMPLES, 3),
         "published": ["identification.speedup"],
         "note": "a binary image in an array takes 0.858 of the time of one that a DMA wrote"},
        pose,
    ]


def make_profile(markervp, tables, published_csv):
    """Writes thesis.json into the folder `tables`, where a9-O0.json and a9-O2.json are."""
    profile = {
        "version": 1,
        "profile": "thesis",
        "origin": "cost tables of code compiled for a Cortex-A9, scaled kernel by kernel to the "
                  "thesis' measurements named here; all others are predicted",
        "date": datetime.date.today().isoformat(),
        "tables": {"O0": "a9-O0", "O2": "a9-O2"},
        "fitted": [],
    }
    with tempfile.TemporaryDirectory() as folder:
        for table in ("a9-O0.json", "a9-O2.json"):
            shutil.copy(os.path.join(tables, table), folder)
        neutral = os.path.join(folder, "neutral.json")
        with open(neutral, "w", encoding="ascii") as file:
            json.dump(profile, file)
        hybrid, ps_only = (frames(markervp, program, neutral, os.path.join(folder, program))
                           for program in ("hybrid", "ps-only"))
    profile["fitted"] = constants(published(published_csv), hybrid, ps_only)
    for constant in profile["fitted"]:
        print("%-18s %9.4f   from %s" % (constant.get("kernel") or constant["unit"],
                                         constant.get("scale") or constant["stall_ns"],
                                         ", ".join(constant["published"])))
    with open(os.path.join(tables, "thesis.json"), "w", encoding="ascii") as file:
        json.dump(profile, file, indent=2)
        file.write("\n")
