"""Tests containers made in Python: features are added, learn, and weigh; docs/python.md."""
import sys
import unittest

try:
    import numpy as np
except ImportError:
    print("test_container.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

import ortung

WALL = "sonar/range/wallDistance"


def corridor():
    return ortung.FieldRegion(40, 10, 0.1)


def learned(**options):
    container = ortung.SensorContainer()
    container.add_scalar(WALL, **options)
    region = corridor()
    container.learn(WALL, region, np.rint(1000 * (4.0 - region.centres[:, 0]))[:, None])
    return container


class Container(unittest.TestCase):
    def test_cells_come_row_by_row(self):
        centres = ortung.FieldRegion(columns=3, rows=2, cell=0.5, x=-1, y=2).centres
        self.assertTrue(np.allclose(centres, [[-0.75, 2.25], [-0.25, 2.25], [0.25, 2.25],
                                              [-0.75, 2.75], [-0.25, 2.75], [0.25, 2.75]]))

    def test_a_scalar_learns_the_corridor(self):
        container = learned(sigma=0.1, outliers=0.02)
        self.assertEqual(container.features, [WALL])
        for x in (0.55, 2.0, 3.25):
            self.assertAlmostEqual(container.expectation(WALL, x, 0.5, 1.0)[0], 4.0 - x, places=3)
        container.set(7, WALL, [1500])
        self.assertEqual(container.get(WALL), [1.5])
        # (1 - outliers) exp(-r^2 / 2 sigma^2) + outliers, of the residual 0.1 m: one sigma
        for x, p in ((2.5, 1.0), (2.6, 0.98 * np.exp(-0.5) + 0.02), (1.0, 0.02)):
            self.assertAlmostEqual(container.probability(x, 0.5, 0.0), p, delta=0.01)

    def test_rows_may_be_of_any_kind(self):
        region = corridor()
        words = np.rint(1000 * (4.0 - region.centres[:, 0])).astype(int)
        for rows in (words[:, None], words[:, None].astype(float), words[:, None].astype(np.uint32),
                     [[one] for one in words.tolist()]):
            container = ortung.SensorContainer()
            container.add_scalar(WALL)
            container.learn(WALL, region, rows)
            self.assertAlmostEqual(container.expectation(WALL, 2.0, 0.5, 0.0)[0], 2.0, places=3)

    def test_poses_of_ones_own(self):
        container = learned()
        container.learn(WALL, corridor(), [[700], []], poses=[(1.05, 0.55, 0), (2.05, 0.55, 0)])
        self.assertAlmostEqual(container.expectation(WALL, 1.05, 0.55, 0)[0], 0.7, places=3)
        for x in (2.05, 3.0):  # nothing was seen there; what was learned before is forgotten
            self.assertTrue(np.isnan(container.expectation(WALL, x, 0.55, 0)[0]))
        container.learn(WALL, corridor(), [[700]], poses=[(1e9, 0, 0)])  # off the map

    def test_what_does_not_fit_is_said_before_anything_is_learned(self):
        container = learned()
        for words, options, error in (
                ([[1]] * 3, {}, "3 readings for 400 poses"),
                ([[1]] * 399 + [[1, 2]], {}, WALL),
                ([[1]], {"poses": [(1, 2)]}, r"\(N, 3\)"),
                ([[1]] * 400, {"heading_step": 0.0}, "heading step")):
            with self.assertRaisesRegex(ValueError, error):
                container.learn(WALL, corridor(), words, **options)
            self.assertAlmostEqual(container.expectation(WALL, 2.0, 0.5, 0.0)[0], 2.0, places=3)
        with self.assertRaises(KeyError):
            container.learn("*/LRF/*", corridor(), [])
        with self.assertRaisesRegex(ValueError, "already"):
            container.add_scalar(WALL)
        for options in ({"max_range": 0}, {"max_range": float("inf")}, {"sigma": 0}, {"sigma": float("nan")},
                        {"outliers": 0}, {"outliers": 1}):
            with self.assertRaisesRegex(ValueError, next(iter(options))):
                container.add_scalar("a/b/c", **options)
        for options in ((0, 3, 0.1), (3, 0, 0.1), (3, 3, 0)):
            with self.assertRaises(ValueError):
                ortung.FieldRegion(*options)

    def test_shipped_files_are_found(self):
        robot = ortung.Robot(ortung.shipped_file("robots", "pioneer.toml"))
        self.assertTrue(any("/LRF/" in name for name in robot.container.features))


if __name__ == "__main__":
    unittest.main()
