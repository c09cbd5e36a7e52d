"""Cycles per instruction of executed blocks, from llvm-mca's model of the Cortex-A9's pipelines."""
import re
import subprocess

ITERATIONS = 100
CONDITIONS = ("", "eq", "ne", "cs", "hs", "cc", "lo", "mi", "pl", "vs", "vc", "hi", "ls", "ge", "lt",
              "gt", "le")


def read_blocks(path):
    """The plug-in's `blocks` file: the instructions of each block, as text, by its number."""
    blocks = {}
    with open(path, encoding="ascii") as file:
        for line in file:
            if line.startswith("block "):
                lines = blocks.setdefault(int(line.split()[1]), [])
            elif line.strip():
                lines.append(line.strip())
    return blocks


def register_count(text):
    """How many registers a list in braces names: "{r4, r5-r7, lr}" is 5."""
    count = 0
    for part in re.search(r"\{(.*)\}", text).group(1).split(","):
        ends = re.fullmatch(r"\s*[a-z]+(\d+)-[a-z]+(\d+)\s*", part)
        count += int(ends.group(2)) - int(ends.group(1)) + 1 if ends else 1
    return count


def for_model(text):
    """What llvm-mca can schedule in place of one instruction: a list of instructions.

    It knows no load and store of several registers (one transfer each instead), and takes calls for
    100 cycles (a branch instead). Nothing for what only fills a slot, or says of the next
    instructions when they hold (libgcc's division is in Thumb).
    """
    name = text.split()[0].replace(".w", "")
    if name in ("nop", "dmb", "dsb", "isb") or re.fullmatch("it[te]*", name):
        return []
    if name.startswith(("push", "stm", "vpush", "vstm", "vstmia")):
        return ["str r0, [sp]"] * register_count(text)
    if name.startswith(("pop", "ldm", "vpop", "vldm", "vldmia")):
        return ["ldr r0, [sp]"] * register_count(text)
    for branch in ("bxj", "blx", "bx", "bl", "b"):
        if name.startswith(branch) and name[len(branch):] in CONDITIONS:
            return ["b" + name[len(branch):] + " #16"]
    return [text]


def model(blocks, unknown, command):
    """Runs llvm-mca on all blocks. Returns cycles by number, and what it could not schedule."""
    source = []
    for number, lines in blocks.items():
        source.append("@ LLVM-MCA-BEGIN b%d" % number)
        for line in lines:
            source += for_model(line) if line not in unknown else []
        source += ["add r12, r12, #0", "@ LLVM-MCA-END"]  # a region must not be empty
    run = subprocess.run(
        command + ["-mtriple=armv7a-linux-gnueabihf", "-mcpu=cortex-a9", "-mattr=+neon",
                   "-iterations=%d" % ITERATIONS, "-all-views=0", "-summary-view"],
        input="\n".join(source), capture_output=True, text=True)
    # What it cannot read it leaves out, what it cannot schedule ends the run.
    wrong = {source[int(n) - 1] for n in re.findall(r"<stdin>:(\d+):\d+: error", run.stderr)}
    names = {shown.split()[0] for shown in re.findall(r"note: instruction:\s*(\S.*)", run.stderr)}
    wrong |= {line for lines in blocks.values() for line in lines if line.split()[0] in names}
    if wrong - unknown:
        return {}, wrong
    if run.returncode != 0:
        raise RuntimeError("llvm-mca: " + run.stderr.strip().split("\n")[0])
    found = re.findall(r"Code Region - b(\d+)\n\nIterations:.*\n.*\nTotal Cycles:\s+(\d+)", run.stdout)
    return {int(number): int(total) / ITERATIONS for number, total in found}, set()


def cycles_of_blocks(blocks, command=("llvm-mca",)):
    """Cycles that one run of each block takes, by number, and the instructions not modelled.

    A run is one of many in a row, so that blocks overlap as in a loop; two instructions a cycle is
    what the Cortex-A9 issues at most. What the model does not know takes a cycle.
    """
    unknown = set()
    while True:
        cycles, wrong = model(blocks, unknown, list(command))
        if not wrong:
            break
        unknown |= wrong
    costs = {}
    for number, lines in blocks.items():
        skipped = sum(1 for line in lines if line in unknown)
        costs[number] = max(cycles[number], len(lines) / 2) + skipped
    return costs, unknown
