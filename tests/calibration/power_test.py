"""calibration/power/refit.py: one vote an owner, bands from what was left out, and that another table is noticed."""

import io
import json
import os
import pathlib
import tempfile
import unittest
from contextlib import redirect_stderr, redirect_stdout

from power import refit

ROOT = pathlib.Path(__file__).resolve().parents[2]
REPORTS = str(ROOT / "tests/data/power/reports.csv")
TABLE = ROOT / "data/power/zynq7020.json"


def run(*arguments):
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()) as errors:
        return refit.main(list(arguments)), errors.getvalue()


def report(family, **values):
    numbers = ("total_w", "static_w", "junction_c", "ps_w", "clock_mhz", "lut", "ff", "bram36", "dsp", "mmcms", "mmcm_w", "plls",
               "pll_w", "io_w", "xadc_w", "clocks_w", "logic_w", "bram_w", "dsp_w")
    row = {**dict.fromkeys(numbers, "0"), "set": "other", "family": family, "vivado": "2020.1", "device": "xc7z020",
           "clocks_mhz": "", "mmcm_mhz": "", "mmcm_fractional_mhz": ""}
    return refit.Report({**row, **{name: str(value) for name, value in values.items()}})


class Refit(unittest.TestCase):
    def test_a_family_with_many_reports_has_one_vote(self):
        dsp = refit.KINDS[3]
        multipliers = {"dsp": 10, "clock_mhz": 100}
        reports = [report("a", dsp_w=0.0, **multipliers)] * 9 + [report("b", dsp_w=0.01, **multipliers)]
        self.assertAlmostEqual(dsp.fit(reports)["pl.dsp"], 5.0)

    def test_clock_nets_and_loads_are_told_apart(self):
        def tree(family, clocks_mhz, ff, factor=1):
            nets = sum(map(float, clocks_mhz.split()))
            branches = (ff / 1000) ** 0.5 * 100
            return report(family, lut=500, ff=ff, clock_mhz=100, clocks_mhz=clocks_mhz,
                          clocks_w=factor * (1e-5 * nets + 2e-5 * branches + 3e-8 * ff * 100))
        trees = [tree("a", "100", 1000), tree("b", "100 200 50", 4000), tree("c", "100 10", 9000), tree("d", "100 50", 250),
                 tree("e", "100", 2000)]
        clocks = refit.KINDS[1]
        for reports in (trees, [*trees, tree("f", "100", 3000, factor=3)]):  # one that is far off pulls none with it
            fitted = clocks.fit(reports)
            self.assertAlmostEqual(fitted["pl.clock_root"], 0.01, 4)
            self.assertAlmostEqual(fitted["pl.clock_branch"], 0.02, 4)
            self.assertAlmostEqual(fitted["pl.clock"], 0.03, 4)

    def test_no_coefficient_is_negative(self):
        rows = [([1.0, 1.0], 1), ([1.0, 2.0], 1), ([1.0, 3.0], 1)]
        self.assertEqual(refit.least_absolute([([a, -b], w) for (a, b), w in rows])[1], 0)

    def test_clock_managers_are_told_apart_by_their_oscillators(self):
        def managers(family, whole, fractional):
            ghz = [float(mhz) / 1e3 for mhz in (whole + " " + fractional).split()]
            extra = 0.02 * sum(float(mhz) for mhz in fractional.split()) / 1e3
            return report(family, mmcms=len(ghz), mmcm_mhz=whole, mmcm_fractional_mhz=fractional,
                          mmcm_w=0.05 * len(ghz) + 0.06 * sum(ghz) + extra)
        fitted = refit.KINDS[4].fit([managers("a", "600", ""), managers("b", "1000", ""), managers("c", "", "800"),
                                     managers("d", "1200 900", "1100")])
        for name, watts in (("pl.mmcm", 0.05), ("pl.mmcm_oscillator", 0.06), ("pl.mmcm_fractional", 0.02)):
            self.assertAlmostEqual(fitted[name], watts, 4)
        self.assertFalse(refit.KINDS[4].applies(report("e", mmcms=2, mmcm_mhz="1000", mmcm_w=0.2)))  # one is not known

    def test_memories_and_older_tools_leak(self):
        def leaking(family, bram36, vivado="2020.1", device="xc7z020"):
            beyond_w = 5e-5 * bram36 * refit.Leakage.growth(45) + (0.012 if vivado < "2018" else 0)
            return report(family, bram36=bram36, junction_c=45, vivado=vivado, device=device,
                          static_w=refit.Leakage.curve(device, 45) + beyond_w)
        fitted = refit.Leakage.fit([leaking(*of) for of in (
            ("a", 0), ("b", 40), ("c", 7, "2016.4"), ("d", 0, "2020.1", "xc7z010"), ("e", 9, "2017.2", "xc7z010"))])
        self.assertAlmostEqual(fitted["static.bram"], 0.05)
        self.assertAlmostEqual(fitted["static.older_tool_7020"], 0.012)
        self.assertAlmostEqual(fitted["static.older_tool_7010"], 0.012)
        self.assertFalse(report("f", vivado="2017.3").older_tool)

    def test_what_is_left_out_was_not_fitted_to(self):
        reports = refit.read_reports(REPORTS)
        of_all = refit.fit_all(reports)
        differs = [r.family for r, c in refit.left_out(reports) if c != of_all]
        self.assertGreater(len(set(differs)), 50)

    def test_totals_that_were_left_out_are_right_and_lie_within_their_bands(self):
        validation = refit.Validation(refit.read_reports(REPORTS))
        total = validation.totals[0]
        self.assertLess(total.mean, 0.015)
        self.assertLess(total.typical, 0.005)
        self.assertLess(total.most, 0.045)
        self.assertLess(abs(total.sum), 0.01)
        self.assertLess(validation.kinds[1].typical, 0.15)
        self.assertLess(validation.kinds[1].mean, 0.18)
        self.assertLess(validation.kinds[4].mean, 0.02)
        alone = next(of for of in validation.totals if of.name == "total, PL alone")
        self.assertEqual(alone.count, 8)
        self.assertLess(alone.mean, 0.035)
        self.assertGreaterEqual(validation.inside, 0.9)
        self.assertLess(validation.width, 0.05)

    def test_another_table_is_noticed(self):
        self.assertEqual(run(REPORTS, str(TABLE))[0], 0)
        table = json.loads(TABLE.read_text())
        next(e for e in table["entries"] if e["name"] == "pl.dsp")["nominal"] = 10
        with tempfile.TemporaryDirectory() as folder:
            other = os.path.join(folder, "other.json")
            pathlib.Path(other).write_text(json.dumps(table))
            code, errors = run(REPORTS, other)
        self.assertEqual(code, 1)
        self.assertIn("'pl.dsp' is (0, 10, 11.5), the reports give", errors)

    def test_an_old_document_is_noticed(self):
        self.assertEqual(run("--documented", REPORTS, str(ROOT / "docs/power.md"))[0], 0)
        code, errors = run("--documented", REPORTS, str(ROOT / "docs/traces.md"))
        self.assertEqual(code, 1)
        self.assertIn("is old", errors)


if __name__ == "__main__":
    unittest.main()
