"""Tests containers made in Python: features are added, learn, and weigh; docs/python.md."""
import sys
import threading
import unittest

try:
    import numpy as np
except ImportError:
    print("test_container.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

import ortung
from forks import in_child, in_children_while

WALL = "sonar/range/wallDistance"


def corridor():
    return ortung.FieldRegion(40, 10, 0.1)


def learned(**options):
    container = ortung.SensorContainer()
    container.add_scalar(WALL, **options)
    region = corridor()
    container.learn_values(WALL, region, 4.0 - region.centres[:, 0])
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

    def test_words_are_learned_as_values_are(self):
        region = corridor()
        words = np.rint(1000 * (4.0 - region.centres[:, 0])).astype(np.uint32)[:, None]
        for rows in (words, words.tolist(), [tuple(one) for one in words], words.astype(">u4")):
            container = ortung.SensorContainer()
            container.add_scalar(WALL)
            container.learn(WALL, region, rows)
            self.assertAlmostEqual(container.expectation(WALL, 2.0, 0.5, 0.0)[0], 2.0, places=3)

    def test_words_are_not_made_of_other_numbers(self):
        container = learned()
        container.set(1, WALL, [1500])
        for words, error, text in (
                (np.full(1, 2.0), TypeError, "float64, expected uint32.*set_values"),
                (np.full(1, -2.9), TypeError, "float64"), (np.full(1, 2), TypeError, "int64"),
                (np.full(1, True), TypeError, "bool"), (np.full(1, 2, np.uint64), TypeError, "uint64"),
                (np.full((1, 1), 2, np.uint32), ValueError, "shape"), ([2.0], TypeError, "word 0 is 2.0"),
                ([True], TypeError, "True"), (["2"], TypeError, "'2'"), ([-1], ValueError, "word 0 is -1"),
                ([2**32], ValueError, "4294967296"), ([2**80], ValueError, "uint32"),
                (2, TypeError, "iter")):
            with self.subTest(words=words):
                with self.assertRaisesRegex(error, text):
                    container.set(2, WALL, words)
                with self.assertRaisesRegex(error, text):
                    container.learn(WALL, corridor(), [words], poses=[(1, 0.5, 0)])
        self.assertEqual(container.get(WALL), [1.5])
        self.assertAlmostEqual(container.expectation(WALL, 2.0, 0.5, 0.0)[0], 2.0, places=3)

    def test_values_are_written_as_words(self):
        container = learned()
        for value, words in (([1.5], [1500]), (1.5, [1500]), (np.float32(0.25), [250]), ([], []),
                             ([np.nan], []), (2, [2000])):
            container.set_values(3, WALL, value)
            self.assertEqual(container.words(WALL).tolist(), words)
        for value, error, text in (
                ([-2.9], ValueError, "value 0 is -2.9, expected metres, not negative"),
                ([np.inf], ValueError, "inf"), ([1e9], ValueError, "metres"),
                ([1, 2], ValueError, r"shape \(2,\), expected 1"), ([2j], TypeError, "complex"),
                ([True], TypeError, "bool"), (["2"], TypeError, "real numbers"), (None, TypeError, "object")):
            with self.subTest(value=value), self.assertRaisesRegex(error, WALL + ".*" + text):
                container.set_values(4, WALL, value)
        self.assertEqual(container.stamp(WALL), 3)
        with self.assertRaises(KeyError):
            container.set_values(4, "a/b/c", [1])

    def test_threads_may_read_set_and_learn(self):
        container = learned()
        failures = []

        def work(number):
            try:
                for i in range(50):
                    container.set_values(i, WALL, 1.5)
                    container.get(WALL), container.probability(2.5, 0.5, 0.0)
                    container.expectation(WALL, 2.0, 0.5, 0.0), container.features
                    if i % 10 == 0:
                        container.add_scalar(f"a/b/c{number}-{i}")
                        container.learn_values(WALL, corridor(), 4.0 - corridor().centres[:, 0])
            except BaseException as error:
                failures.append(error)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for one in threads:
            one.start()
        for one in threads:
            one.join()
        self.assertEqual(failures, [])

    def test_poses_of_ones_own(self):
        container = learned()
        container.learn(WALL, corridor(), [[700], []], poses=[(1.05, 0.55, 0), (2.05, 0.55, 0)])
        self.assertAlmostEqual(container.expectation(WALL, 1.05, 0.55, 0)[0], 0.7, places=3)
        for x in (2.05, 3.0):  # nothing was seen there; what was learned before is forgotten
            self.assertTrue(np.isnan(container.expectation(WALL, x, 0.55, 0)[0]))
        container.learn(WALL, corridor(), [[700]], poses=[(1e9, 0, 0)])  # off the map

    def test_what_was_learned_last_is_the_reading_at_the_time_0(self):
        container = learned()
        container.set(5, WALL, [1500])
        container.learn(WALL, corridor(), [[700], [900]], poses=[(1.05, 0.55, 0), (2.05, 0.55, 0)])
        self.assertEqual((container.get(WALL).tolist(), container.words(WALL).tolist(), container.stamp(WALL)),
                         ([0.9], [900], 0))

    def test_a_scalar_says_how_far_it_reads(self):
        container = ortung.SensorContainer()
        container.add_scalar(WALL)
        container.add_scalar("a/b/c", max_range=2.5)
        self.assertEqual([container.format(one) for one in (WALL, "a/b/c")], ["range max_m=20", "range max_m=2.5"])

    def test_a_process_that_was_forked_gets_no_container_in_use(self):
        container = learned()
        region = ortung.FieldRegion(200, 200, 0.1)
        distances = 20.0 - region.centres[:, 0]

        def look():
            return container.get(WALL).size

        self.assertEqual(in_child(look), "1")
        found = in_children_while(lambda: container.learn_values(WALL, region, distances), look)
        self.assertEqual(in_child(look), "1")
        refused = ("RuntimeError: this SensorContainer was in use by another thread when this process was forked; "
                   "make another one here")
        self.assertLessEqual(found, {refused, "1"})
        self.assertIn(refused, found)

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
        for options in ((0, 3, 0.1), (3, 0, 0.1), (3, 3, 0), (-1, 3, 0.1), (3, -1, 0.1), (-3, -3, 0.1), (3, 3, -0.1),
                        (3, 3, np.nan), (3, 3, np.inf), (3, 3, 0.1, np.nan), (3, 3, 0.1, 0, np.inf)):
            with self.assertRaisesRegex(ValueError, "field region: the grid must have cells of positive, finite size"):
                ortung.FieldRegion(*options)

    def test_names_of_features_are_told_with_what_there_is(self):
        class Sensor:
            sigma = 1.0

            def expected(self, poses):
                return poses[:, :1]

        container = ortung.SensorContainer()
        for call in (lambda: container.add_scalar("scan"), lambda: container.add_sensor("scan", Sensor())):
            with self.assertRaisesRegex(ValueError, "^found 'scan': a feature's name is model/type/feature, with two '/'$"):
                call()
        with self.assertRaisesRegex(ValueError, "^found 'scan': .*; there is none$"):
            container.set_values(0, "scan", 1.0)
        container.add_scalar("a/b/wall")
        for call in (lambda: container.set_values(0, "scan", 1.0), lambda: container.set(0, "scan", [1])):
            with self.assertRaisesRegex(ValueError, "^found 'scan': .*, with two '/'; there are a/b/wall$"):
                call()
        with self.assertRaisesRegex(KeyError, "there is no feature a/b/wal .did you mean 'a/b/wall'..; there are a/b/wall"):
            container.get("a/b/wal")

    def test_shipped_files_are_found(self):
        robot = ortung.Robot(ortung.shipped_file("robots", "pioneer.toml"))
        self.assertTrue(any("/LRF/" in name for name in robot.container.features))


if __name__ == "__main__":
    unittest.main()
