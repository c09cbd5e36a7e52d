"""markervp in Python: runs, sweeps and searches, through the program and its files.

    import markervp
    run = markervp.run(["demo"], set={"ps.fclk_clk1.frequency": "40 MHz"})
    run["summary.fps.mean"]
    sweep = markervp.sweep({"parameters": {"sw.canonical_width": ["24 px", "60 px"]}})
    sweep.frame()                       # a pandas.DataFrame, where pandas is installed
    markervp.read_sweep("out/mine")     # what was computed before

The program is $MARKERVP, or `markervp` in the PATH. What it refuses is a markervp.Error with its message. Nothing is computed
here: every figure comes from result.json or a sweep's files.
"""
import csv
import json
import os
import pathlib
import shutil
import sqlite3
import subprocess

__all__ = ["Error", "Run", "Sweep", "explore", "program", "read", "read_sweep", "run", "sweep", "write_study"]

_points_failed = 4


class Error(Exception):
    """What the program said; `code` is its exit code."""

    def __init__(self, message, code):
        super().__init__(message)
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
    """A run's result.json: `run["summary.fps.mean"]`, `run.result` for the whole of it."""

    def __init__(self, folder):
        folder = pathlib.Path(folder)
        self.file = folder if folder.is_file() else folder / "result.json"
        self.result = json.loads(self.file.read_text(encoding="utf-8"))

    def __getitem__(self, path):
        value = self.result
        for name in path.split("."):
            value = value[int(name)] if isinstance(value, list) else value[name]
        return value

    def __repr__(self):
        return f"markervp.read({str(self.file.parent)!r})"


class Sweep:
    """What stands in the folder of a sweep or a search. `points` are dictionaries: key, status, message, feasible, the swept
    parameters as they were written, and the metrics that the study asks for as numbers, or None."""

    _words = ("key", "status", "message", "feasible")

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.manifest = json.loads((self.folder / "manifest.json").read_text(encoding="utf-8"))
        texts = {*self._words, *self.manifest["swept"]}
        with open(self.folder / "sweep.csv", newline="", encoding="utf-8") as file:
            self.points = [{name: value if name in texts else float(value) if value else None
                            for name, value in row.items()} for row in csv.DictReader(file)]

    def __len__(self):
        return len(self.points)

    def __iter__(self):
        return iter(self.points)

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
        return [point for point in self.points if point["key"] in best]

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
        arguments = ["run", "--point", self.folder / "points" / f"{key}.json"]
        return _run(arguments, output, set)


def _run(arguments, output, settings):
    for path, value in (settings or {}).items():
        arguments += ["--set", f"{path}={_text(value)}"]
    _call([*arguments, "--output", output, "--quiet"])
    return Run(output)


def _text(value):
    return str(value).lower() if isinstance(value, bool) else str(value)


def run(inputs=(), set=None, output="out", options=()):
    """Runs the platform on scenes, images, folders or videos. `options` go to `markervp run` as they are."""
    return _run(["run", *inputs, *options], output, set)


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
    """What stands in the folder of a sweep or a search that was made before."""
    return Sweep(folder)
