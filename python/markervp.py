"""markervp in Python: runs, sweeps and searches, through the program and its files.

    import markervp
    run = markervp.run(["demo"], set={"ps.fclk_clk1.frequency": "40 MHz"})
    run["summary.fps.mean"]
    sweep = markervp.sweep({"parameters": {"sw.canonical_width": ["24 px", "60 px"]}})
    sweep.frame()                       # a pandas.DataFrame, where pandas is installed
    markervp.read_sweep("out/mine")     # what was computed before
    overlay = markervp.Overlay("mine/")  # a notebook leads it, with PYNQ's names: markervp_overlay
    with markervp.Session("./blink.so") as board:   # a test leads the run
        board.wait_for("axi_gpio_0.GPIO_DATA == 0x100", timeout="1 ms")

The program is $MARKERVP, or `markervp` in the PATH. What it refuses is a markervp.Error with its message. Nothing is computed
here: every figure comes from the program, result.json or a sweep's files.
"""
import collections
import contextlib
import csv
import difflib
import functools
import json
import os
import pathlib
import re
import secrets
import shutil
import socket
import sqlite3
import subprocess
import tempfile

__all__ = ["Beat", "Error", "MMIO", "Overlay", "Run", "Session", "Sweep", "allocate", "as_pynq", "explore", "figures", "program", "read", "read_sweep", "run", "sweep", "write_study"]

_points_failed = 4


def __getattr__(name):  # a notebook's names, which other programs do not load
    if name in ("MMIO", "Overlay", "allocate"):
        import markervp_overlay
        return getattr(markervp_overlay, name)
    if name == "as_pynq":
        import markervp_pynq
        return markervp_pynq.as_pynq
    raise AttributeError(f"module 'markervp' has no attribute '{name}'")


_control = re.compile("[\\x00-\\x1f\\x7f-\\x9f\\u200e\\u200f\\u2028-\\u202e\\u2066-\\u2069]")


def _escape(found):
    code = ord(found[0])
    return {10: "\\n", 9: "\\t"}.get(code) or (f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}")


def _visible(text):
    """A text from outside as one line that commands nothing: vp::visible() in C++."""
    return _control.sub(_escape, str(text))


class Error(Exception):
    """What the program said, in one line; `code` is its exit code."""

    def __init__(self, message, code):
        super().__init__(_visible(message))
        self.code = code


def program():
    """The program's path."""
    found = os.environ.get("MARKERVP") or shutil.which("markervp")
    if not found:
        raise Error("no markervp in the PATH: install it, or set MARKERVP to the program's file", None)
    return found


