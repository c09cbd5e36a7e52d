"""calibration/rtl: one vote a repository, errors of what was left out, and that another model or document is noticed."""

import importlib.util
import io
import json
import os
import pathlib
import tempfile
import unittest
from contextlib import redirect_stderr, redirect_stdout

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATHS = str(ROOT / "tests/data/rtl/paths.csv")
MODEL = ROOT / "data/rtl/xc7.json"
FIGURES = str(ROOT / "data/rtl/synthesis.json")
MODULES = str(ROOT / "tests/data/rtl/modules.csv")


def load(name, file):
    spec = importlib.util.spec_from_file_location(name, ROOT / "calibration/rtl" / file)  # calibration/fit.py is another
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


nets = load("rtl_fit", "fit.py")
counts = load("rtl_modules", "modules.py")


def run(*arguments, program=nets):
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()) as errors:
        return program.main(list(arguments)), errors.getvalue()


def path(repository, count, fan_out, requested_ns=10.0, factor=1.0, cells_ns=2.0, levels=3):
    """A path that obeys 0.4 ns a net, 0.5 of the fan-out's root and a tenth of the slack, times `factor`."""
    slack = min(nets.MOST_SLACK_NS * count, max(0, requested_ns - cells_ns))
    nets_ns = factor * (0.4 * count + 0.5 * (fan_out ** (1 / 3) - 1) + 0.1 * slack)
    return nets.Path(dict(repository=repository, fabric="artix", speed_grade=-1, levels=levels, cells_ns=cells_ns, nets_ns=nets_ns,
                          requested_ns=requested_ns, fan_out=fan_out, nets=count, skew_ns=0, uncertainty_ns=0.1))


def exact(repositories=8):
    return [path(f"r{i}", 2 + (i + k) % 7, 1 + 9 * k * i, 4.0 + 3 * k) for i in range(repositories) for k in range(4)]


class Nets(unittest.TestCase):
    def test_exact_paths_give_their_coefficients(self):
        for found, wanted in zip(nets.Fit(nets.chosen, exact()).without(), (0.4, 0.5, 0.1)):
            self.assertAlmostEqual(found, wanted, places=9)

    def test_a_repository_with_many_paths_has_one_vote(self):
        few = exact() + [path("odd", 3, 20, factor=2)]
        many = exact() + [path("odd", 3, 20, factor=2)] * 50
        for a, b in zip(nets.Fit(nets.chosen, few).without(), nets.Fit(nets.chosen, many).without()):
            self.assertAlmostEqual(a, b, places=9)

    def test_what_is_left_out_has_no_say_in_coefficients_and_band(self):
        paths = exact() + [path("odd", 3, 20, factor=9)]
        fit, by_name = nets.Fit(nets.chosen, paths), nets.groups(paths)
        self.assertAlmostEqual(fit.without("odd")[0], 0.4, places=9)
        low, high = nets.band(fit, by_name, "odd")
        self.assertAlmostEqual(low, 1, places=9)
        self.assertAlmostEqual(high, 1, places=9)
        self.assertGreater(nets.band(fit, by_name)[1], 1.5)

    def test_errors_and_coverage_are_those_promised(self):
        errors = nets.cross_validate(nets.read_paths(PATHS))
        chosen, share, two, three = errors[:4]
        self.assertGreaterEqual(chosen.repositories, 46)
        self.assertLess(chosen.mean, 0.13)
        self.assertLess(chosen.mean_path, 0.13)
        self.assertGreater(chosen.coverage, 0.85)
        self.assertGreater(chosen.coverage_path, 0.85)
        self.assertLess(chosen.mean, three.mean)
        self.assertLess(three.mean, two.mean)
        self.assertLess(two.mean, share.mean)

    def test_clocks_that_leave_nothing_move_what_is_most_likely(self):
        slow = [path(f"t{i}", 3 + i, 5 + k, requested_ns=1.0, factor=1.5 if i else 9.0, cells_ns=1.0) for i in range(3) for k in range(2)]
        paths = exact() + slow
        fit, by_name = nets.Fit(nets.chosen, exact()), nets.groups(slow)
        factor = nets.tight(fit, by_name)
        self.assertGreater(factor, 1.0)
        self.assertLess(factor, 1.5)  # one repository far off has one vote
        self.assertEqual(nets.tight(fit, nets.groups([path("a", 3, 9, requested_ns=90)])), 1.0)
        self.assertTrue(nets.is_tight(paths[-1]))

    def test_fmax_is_better_with_what_tight_clocks_say(self):
        errors = {e.name: e for e in nets.cross_validate(nets.read_paths(PATHS))}
        self.assertLess(errors["the same, Fmax"].mean, errors["the same, Fmax without `tight`"].mean)
        self.assertGreaterEqual(errors["the same, Fmax"].coverage, 0.85)

    def test_nets_that_need_not_be_short_are_longer(self):
        relaxed, tight = path("a", 4, 9, requested_ns=40), path("a", 4, 9, requested_ns=5)
        model = nets.fitted_model(nets.read_paths(PATHS))
        said = [nets.predicted(nets.chosen, (model["per_net_ns"], model["fan_out_ns"], model["slack_share"]), p)
                for p in (relaxed, tight)]
        self.assertGreater(said[0], said[1])

    def test_another_model_is_noticed(self):
        self.assertEqual(run("--check", PATHS, str(MODEL))[0], 0)
        model = json.loads(MODEL.read_text())
        true = model["nets"]["per_net_ns"]
        model["nets"]["per_net_ns"] = 0.5
        with tempfile.TemporaryDirectory() as folder:
            other = os.path.join(folder, "other.json")
            pathlib.Path(other).write_text(json.dumps(model))
            code, errors = run("--check", PATHS, other)
        self.assertEqual(code, 1)
        self.assertIn(f"'per_net_ns' is 0.5, the reports give {true}", errors)

    def test_an_old_document_is_noticed(self):
        self.assertEqual(run("--documented", PATHS, FIGURES, str(ROOT / "docs/rtl-library.md"))[0], 0)
        code, errors = run("--documented", PATHS, FIGURES, str(ROOT / "docs/traces.md"))
        self.assertEqual(code, 1)
        self.assertIn("is old", errors)


