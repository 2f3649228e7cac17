"""Tests readings in metres and radians: which words they are, in each format, and what none can be; docs/python.md."""
import math
import sys
import unittest

try:
    import numpy as np
except ImportError:
    print("test_values.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

import ortung

NAN, INF = math.nan, math.inf
ZERO = 2**31      # of what has a sign
AHEAD = 18000     # of angles, in 1/100 degree
NOBODY = 2**24    # an object's colour that is not known
BALL, GOALS = "omnivision/camera/ball", "omnivision/camera/goals"

# robot, feature, values, and the words that help() says they are: by hand
READINGS = (
    ("msl_omni", "odometry/odometry/pose", [1.5, -2.25, math.pi / 2, 0.5, -0.125, -math.pi / 4],
     [ZERO + 1500, ZERO - 2250, AHEAD + 9000, ZERO + 500, ZERO - 4500, 2**32 - 1, ZERO - 125]),
    ("msl_omni", "odometry/odometry/pose", [0, 0, 0, 0, 0, 0], [ZERO, ZERO, AHEAD, ZERO, ZERO]),
    ("msl_omni", "reference/groundTruth/pose", [-1.25, 2.5, -math.pi / 2], [ZERO - 1250, ZERO + 2500, AHEAD - 9000]),
    ("msl_omni", "compass/compass/north", [math.pi / 4], [AHEAD + 4500]),
    ("msl_omni", "omnivision/camera/lines", [[1.5, math.pi / 2], [0.25, -math.pi / 4], [3, 0]],
     [1500, AHEAD + 9000, 250, AHEAD - 4500, 3000, AHEAD]),
    ("f2000_player", GOALS, [[1, 2.5, math.pi / 2], [2, 0.75, -math.pi / 4]],
     [1, 2500, AHEAD + 9000, 2, 750, AHEAD - 4500]),
    ("f2000_player", BALL, [[2.5, math.pi / 2, 0.11], [0.75, -math.pi / 4, 0.25]],
     [0, NOBODY, 2500, AHEAD + 9000, 110, 0, NOBODY, 750, AHEAD - 4500, 250]),
    ("pioneer", "omnivision/camera/post3Distance", [1.25], [1250]),
    ("pioneer", "omnivision/camera/post3Bearing", [-math.pi / 2], [AHEAD - 9000]),
    ("sonar_ring", "polaroid/ultrasonic/sonar7", [1.25], [1250]))


def container_of(robot):
    return ortung.Robot(ortung.shipped_file("robots", robot + ".toml")).container


class Values(unittest.TestCase):
    def test_are_the_words_that_help_says(self):
        for robot, feature, values, words in READINGS:
            with self.subTest(feature, values=values):
                container = container_of(robot)
                self.assertIsNone(container.get(feature))
                container.set_values(7, feature, values)
                self.assertEqual(container.words(feature).tolist(), words)
                found = container.get(feature)
                self.assertEqual(found.shape, np.shape(values))
                np.testing.assert_allclose(found, values, atol=1e-12)
                container.set(8, feature, words)
                np.testing.assert_array_equal(container.get(feature), found)
                with self.assertRaisesRegex(ValueError, f"^{feature}: values of the shape .*, expected "):
                    container.set_values(9, feature, [*np.ravel(values), 1])
                self.assertEqual(container.stamp(feature), 8)

    def test_of_a_scan_may_be_invalid_or_see_nothing(self):
        container = container_of("pioneer_lrf")
        scan = "LMS200/LRF/180DegreeScan"
        ranges = np.full(180, 2.0)
        ranges[:4] = [NAN, INF, 0.25, 7.5]
        container.set_values(1, scan, ranges)
        np.testing.assert_allclose(container.get(scan), ranges, atol=1e-6)
        self.assertEqual(container.words(scan)[2:5].tolist(), [250, 7500, 2000])
        for value in (-INF, -0.001):
            ranges[3] = value
            with self.assertRaisesRegex(ValueError, f"value 3 is {value}, expected metres, not negative"):
                container.set_values(2, scan, ranges)
        for wrong in (ranges[:-1], ranges[None, :]):
            with self.assertRaisesRegex(ValueError, "expected 180: a range"):
                container.set_values(2, scan, wrong)
        with self.assertRaisesRegex(TypeError, "set_values"):
            container.set(2, scan, np.full(180, 2.0))
        self.assertEqual(container.stamp(scan), 1)

    def test_of_lists_may_be_none(self):
        for robot, feature, columns in (("f2000_player", GOALS, 3), ("f2000_player", BALL, 3),
                                        ("msl_omni", "omnivision/camera/lines", 2)):
            container = container_of(robot)
            for none in ([], np.empty((0, columns))):
                with self.subTest(feature, none=none):
                    container.set_values(1, feature, none)
                    self.assertEqual(container.words(feature).size, 0)
                    self.assertEqual(container.get(feature).shape, (0, columns))
            for wrong in (1, columns - 1, columns + 1):
                with self.assertRaisesRegex(ValueError, rf"shape \(2, {wrong}\), expected \(n, {columns}\)"):
                    container.set_values(2, feature, np.ones((2, wrong)))

    def test_that_no_reading_has_are_named(self):
        most, signed = (2**32 - 1) / 1000, 2**31 / 1000 - 1  # [m], what words hold; a metre less with a sign
        for robot, feature, values, place, wrong, expected in (
                ("f2000_player", GOALS, [[1, 1, 0], [2, 1, 0]], (1, 0), (1.5, -1, 2**32, NAN), "an identity"),
                ("f2000_player", GOALS, [[1, 1, 0], [2, 1, 0]], (1, 1), (-1, most + 1, INF), "metres, not negative"),
                ("f2000_player", GOALS, [[1, 1, 0], [2, 1, 0]], (1, 2), (-10001, 10001, NAN), "radians"),
                ("f2000_player", BALL, [[1, 1, 1], [1, 1, 1]], (1, 0), (-1, most + 1, NAN), "metres, not negative"),
                ("f2000_player", BALL, [[1, 1, 1], [1, 1, 1]], (1, 1), (-10001, INF), "radians"),
                ("f2000_player", BALL, [[1, 1, 1], [1, 1, 1]], (1, 2), (-1, most + 1), "metres, not negative"),
                ("msl_omni", "omnivision/camera/lines", [[1, 1], [1, 1]], (1, 0), (-1, most + 1), "metres, not negative"),
                ("msl_omni", "omnivision/camera/lines", [[1, 1], [1, 1]], (1, 1), (-10001, NAN), "radians"),
                *(("msl_omni", "odometry/odometry/pose", [0] * 6, (i,), (-signed - 1, signed + 1, NAN), "metres")
                  for i in (0, 1, 3, 4)),
                *(("msl_omni", "odometry/odometry/pose", [0] * 6, (i,), (-10001, 10001, NAN), "radians") for i in (2, 5)),
                *(("msl_omni", "reference/groundTruth/pose", [0] * 3, (i,), (-signed - 1, signed + 1), "metres")
                  for i in (0, 1)),
                ("msl_omni", "reference/groundTruth/pose", [0] * 3, (2,), (-10001, 10001), "radians"),
                ("msl_omni", "compass/compass/north", [0], (0,), (-10001, 10001), "radians"),
                ("pioneer", "omnivision/camera/post3Distance", [1], (0,), (-1, most + 1), "metres, not negative"),
                ("sonar_ring", "polaroid/ultrasonic/sonar7", [1], (0,), (-1, most + 1), "metres, not negative")):
            container = container_of(robot)
            number = int(np.ravel_multi_index(place, np.shape(values)))
            for value in wrong:
                with self.subTest(feature, place=place, value=value):
                    given = np.array(values, float)
                    container.set_values(1, feature, given)
                    given[place] = value
                    with self.assertRaisesRegex(ValueError, f"^{feature}: value {number} is .*, expected {expected}"):
                        container.set_values(2, feature, given)
                    self.assertEqual(container.stamp(feature), 1)

    def test_other_formats_are_set_by_words(self):
        container = container_of("goalkeeper_scan")
        with self.assertRaisesRegex(ValueError, r"S300/LRF/position: .*format fix .*set\(\).*help\(\)"):
            container.set_values(1, "S300/LRF/position", [1.0])
        container.set(1, "S300/LRF/position", [])
        self.assertEqual(container.get("S300/LRF/position").tolist(), [])


if __name__ == "__main__":
    unittest.main()
