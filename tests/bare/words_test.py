"""Reads the sources of the platform for words of the marker application: words_test.py SOURCE_TREE."""
import pathlib
import re
import sys

# Where no word of it may be: all of the platform but the application, and the pages of it.
WINGS = [f"platform/{wing}" for wing in "host facts trace fpga chip result study cli".split()]
WINGS += ["vp", "models/ps", "models/xilinx", "sw/hal", "sw/drivers", "web/src", "python"]
APPLICATION = ["web/src/marker", "sw/hal/bare_metal"]

WORDS = re.compile(r"marker|corner|blob|(?<![a-z])poses?(?![a-z])|scene|image|aruco", re.IGNORECASE)

# The same letters in other senses.
INNOCENT = re.compile(
    "|".join([
        r"markervp",
        r"image/(svg\+xml|png)|new Image\(\)|drawImage|toDataURL|new Blob|blob:|markLine|markPoint",  # of browsers and charts
        r"images? of (the|this|a) process|StaticImage|ProgramImage|program_image|image(_|\(\))|ELF image",
        r"--marker\b|add_option\(\"--marker\"|marker_ps|markerTime|named markers|(options|target)\.marker\b|output, marker, timescale|a line at a time",
        r"hypervolume.*corner|corner\b.*(reference|hypervolume|compute)|const corners = |corners\(event\)",
    ]),
    re.IGNORECASE)

# Lines that still have one, by file. The list may only become shorter.
LEFT = dict(line.split() for line in """
platform/fpga/power/power_table.cpp 2
platform/fpga/synthesis/synthesis.cpp 16
platform/chip/run/cost_profile.cpp 16
platform/chip/run/cost_profile.h 3
platform/cli/app.cpp 1
platform/cli/app_rtl.cpp 4
platform/cli/rtl_bench.cpp 25
platform/cli/rtl_bench.h 1
platform/cli/rtl_check_command.cpp 2
platform/cli/rtl_coverage.h 1
platform/cli/rtl_stimuli.cpp 2
platform/cli/rtl_stimuli.h 2
sw/hal/include/hal/hal.h 3
sw/drivers/platform_addresses.h 3
""".strip().splitlines())


def files(root):
    for wing in WINGS:
        for path in sorted((root / wing).rglob("*")):
            name = path.relative_to(root).as_posix()
            if path.suffix in (".h", ".cpp", ".c", ".js", ".css", ".py", ".S") and not any(name.startswith(a) for a in APPLICATION):
                yield name, path


def lines_with_words(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if WORDS.search(INNOCENT.sub("", line)):
            yield number, line.strip()


def problems(root):
    found, seen = [], 0
    for name, path in files(root):
        seen += 1
        lines = list(lines_with_words(path))
        allowed = int(LEFT.get(name, 0))
        if len(lines) > allowed:
            found += [f"{name}:{number}: {line}" for number, line in lines]
        elif len(lines) < allowed:
            found.append(f"{name}: {len(lines)} lines are left, not {allowed}: make its number smaller in {__file__}")
    found += [f"{name} is not there any more" for name in LEFT if not (root / name).exists()]
    if seen < 300:
        found.append(f"only {seen} files were read: the check looks at the wrong place")
    return found


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    if sys.argv[2:] == ["--list"]:
        for name, path in files(root):
            count = len(list(lines_with_words(path)))
            if count:
                print(name, count)
        sys.exit()
    assert WORDS.search("where the corner is") and WORDS.search("a pose") and not WORDS.search("dispose()")
    assert not WORDS.search(INNOCENT.sub("", "markervp run"))
    found = problems(root)
    print("\n".join(found) if found else "no word of the marker application in the platform, but for the lines that are listed")
    sys.exit(1 if found else 0)