def _call(arguments, good=(0,)):
    done = subprocess.run([program(), *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode not in good:
        lines = done.stderr.strip().splitlines() or ["markervp ended with " + str(done.returncode)]
        raise Error(lines[-1].removeprefix("markervp: "), done.returncode)
    return done.stdout


class Run:
    """A run's result.json: `run["summary.fps.mean"]`, `run.result` for the whole of it.

    A path is a metric (`markervp metrics`), or leads to a member: members of a list are named by their `name`, or counted. A
    metric is a number: `run["verdict.feasible"]` is 1, 0.5 or 0, and run.result["verdict"]["feasible"] the word."""

    def __init__(self, folder):
        folder = pathlib.Path(folder)
        self.file = folder if folder.is_file() else folder / "result.json"
        self.result = json.loads(self.file.read_text(encoding="utf-8"))

    @functools.cached_property
    def metrics(self):
        """Every metric of the run by name, as sweeps have them: `markervp metrics --of`."""
        return json.loads(_call(["metrics", "--of", self.file, "--json"]))

    def __getitem__(self, path):
        member = _member(self.result, path)
        if path in self.metrics:
            value = self.metrics[path]
            return member if isinstance(member, (int, float)) and member == value else value
        if member is _missing:
            near = difflib.get_close_matches(path, self.metrics, 1)
            raise KeyError(f"'{path}' is neither a metric nor a member of {self.file}" + (f"; did you mean '{near[0]}'?" if near else ""))
        return member

    def __repr__(self):
        return f"markervp.read({str(self.file.parent)!r})"


_missing = object()


def _member(value, path):
    """What a path leads to; names on it may have dots."""
    if isinstance(value, dict):
        members = value.items()
    elif isinstance(value, list):
        members = [(name, item) for i, item in enumerate(value) for name in {str(i), _name_of(item) or str(i)}]
    else:
        return _missing
    for name, item in members:
        if path == name:
            return item
        found = _member(item, path[len(name) + 1:]) if path.startswith(name + ".") else _missing
        if found is not _missing:
            return found
    return _missing


def _name_of(item):
    name = item.get("name") if isinstance(item, dict) else None
    return name if isinstance(name, str) else None


class Sweep:
    """What is in the folder of a sweep or a search. `points` are dictionaries: key, status, message, feasible, same_as
    (the key of the point that it is, too), the swept parameters as they were written, and the metrics that the study asks for as
    numbers, or None."""

    _words = ("key", "status", "message", "feasible", "same_as")

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        with open(self.folder / "points.csv", newline="", encoding="utf-8") as file:
            self._texts = {*self._words, *next(csv.reader(file))}
        self._count = self.sql("select count(*) from points")[0][0]

    @functools.cached_property
    def manifest(self):
        """What manifest.json says of the sweep and its points, computed or not."""
        return json.loads((self.folder / "manifest.json").read_text(encoding="utf-8"))

    @functools.cached_property
    def points(self):
        return list(self)

    def __len__(self):
        return self._count

    def __iter__(self):
        """One point after another: a million of them do not fit into memory at once."""
        with open(self.folder / "sweep.csv", newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                yield {name: value if name in self._texts else float(value) if value else None
                       for name, value in row.items()}

    def __repr__(self):
        return f"markervp.read_sweep({str(self.folder)!r})"

    def front(self, objectives=(), constraints=()):
        """The points that nothing beats, by `markervp pareto`; without objectives by those of the study."""
        arguments = ["pareto", self.folder]
        for objective in objectives:
            arguments += ["--objective", objective]
        for constraint in constraints:
            arguments += ["--constraint", constraint]
        _call(arguments)
        with open(self.folder / "pareto.csv", newline="", encoding="utf-8") as file:
            best = {row["key"] for row in csv.DictReader(file) if row["front"] == "1"}
        return [point for point in self if point["key"] in best]

    def frame(self):
        """The points as a pandas.DataFrame, by key."""
        import pandas  # only here: everything else works without it
        return pandas.DataFrame(self.points).set_index("key")

    def sql(self, query, parameters=()):
        """Rows of a query on sweep.sqlite, which has every metric of every point (docs/exploration.md)."""
        uri = (self.folder / "sweep.sqlite").resolve().as_uri() + "?mode=ro"
        connection = sqlite3.connect(uri, uri=True)
        try:
            return connection.execute(query, parameters).fetchall()
        finally:
            connection.close()

    def run(self, point, output, set=None):
        """Runs a point, or its key, again as an ordinary run with pictures and report."""
        key = point if isinstance(point, str) else point["key"]
        arguments = ["run", "--point", f"{self.folder}:{key}"]
        return _run(arguments, output, set)


def _run(arguments, output, settings):
    for path, value in (settings or {}).items():
        arguments += ["--set", f"{path}={_text(value)}"]
    _call([*arguments, "--output", output, "--quiet"])
    return Run(output)


def _text(value):
    return str(value).lower() if isinstance(value, bool) else str(value)


def run(inputs=(), set=None, output="out", options=()):
    """Runs the platform on inputs, as `markervp run` names them. `options` go to `markervp run` as they are."""
    return _run(["run", *inputs, *options], output, set)


def figures(design=None):
    """What the numbers of a run are, and those that a design finds of its own: dictionaries with path, unit, title, meaning, and
    better (1: more, -1: less). `*` in a path is any name."""
    return json.loads(_call(["metrics", "--json", *(["--design", design] if design else [])]))


def read(folder):
    """The result of a run that was made before: its folder, or its result.json."""
    return Run(folder)


def write_study(study, file):
    """Writes a study, a dictionary as docs/exploration.md has it, as a file for `markervp sweep` and `explore`."""
    file = pathlib.Path(file)
    file.parent.mkdir(parents=True, exist_ok=True)
    # YAML holds JSON.
    file.write_text(json.dumps(study, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    return file


def _computed(command, study, output, options):
    if isinstance(study, dict):
        output = pathlib.Path(output or "out/study")
        study = write_study(study, output.with_name(output.name + ".yaml"))
    output = pathlib.Path(output or pathlib.Path("out") / pathlib.Path(study).stem)
    _call([command, study, "--output", output, *options], good=(0, _points_failed))
    return Sweep(output)


def sweep(study, output=None, options=()):
    """Computes all points of a study: a dictionary, a file or the name of one that comes with the program. Points that fail to run
    are results."""
    return _computed("sweep", study, output, options)


def explore(study, output=None, options=()):
    """Searches the space of a study for its best points."""
    return _computed("explore", study, output, options)


def read_sweep(folder):
    """What is in the folder of a sweep or a search that was made before."""
    return Sweep(folder)


def _time(value):
    """Of a text as it is ("5 ms"), of a number in seconds."""
    return value if isinstance(value, str) else f"{round(value * 1e12)} ps"


Beat = collections.namedtuple("Beat", "cycle data last keep")


class Partner:
    """A device that a Session attached: its contents, by the device's own addresses."""

    def __init__(self, session, bus, address):
        self._session = session
        self._place = {"bus": bus, "address": address}

    def read(self, at, count=1):
        return bytes(self._session._ask("contents", at=at, count=count, **self._place)["bytes"])

    def write(self, at, data):
        self._session._ask("contents", at=at, bytes=list(bytes(data)), **self._place)


class _ScratchFolder:
    """A folder that a process beside this one makes and removes: at remove(), or once this process and those that have `token` are
    gone, killed ones included. So there is no moment at which a kill leaves it."""

    def __init__(self):
        self.name = os.path.join(tempfile.gettempdir(), f"markervp-{secrets.token_hex(8)}")
        reading, self.token = os.pipe()
        self._remover = subprocess.Popen(
            ["/bin/sh", "-c", 'mkdir -m 700 -- "$1" && echo made && { read -r _; rm -rf -- "$1"; }', "sh", self.name], stdin=reading,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True, text=True)
        os.close(reading)
        made = self._remover.stdout.readline()
        self._remover.stdout.close()
        if not made:
            os.close(self.token)
            reason = self._remover.stderr.read().strip()
            self._remover.stderr.close()
            self._remover.wait()
            raise OSError(f"no temporary folder: {reason}")
        self._remover.stderr.close()

    def remove(self):
        if self._remover.returncode is None:
            with contextlib.suppress(BrokenPipeError):
                os.write(self.token, b"\n")
            os.close(self.token)
            self._remover.wait()


class Session:
    """A run that a test leads: it lets time pass or waits, reads and writes from outside, and looks at what came of it.

    Simulated time stops while the test thinks, so that the same test always sees the same. Times are texts ("5 ms") or
    numbers, s. Registers and addresses are named as `markervp map` does: "axi_gpio_0.GPIO_DATA", "ddr+0x1000", 0x41200000;
    signals as in a trace: "ps.gic.n_irq". What the platform refuses is a markervp.Error, and the run continues.

    `wall_time`, s: the longest that a command may take on this computer; the run is killed then. It may be set between commands.
    """

    def __init__(self, program_file=None, inputs=(), set=None, output=None, options=(), wall_time=60):
        self._folder = None if output else _ScratchFolder()
        self.output = pathlib.Path(output or self._folder.name)
        self.console = []  #: lines that the program and the UARTs printed
        self.time = 0.0  #: simulated, s
        self.ended = False  #: the program has
        self._reply = b""  # what was received and not yet read
        self._socket, theirs = socket.socketpair()
        self.wall_time = wall_time
        arguments = [program(), "run", *map(str, inputs), "--quiet", "--no-pictures", "--output", str(self.output),
                     "--control", str(theirs.fileno()), *options]
        if program_file:
            arguments += ["--program", str(program_file)]
        for path, value in (set or {}).items():
            arguments += ["--set", f"{path}={_text(value)}"]
        self._messages = tempfile.TemporaryFile("w+")
        passed = [theirs.fileno()] + ([self._folder.token] if self._folder else [])
        self._process = subprocess.Popen(arguments, pass_fds=passed, stdout=subprocess.DEVNULL, stderr=self._messages, text=True)
        theirs.close()
        try:
            self._ask("run", **{"for": "0 ps"})
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        self.close()

    def close(self):
        """Ends the run, wherever it is."""
        self._socket.close()
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()
        self._messages.close()
        if self._folder:
            self._folder.remove()

    def _failed(self, what):
        self._process.kill()
        code = self._process.wait()
        self._messages.seek(0)
        lines = self._messages.read().strip().splitlines() or [what]
        return Error(lines[-1].removeprefix("markervp: "), code)

    def _ask(self, command, **values):
        try:
            self._socket.settimeout(self.wall_time)
            self._socket.sendall(json.dumps({"do": command, **values}).encode() + b"\n")
            while b"\n" not in self._reply:
                more = self._socket.recv(1 << 16)
                if not more:
                    self._process.wait()
                    raise self._failed("the run ended without an answer")
                self._reply += more
        except socket.timeout:
            raise self._failed(f"no answer to '{command}' within {self.wall_time:g} s") from None
        except (BrokenPipeError, ConnectionResetError):
            self._process.wait()
            raise self._failed("the run is over") from None
        line, self._reply = self._reply.split(b"\n", 1)
        reply = json.loads(line)
        self.time, self.ended = reply["time_ps"] / 1e12, reply["ended"]
        self.console += reply["console"]
        if "error" in reply:
            raise Error(reply["error"], None)
        return reply

    def run(self, time):
        """Lets so much time pass, or less if the program ends."""
        self._ask("run", **{"for": _time(time)})

    def wait_for(self, condition, timeout, every="1 us"):
        """Until an expression over signals and registers holds (docs/expressions.md): "ps.gic.n_irq falls",
        "axi_dma_0.MM2S_DMASR[0] == 0". At its very instant where it names signals only; registers are looked at `every` so
        often. Returns the time, s. An Error if it did not come in time."""
        self._met(self._ask("wait", timeout=_time(timeout), every=_time(every), **{"for": condition}), condition, timeout)
        return self.time

    def wait_for_text(self, text, timeout):
        """Until a line with that text is printed. What was printed before does not count, but for the lines of the start, as
        long as no time has passed."""
        if self.time == 0.0 and any(text in line for line in self.console):
            return self.time
        self._met(self._ask("wait_text", timeout=_time(timeout), text=text), f"'{text}' on the console", timeout)
        return self.time

    def _met(self, reply, what, timeout):
        if not reply["met"]:
            end = "before the program ended" if self.ended else f"within {timeout if isinstance(timeout, str) else f'{timeout:g} s'}"
            raise Error(f"{what}: did not come {end}; it is {self.time * 1e3:g} ms now", None)

    def read(self, at):
        """A word, without the effects that a read by software has."""
        return self.read_words(at, 1)[0]

    def read_words(self, at, count):
        return self._ask("read", at=str(at), words=count)["words"]

    def write(self, at, value):
        """Puts a word into memory or a register, without the effects that a write by software has."""
        self._ask("write", at=str(at), value=value)

    def signal(self, name):
        return self._ask("signal", name=name)["value"]

    def drive(self, name, value):
        """Sets a signal, such as a pin from outside; what drives it in the design may change it again."""
        self._ask("drive", name=name, value=int(value))

    def pin(self, number, level=None, wire_to=None, released=False):
        """A pin of the processing system as its GPIO numbers it: 0 to 53 MIO, 54 to 117 EMIO. `level` drives it from outside,
        `released=True` no longer does, `wire_to` lets another pin follow it. Returns its level."""
        change = {} if level is None else {"level": int(level)}
        if wire_to is not None:
            change["wire_to"] = wire_to
        if released:
            change["released"] = 1
        return bool(self._ask("pin", number=number, **change)["level"])

    def attach(self, bus, device, **build):
        """Wires a device to a controller, "ps.i2c0" or "pl.axi_iic_0": "eeprom" (address, size=256, page=16) or "registers"
        (address, index_bytes=1, value_bytes=1) to I2C, "flash" (slave=0, size=4 MiB) to SPI. Returns a Partner."""
        self._ask("attach", bus=bus, device=device, **build)
        return Partner(self, bus, build.get("address", build.get("slave", 0)))

    def analogue(self, channel, value, converter="ps.xadc"):
        """Sets an input of the XADC: the temperature (channel 0) in °C, the others in V (16 to 31 are VAUX0 to VAUX15)."""
        self._ask("analogue", name=converter, channel=channel, value=float(value))

    def interrupt(self, number, level=True):
        """Sets the wire of an interrupt, 32 to 95."""
        self._ask("interrupt", id=number, level=int(level))

    def uart(self, text, device="uart0"):
        """Types into an UART, "uart1" or "pl.axi_uartlite_0"; characters come at its baud rate."""
        self._ask("receive", device=device, text=text)

    def send(self, source, words, last=True):
        """Gives words to a stream source of the design, "pl.source": one a clock from now on, after those that wait there.
        TLAST comes with the last of them, unless `last` is False."""
        words = list(words)
        part = 1 << 16  # of what a command may hold; simulated time stops between two of them
        for first in range(0, max(len(words), 1), part):
            ends = first + part >= len(words)
            self._ask("send", name=source, words=words[first:first + part], last=int(last and ends))

    def received(self, sink):
        """The beats that came to a stream sink of the design, "pl.sink", since the last call, each a Beat: the number of its
        clock edge, data, TLAST and TKEEP."""
        return [Beat(*beat) for beat in self._ask("received", name=sink)["beats"]]

    def finish(self):
        """Lets the program run to its end. Returns the Run; an Error if it failed."""
        while not self.ended:
            self.run("1000 s")
        self._socket.sendall(b'{"do": "finish"}\n')
        try:
            code = self._process.wait(self.wall_time)
        except subprocess.TimeoutExpired:
            raise self._failed("the run's results were not written in time") from None
        if code != 0:
            raise self._failed("the run failed")
        return Run(self.output)
