"""The platform without the marker application: bare_test.py MARKERVP_BARE RAMP_SO FILTERING_SO SOURCE_TREE.

Two designs without images go through every command: "fir", built in, on a file of samples; "ramp", a shared object, on
nothing. No word of markers may be on the console, in a file, or on a page.
"""
import importlib.util
import json
import os
import pathlib
import re
import shutil
import sqlite3
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM, RAMP, FILTERING, SOURCES = sys.argv[1:5]
WORDS = re.compile(r"marker|corner|blob|(?<![a-z])poses?(?![a-z])|scene|image|aruco", re.IGNORECASE)
OWN_NAME = re.compile(r"markervp(_bare)?", re.IGNORECASE)


def words_in(text):
    """Lines with a word of the application; the name of the program does not count."""
    return [line for line in text.splitlines() if WORDS.search(OWN_NAME.sub("", line))]


class Bare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        with open(cls.folder / "samples.bin", "wb") as file:
            for i in range(128):
                file.write(struct.pack("<I", i % 16))
        cls.fir = ["--design", "fir", "--program", FILTERING]
        cls.ramp = ["--design", RAMP]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def call(self, *arguments, code=0):
        """What the command prints; it must end with `code`, and use no word of the application."""
        ended = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True)
        said = ended.stdout + ended.stderr
        self.assertEqual(ended.returncode, code, said)
        self.assertEqual(words_in(said.replace(SOURCES, "")), [], arguments)
        return said

    def result(self, folder):
        text = (self.folder / folder / "result.json").read_text()
        self.assertEqual(words_in(text.replace(SOURCES, "")), [])
        return json.loads(text)

    def test_built_in_design_on_samples(self):
        said = self.call("run", "samples.bin", *self.fir, "-o", "fir")
        self.assertIn("[1/2] samples.bin#1: done", said)
        self.assertIn("2 blocks, 0 above 1000", said)
        self.assertIn("verdict  feasible", said)
        self.assertIn("peak", said)
        result = self.result("fir")
        self.assertEqual((result["unit"], result["summary"]["frames"], result["summary"]["loud"]), ("block", 2, 0))
        self.assertEqual(result["verdict"]["job"], {"holds": "yes", "margin_percent": 0.0})
        # The largest sum of a ramp of 16: 15 + 3·14 + 3·13 + 12.
        self.assertEqual([unit["figures"]["peak"] for unit in result["frames"]], [108, 108])
        self.assertEqual([unit["counts"] for unit in result["frames"]], [{"words": 64, "lost_words": 0}] * 2)

    def test_design_from_outside_without_input(self):
        for fidelity in ("tlm", "clocked"):
            self.call("run", *self.ramp, "--fidelity", fidelity, "-o", fidelity, "--no-report", "--require-job")
        one, other = self.result("tlm"), self.result("clocked")
        self.assertEqual([unit["index"] for unit in one["frames"]], [0, 1, 2])
        self.assertNotIn("input", one["frames"][0])
        self.assertEqual(one["frames"], other["frames"])
        self.assertEqual(one["verdict"]["feasible"], "yes")

    def test_a_job_not_done_says_why(self):
        wrong = ["run", *self.ramp, "--set", "pl.filter.gain=2", "--no-report", "-o", "wrong"]
        said = self.call(*wrong)
        self.assertIn("INFEASIBLE: 2 of 3 blocks with wrong words", said)  # the first ramp is all 0
        self.assertIn("job not done in 2 of 3 blocks, first in 2", self.call(*wrong, "--require-job", code=1))
        self.assertEqual(self.result("wrong")["verdict"]["job"]["holds"], "no")

    def test_a_block_that_never_ends(self):
        """Its last word is lost on the way to the filter: the program waits for good. The blocks before stay."""
        for fidelity in ("tlm", "clocked"):
            said = self.call("run", *self.ramp, "--fidelity", fidelity, "--no-report", "-o", "endless", "--set", "ps.cpu.timeout=1 ms",
                             "--set", "inject=[{what: dropped, where: pl.samples, beat: 128}]", code=3)
            self.assertIn("INFEASIBLE: stopped by an error", said)
            self.assertRegex(said, "no end within 1 ms of simulated time .*axi_dma_1 S2MM has a transfer under way, and no data come")
            self.assertRegex(said, r"called from filter \(.*filtering.cpp:\d+\)")
            result = self.result("endless")
            self.assertEqual(([unit["index"] for unit in result["frames"]], result["summary"]["delivered"]), ([0], 1))

    def test_inputs_that_do_not_fit(self):
        (self.folder / "odd.bin").write_bytes(b"abc")
        self.assertIn("3 bytes are no whole number of blocks", self.call("run", "odd.bin", *self.fir, code=2))
        self.assertIn("name a file of samples", self.call("run", *self.fir, code=2))
        self.assertIn("takes no input: leave out 'samples.bin'", self.call("run", "samples.bin", *self.ramp, code=2))
        self.assertIn("missing.bin", self.call("run", "missing.bin", *self.fir, code=2))
        (self.folder / "empty.bin").write_bytes(b"")
        self.assertIn("0 bytes are no whole number", self.call("run", "empty.bin", *self.fir, code=2))

    def test_a_design_that_declares_too_little(self):
        place = r"08_filter/fir_design.cpp:\d+"
        for mistake, said, code in (("no_job", "names no job", 2),
                                    ("no_unit", rf"'frames.figures.peak' \({place}\) has no unit: write \"1\"", 2),
                                    ("declared_twice", rf"'frames.figures.peak' \(bare/mistaken_fir.cpp:\d+\) is declared twice: first in {place}", 2),
                                    ("declared_by_the_platform", r"'summary.frames' .* declared in result/run_members.cpp:\d+", 2),
                                    ("figure_twice", "'peak' twice", 3),
                                    ("unknown_figure", r"figure 'depth', which its work\(\) does not declare", 3),
                                    ("unknown_tally", r"tally 'silent', which its work\(\) does", 3)):
            self.assertRegex(self.call("run", *self.ramp, "--set", f"pl.mistake={mistake}", "--no-report", "-o", "bad", code=code), said)

    def test_a_figure_of_a_design_is_everywhere(self):
        """It is declared once, in its work()."""
        said = self.call("run", *self.ramp, "-o", "everywhere")
        self.assertIn("peak     mean 492 V   min 0 V   max 984 V", said)
        self.assertIn("frames.figures.peak.mean|max", self.call("metrics", "--design", RAMP))
        self.assertRegex(self.call("metrics", "peak", "--of", "everywhere"), r"frames.figures.peak.max +\d+ +V")
        self.call("run", *self.ramp, "--set", "pl.filter.gain=2", "-o", "louder", "--no-report")
        self.assertRegex(self.call("compare", "everywhere", "louder"), r"frames.figures.peak.max +V +\d+ +\d+ +\+100.00 % +worse")
        declared, = [figure for figure in self.result("everywhere")["figures"] if figure["path"] == "frames.figures.peak"]
        self.assertEqual((declared["unit"], declared["better"], declared["meaning"]), ("V", "less", "largest word of a block"))
        self.study()
        self.call("sweep", "study.yaml", "-o", "swept")
        database = sqlite3.connect(self.folder / "swept" / "sweep.sqlite")
        self.assertEqual(database.execute("select unit, better from metric_names where name = 'frames.figures.peak.mean'").fetchall(),
                         [("V", "less")])
        database.close()
        page = self.folder / "swept" / "report.html"
        if page.exists():
            for _ in range(2):  # as it is made, and again without the design
                self.assertIn('{"path":"frames.figures.peak.mean","title":"Peak","unit":"V","factor":1.0,"better":-1}', page.read_text())
                self.call("report", "swept")
            self.assertIn('"path":"frames.figures.peak","unit":"V"', (self.folder / "everywhere" / "report.html").read_text())
            self.call("report", "everywhere", "louder", "-o", "peaks.html")
            self.assertRegex((self.folder / "peaks.html").read_text(), r'\{"title":"Peak","unit":"V","better":-1,"a":[\d.]+,"b":[\d.]+\}')

    def test_samples_repeat_and_stop(self):
        self.call("run", "samples.bin", *self.fir, "--repeat", "3", "--frames", "5", "--no-report", "-o", "five")
        self.assertEqual([unit["input"] for unit in self.result("five")["frames"]],
                         [f"samples.bin#{n}" for n in (1, 2, 1, 2, 1)])

    def test_descriptions(self):
        for command in ("--help", "run --help", "sweep --help", "explore --help", "report --help", "designs", "metrics", "devices",
                        "completion bash"):
            self.call(*command.split())
        for command in ("config", "map", "map --registers", "map --xparameters"):
            self.call(*command.split(), "--design", RAMP)
        self.assertIn("pl.filter", self.call("config", "pl.filter", "--design", RAMP).replace("pl:\n  filter", "pl.filter"))

    def test_trace(self):
        self.call("run", *self.ramp, "--trace", "t.vcd", "--no-report", "-o", "traced")
        for command in ("list t.vcd", "stats t.vcd", "values t.vcd pl.filtered.tdata --at 12us"):
            self.call("trace", *command.split())
        self.assertEqual(words_in((self.folder / "t.vcd").read_text().replace(SOURCES, "")), [])

    def study(self):
        (self.folder / "study.yaml").write_text(
            f"title: Clock\nset: {{design: {RAMP}}}\n"
            "parameters: {ps.fclk_clk0.frequency: [50 MHz, 100 MHz], ps.cpu_clk.frequency: [400 MHz, 600 MHz]}\n"
            "objectives: [max summary.fps.mean, min power.total_w.nominal]\n")

    def test_studies(self):
        self.study()
        self.call("sweep", "study.yaml", "-o", "sweep", "--keep-results")
        self.assertEqual(words_in((self.folder / "sweep" / "sweep.csv").read_text()), [])
        self.assertIn("frames.figures.peak.mean", (self.folder / "sweep" / "sweep.csv").read_text().splitlines()[0])
        self.assertIn("4", self.call("pareto", "sweep"))
        self.call("sensitivity", "sweep")
        keys = sorted((self.folder / "sweep" / "points").glob("*.json"))
        for key in keys:
            self.assertEqual(words_in(key.read_text().replace(SOURCES, "").replace(RAMP, "")), [])
        self.call("compare", str(keys[0]), str(keys[1]))
        shutil.rmtree(self.folder / "sweep" / "points")
        self.call("compare", f"sweep:{keys[0].stem}", f"sweep:{keys[1].stem}")
        self.call("run", "--point", f"sweep:{keys[0].stem}", "--no-report", "-o", "again")
        self.call("explore", "study.yaml", "-o", "explore", "--points", "4")

    def test_page(self):
        self.call("run", "samples.bin", *self.fir, "-o", "one")
        self.call("run", *self.ramp, "-o", "two")
        self.call("report", "one", "two", "-o", "both.html")
        self.study()
        self.call("sweep", "study.yaml", "-o", "shown")
        browser = shutil.which("chromium")
        if not browser or not (self.folder / "one" / "report.html").exists():
            self.skipTest("no browser, or built without the page")
        for page in ("one/report.html", "two/report.html", "both.html", "shown/report.html"):
            self.assertEqual(words_in(self.text_of(browser, page).replace(SOURCES, "")), [], page)

    def text_of(self, browser, page):
        """What a reader sees."""
        shown = subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000", "--dump-dom",
                                str(self.folder / page)], capture_output=True, text=True, timeout=120).stdout
        body = re.sub(r"(?s)<(script|style)\b.*?</\1>", "", shown[shown.index("<body"):])
        text = re.sub(r"<[^>]*>", "\n", body)
        self.assertIn("block", text.lower() + "block" * (page == "shown/report.html"))
        return text

    def test_python(self):
        spec = importlib.util.spec_from_file_location("markervp", os.path.join(SOURCES, "python", "markervp.py"))
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        os.environ["MARKERVP"] = PROGRAM
        run = module.run([], options=[*self.ramp, "--no-report"], output=str(self.folder / "py"))
        self.assertEqual(run["summary.frames"], 3)
        self.assertEqual(run.metrics["frames.figures.peak.max"], 2 * (63 + 3 * 62 + 3 * 61 + 60))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
