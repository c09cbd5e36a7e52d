"""Least squares of calibration/fit.py."""
import random
import unittest

import fit


def samples(coefficients, count=20, noise=0.0, seed=1):
    numbers = random.Random(seed)
    made = []
    for _ in range(count):
        counts = {name: numbers.randrange(1, 1000) for name in coefficients}
        total = sum(coefficients[name] * counts[name] for name in coefficients)
        made.append((counts, total * (1 + noise * numbers.uniform(-1, 1))))
    return made


class Fit(unittest.TestCase):
    def test_exact_data_give_their_coefficients(self):
        wanted = {"pixels": 12.5, "corners": 340.0, "rows": 7.0}
        found = fit.fit(samples(wanted), list(wanted))
        for name, value in wanted.items():
            self.assertAlmostEqual(found[name], value, places=6)

    def test_leave_one_out_is_zero_for_exact_data(self):
        wanted = {"pixels": 3.0, "corners": 50.0}
        self.assertLess(max(fit.leave_one_out(samples(wanted), list(wanted))), 1e-6)

    def test_leave_one_out_sees_work_that_is_not_counted(self):
        data = samples({"pixels": 3.0, "corners": 50.0})
        self.assertGreater(max(fit.leave_one_out(data, ["pixels"])), 10)

    def test_no_coefficient_is_negative(self):
        data = samples({"pixels": 10.0, "corners": -2.0}, noise=0.01)
        found = fit.fit(data, ["pixels", "corners"])
        self.assertEqual(found["corners"], 0.0)
        self.assertGreater(found["pixels"], 0.0)

    def test_columns_without_data_get_nothing(self):
        found = fit.fit(samples({"pixels": 4.0}), ["pixels", "never"])
        self.assertAlmostEqual(found["pixels"], 4.0)
        self.assertEqual(found["never"], 0.0)

    def test_columns_that_cannot_be_told_apart_leave_the_last_out(self):
        data = [({"pixels": n, "words": n / 32}, 5.0 * n) for n in range(32, 320, 32)]
        found = fit.fit(data, ["pixels", "words"])
        self.assertAlmostEqual(found["pixels"], 5.0)
        self.assertEqual(found["words"], 0.0)


if __name__ == "__main__":
    unittest.main()
