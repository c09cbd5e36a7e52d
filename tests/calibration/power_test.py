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


def report(owner, dsp_w, dsp=10, clock_mhz=100):
    row = dict.fromkeys(("total_w", "static_w", "junction_c", "ps_w", "lut", "ff", "bram36", "mmcms", "io_w", "clocks_w",
                         "logic_w", "bram_w"), "0")
    return refit.Report({**row, "repository": owner + "/x", "device": "xc7z020", "dsp": str(dsp), "dsp_w": str(dsp_w),
                         "clock_mhz": str(clock_mhz)})


class Refit(unittest.TestCase):
    def test_an_owner_with_many_reports_has_one_vote(self):
        dsp = refit.KINDS[3]
        reports = [report("a", 0.0)] * 9 + [report("b", 0.01)]
        self.assertAlmostEqual(dsp.fit(reports)["pl.dsp"], 5.0)

    def test_what_is_left_out_was_not_fitted_to(self):
        reports = refit.read_reports(REPORTS)
        of_all = refit.fit_all(reports)
        differs = [r.owner for r, c in refit.left_out(reports) if c != of_all]
        self.assertGreater(len(set(differs)), 15)

    def test_nine_of_ten_totals_that_were_left_out_lie_within_their_bands(self):
        total = refit.cross_validate(refit.read_reports(REPORTS))[4]
        self.assertLess(total.typical, 0.025)
        self.assertLess(abs(total.sum), 0.025)
        self.assertGreater(total.low, 0.9)
        self.assertLess(total.high, 1.1)

    def test_another_table_is_noticed(self):
        self.assertEqual(run(REPORTS, str(TABLE))[0], 0)
        table = json.loads(TABLE.read_text())
        next(e for e in table["entries"] if e["name"] == "pl.dsp")["nominal"] = 10
        with tempfile.TemporaryDirectory() as folder:
            other = os.path.join(folder, "other.json")
            pathlib.Path(other).write_text(json.dumps(table))
            code, errors = run(REPORTS, other)
        self.assertEqual(code, 1)
        self.assertIn("'pl.dsp' is (0.058, 10, 11), the reports give", errors)

    def test_an_old_document_is_noticed(self):
        self.assertEqual(run("--documented", REPORTS, str(ROOT / "docs/power.md"))[0], 0)
        code, errors = run("--documented", REPORTS, str(ROOT / "docs/traces.md"))
        self.assertEqual(code, 1)
        self.assertIn("is old", errors)


if __name__ == "__main__":
    unittest.main()