def module(repository, vivado, ours, scope="whole design", pairs=0):
    row = {"repository": repository, "module": "m", "scope": scope, "vivado_lut": vivado, "vivado_ff": vivado, "vivado_bram": 0,
           "lut": ours + pairs, "pairs": pairs, "through": 0, "memory": 0, "ff": ours, "bram": 0}
    return counts.Module({name: str(value) for name, value in row.items()})


class Counts(unittest.TestCase):
    def test_a_common_factor_is_the_bias_and_no_error(self):
        errors = counts.Errors("lut", counts.judged([module("a", 100, 150, pairs=20), module("b", 200, 300), module("c", 10, 15)]))
        self.assertAlmostEqual(errors.bias, 1.5)
        self.assertAlmostEqual(errors.mean, 0)
        self.assertAlmostEqual(errors.left_out, 0)

    def test_a_repository_has_one_vote_and_does_not_judge_itself(self):
        errors = counts.Errors("ff", counts.judged([module("a", 100, 200), module("a", 100, 200), module("b", 100, 100), module("c", 100, 100)]))
        self.assertAlmostEqual(errors.bias, 2 ** (1 / 3))
        self.assertAlmostEqual(errors.left_out, (1 + 2 * (1 - 2 ** -0.5)) / 3)

    def test_instances_of_a_design_are_judged_by_their_sum(self):
        parts = counts.judged([module("a", 100, 50, "instance"), module("a", 50, 100, "instance"), module("b", 100, 100)])
        self.assertEqual([(part.vivado["lut"], part.ours["lut"]) for part in parts], [(100, 100), (150, 150)])

    def test_what_nobody_has_says_nothing(self):
        with_memory = module("a", 1, 1)
        with_memory.vivado["bram"] = with_memory.ours["bram"] = 2
        errors = counts.Errors("bram", [with_memory, module("b", 1, 1)])
        self.assertEqual((errors.repositories, errors.left_out), (1, None))

    def test_the_document_has_the_tables(self):
        self.assertEqual(run("--documented", MODULES, str(ROOT / "docs/rtl-library.md"), program=counts)[0], 0)
        code, errors = run("--documented", MODULES, str(ROOT / "docs/traces.md"), program=counts)
        self.assertEqual(code, 1)
        self.assertIn("is old", errors)


if __name__ == "__main__":
    unittest.main()
