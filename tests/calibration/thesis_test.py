"""The constants of calibration/fit_thesis.py."""
import unittest

import fit_thesis

VALUES = {"corner.delta": 45.16, "corner.hybrid": 6144.63, "blob.delta": 12.9,
          "blob.hybrid": 6144.63, "threshold.ps": 10.34, "identification.share.hybrid.first": 12,
          "identification.speedup": 0.858, "pose.duration": 41.35}


def frame(**stages):
    return {"time_us": {name: 1000 * time for name, time in stages.items()}}


class Constants(unittest.TestCase):
    def setUp(self):
        hybrid = [frame(frame=7.02, identification=0.8, pose=0.02)] * 15
        ps_only = [frame(corner_detection=25.0, threshold=20.68, blob_detection=19.0,
                         identification=0.7, pose=0.02)] * 15
        found = fit_thesis.constants(VALUES, hybrid, ps_only)
        self.by_name = {c.get("kernel") or c["unit"]: c for c in found}

    def test_few_and_each_names_what_it_was_fitted_to(self):
        self.assertLessEqual(len(self.by_name), 8)
        for constant in self.by_name.values():
            self.assertTrue(set(constant["published"]) <= set(VALUES))

    def test_scales_meet_the_published_means(self):
        self.assertAlmostEqual(self.by_name["threshold"]["scale"], 0.5)
        self.assertAlmostEqual(self.by_name["corner_detection"]["scale"] * 25, 51.30463, places=2)
        self.assertAlmostEqual(self.by_name["blob_detection"]["scale"] * 19, 19.04463, places=2)
        self.assertAlmostEqual(self.by_name["pose"]["scale"] * 20, 41.35, places=2)

    def test_identification_meets_share_and_ratio(self):
        cached = 0.7 * self.by_name["identification"]["scale"]
        stalls = self.by_name["grid_samples_dma"]["stall_ns"] * fit_thesis.SAMPLES / 1e6
        rest = 6.2 + 0.04135
        self.assertAlmostEqual((cached + stalls) / (cached + stalls + rest), 0.12, places=4)
        self.assertAlmostEqual(cached / (cached + stalls), 0.858, places=3)


if __name__ == "__main__":
    unittest.main()
