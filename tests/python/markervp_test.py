"""The Python module, and the notebook of the documentation: python3 markervp_test.py PROGRAM SOURCES"""
import json
import os
import pathlib
import sys
import tempfile
import unittest

program, sources = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
os.environ["MARKERVP"] = program
sys.path.insert(0, str(sources / "python"))
import markervp  # noqa: E402

CLOCKS = {"parameters": {"ps.fclk_clk1.frequency": ["25 MHz", "50 MHz", "100 MHz"]},
          "metrics": ["summary.fps.mean", "frames.error.corner_px.mean"],
          "objectives": ["max summary.fps.mean", "min summary.latency_us.mean"]}


class Module(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def test_a_run_is_read(self):
        run = markervp.run(["demo"], set={"ps.fclk_clk1.frequency": "40 MHz", "ps.poll_elision": True}, output="slow",
                           options=["--no-pictures", "--no-report"])
        self.assertEqual(run["summary.frames"], 1)
        self.assertEqual(run["frames.0.input"], "demo")
        self.assertEqual(run["summary.fps.mean"], markervp.read("slow")["summary.fps.mean"])
        # What sets the rate, as the console and the page say it.
        self.assertEqual(run["limit.stages"], ["feature_extraction"])
        self.assertEqual(run["limit.percent.feature_extraction"], 100)
        self.assertLess(run["limit.stages_us"], run["limit.period_us"])
        self.assertIn("feature extraction sets the frame rate", run["limit.text"])
        self.assertEqual(run["limit.clock"], "ps.fclk_clk1")
        self.assertGreater(markervp.run(output="usual", options=["--no-pictures"])["summary.fps.mean"], run["summary.fps.mean"])

    def test_every_metric_is_read_by_its_name(self):
        for design, inputs, parameters in (("thesis", ["demo", "z1.0"], {"ps.fclk_clk1.frequency": ["60 MHz"]}),
                                           ("ps-only", ["squares3"], {"ps.cpu_clk.frequency": ["600 MHz"]}),
                                           ("improved", ["roll0", "z4.5", "z2.0@markers=2"], {"camera.rate": ["60 fps"]})):
            with self.subTest(design):
                sweep = markervp.sweep({"inputs": inputs, "parameters": parameters, "set": {"design": design}, "metrics": ["summary.fps.mean"]},
                                       output=design)
                run = sweep.run(sweep.points[0], design + "-run")
                metrics = dict(sweep.sql("select name, value from metrics"))
                self.assertGreater(len(metrics), 100)
                self.assertEqual({name: run[name] for name in metrics}, metrics)
                self.assertEqual(run.metrics, metrics)

    def test_members_have_names_with_dots_and_what_there_is_not_is_named(self):
        run = markervp.run(["demo"], options=["--no-pictures", "--no-report"])
        self.assertEqual(run["configuration.pl.width"], "640 px")
        self.assertIn("RTL", run["resources.modules.pl.blob_detection.source"])
        self.assertEqual(run["power.modules.pl.blob_detection.w"],
                         sum(entry["w"] for entry in run.result["power"]["modules"] if entry["name"] == "pl.blob_detection"))
        with self.assertRaisesRegex(KeyError, "did you mean 'frames.counts.corners.mean'"):
            run["frames.counts.corner.mean"]
        self.assertEqual(run["summary.detected"], 1)
        self.assertIsInstance(run["summary.detected"], int)

    def test_a_sweep_is_read(self):
        sweep = markervp.sweep(CLOCKS, output="out/clocks")
        self.assertEqual([point["ps.fclk_clk1.frequency"] for point in sweep], ["25 MHz", "50 MHz", "100 MHz"])
        self.assertEqual([point["feasible"] for point in sweep], ["yes", "yes", "no"])
        rates = [point["summary.fps.mean"] for point in sweep]
        self.assertEqual(rates, sorted(rates))
        self.assertEqual([point["ps.fclk_clk1.frequency"] for point in sweep.front()], ["50 MHz"])
        self.assertEqual(len(sweep.front(["min summary.fps.mean"], ["summary.fps.mean > 1"])), 1)
        rows = sweep.sql("select value from metrics where name = ? order by value", ["summary.fps.mean"])
        self.assertEqual([row[0] for row in rows], rates)
        self.assertEqual(len(markervp.read_sweep("out/clocks")), 3)
        again = sweep.run(sweep.points[1], "again")
        self.assertAlmostEqual(again["summary.fps.mean"], rates[1])

    def test_a_search_is_read(self):
        study = {**CLOCKS, "search": {"points": 2, "generation": 2}}
        self.assertEqual(len(markervp.explore(study, output="out/found", options=["--no-report"])), 2)

    def test_what_is_wrong_is_told(self):
        with self.assertRaisesRegex(markervp.Error, "did you mean 'ps.fclk_clk1.frequency'") as wrong:
            markervp.run(set={"ps.fclk_clk1.freqency": "40 MHz"})
        self.assertEqual(wrong.exception.code, 2)
        with self.assertRaisesRegex(markervp.Error, "varies nothing"):
            markervp.sweep({"title": "Nothing"})

    def test_an_error_is_one_line_that_commands_nothing(self):
        self.assertEqual(str(markervp.Error("a\n\x1b[31m\t\x85\u202e b", None)), "a\\n\\x1b[31m\\t\\x85\\u202e b")
        with self.assertRaises(markervp.Error) as wrong:
            markervp.run(["no\x1b[31m\u202ene.png"])
        self.assertIn("no\\x1b[31m\\u202ene.png", str(wrong.exception))

    def test_points_that_fail_are_results(self):
        sweep = markervp.sweep({"parameters": {"pl.width": ["640 px", "600 px"]}, "metrics": ["summary.fps.mean"]})
        self.assertEqual([point["status"] for point in sweep], ["done", "failed"])
        self.assertIsNone(sweep.points[1]["summary.fps.mean"])
        self.assertTrue(sweep.points[1]["message"])

    def test_pandas_where_it_is(self):
        sweep = markervp.sweep(CLOCKS, output="out/clocks", options=["--limit", "2"])
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("no pandas")
        self.assertEqual(list(sweep.frame()["ps.fclk_clk1.frequency"]), ["25 MHz", "50 MHz"])

    def test_the_notebook_runs(self):
        notebook = json.loads((sources / "docs/exploration.ipynb").read_text(encoding="utf-8"))
        names = {}
        for cell in notebook["cells"]:
            if cell["cell_type"] == "code":
                exec("".join(cell["source"]), names)  # noqa: S102
        self.assertTrue(names["best"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
