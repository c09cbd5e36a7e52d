"""Plants bugs into the RTL that comes along, and lets `markervp rtl prove` look for each; then lets it prove the rules of our own streams.

  planted_bugs.py MARKERVP MODELS   prints a row a bug; 1 if fewer than 20 of the 24 are found, or a stream is not proved

The lists of the lock-step tests (tests/models/pl/rtl) are others: what a proof is worth shows on bugs that no stimulus was made for."""
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile

# In 60 s of the processor each. Those of the detectors may lie behind more rows of pixels than it comes through: lock-step has them.
NEEDED = 20

# IP, what is right, what is wrong. All lie in the file of the IP's name.
BUGS = [
    ("axi_threshold_bridge", "fifo_count < COUNT_BITS'(FIFO_DEPTH)", "fifo_count < COUNT_BITS'(FIFO_DEPTH - 1)"),
    ("axi_threshold_bridge", "if (free) begin", "if (free || !ena) begin"),
    ("axi_threshold_bridge", "if (offer) m_tdata", "if (offer || !m_tready) m_tdata"),
    ("axi_threshold_bridge", "if (arrives && !fits)", "if (arrives)"),
    ("axi_image_store", "(enabled && !ena_before)", "(enabled && ena_before)"),
    ("axi_image_store", "wire enabled = ena && !rst", "wire enabled = ena"),
    ("blob_detection", "flush <= (ena_before && !ena) || (flush && retires)", "flush <= (ena_before && !ena)"),
    ("blob_detection", "X_BITS'(3)};", "X_BITS'(2)};"),
    ("blob_stream", "takes = m_tready && !m_tvalid && !waits", "takes = m_tready && !waits"),
    ("blob_stream", "is_mixed = !opens && (mixed || begins)", "is_mixed = !opens && mixed"),
    ("camera", "frame_ena <= !rst && (takes || in_frame)", "frame_ena <= takes || in_frame"),
    ("camera", "column <= line_ends ? '0", "column <= line_ends && row != '0 ? '0"),
    ("clock_crossing", "32'(corner_lost) + 32'(blob_lost)", "32'(corner_lost || blob_lost)"),
    ("control_crossing", "second <= first;", "second <= {first[11:1], second[0] & first[0]};"),
    ("corner_detection", "rst ? 4'd0 : {whole_at", "rst ? {whole_at[2:0], 1'b0} : {whole_at"),
    ("corner_detection", "score(scores, 1, 1) > score(scores, 1, 0)", "score(scores, 1, 1) >= score(scores, 1, 0)"),
    ("feature_packaging", "PAIR_BITS'(PAIRS - 1) ? '0", "PAIR_BITS'(PAIRS) ? '0"),
    ("feature_packaging", "&& done && !ended && !corner_arrives && !blob_arrives", "&& done && !ended && !corner_arrives"),
    ("feature_packaging", "ended        <= done && (ended || show_end)", "ended        <= ended || show_end"),
    ("frame_status", "!idle || frame_ena)", "!idle)"),
    ("global_threshold", "wire reset = por || rst;", "wire reset = rst;"),
    ("global_threshold", "!pixel[7] && count > dark_count", "pixel < 8'd127 && count > dark_count"),
    ("pixel_stream", "count <= next_count;", "count <= closing && room ? count : next_count;"),
    ("sensor_input", "ena_before <= ena;", "ena_before <= ena && !running;"),
]
STREAMS = ["axi_threshold_bridge", "pixel_stream", "blob_stream"]


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def prove(markervp, arguments, folder):
    """Exit code, the line of the verdict, seconds of the processor."""
    begun = processor_seconds()
    done = subprocess.run([markervp, "rtl", "prove", *arguments, "-o", folder], capture_output=True, text=True)
    said = (done.stdout + done.stderr).splitlines()
    verdicts = [line for line in said if line.startswith(("markervp:", "PROVED", "EQUAL", "KEPT"))]
    return done.returncode, " ".join(verdicts)[:120], processor_seconds() - begun


def plant(models, folder, ip, right, wrong):
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(models / ip / "rtl", folder)
    shutil.copytree(models / "common/rtl", folder, dirs_exist_ok=True)
    file = folder / f"{ip}.sv"
    text = file.read_text(encoding="utf-8")
    if right not in text:
        sys.exit(f"{file} has no '{right}'")
    file.write_text(text.replace(right, wrong), encoding="utf-8")


def main(markervp, models):
    found = 0
    with tempfile.TemporaryDirectory() as scratch:
        rtl, out = pathlib.Path(scratch) / "rtl", str(pathlib.Path(scratch) / "out")
        for ip, right, wrong in BUGS:
            plant(models, rtl, ip, right, wrong)
            code, verdict, seconds = prove(markervp, [ip, "--rtl", str(rtl)], out)
            found += code == 1 and "DIFFERENT" in verdict
            print(f"{seconds:5.1f} s  {ip}: {wrong}\n         {verdict}", flush=True)
        print(f"found: {found} of {len(BUGS)}")
        kept = [prove(markervp, [ip], out) for ip in STREAMS]
        for ip, (code, verdict, seconds) in zip(STREAMS, kept):
            print(f"{seconds:5.1f} s  {ip}: {verdict}")
    return 0 if found >= NEEDED and all(code == 0 for code, _, _ in kept) else 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2])))
