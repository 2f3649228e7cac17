"""Tests what notebooks use: robots, containers, tables, readings, MCL, maps."""
import itertools
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

try:
    import numpy as np
except ImportError:
    print("test_notebook.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

import ortung
from forks import in_child

MAPS = pathlib.Path(sys.argv.pop())
PROGRAM = sys.argv.pop()
ROBOT = MAPS / "robots" / "pioneer.toml"


class Notebook(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="ortung-notebook-")
        cls.tables = pathlib.Path(cls.folder.name) / "arena.tables"
        cls.record = pathlib.Path(cls.folder.name) / "run.txt"  # in lines
        world = MAPS / "fields" / "arena.toml"
        subprocess.run([PROGRAM, "learn", "--world", world, "--robot", ROBOT, "--out", cls.tables],
                       check=True, capture_output=True)
        subprocess.run([PROGRAM, "import", "sim", world, "--with-robot", ROBOT, "--option",
                        "duration=8", "--out", cls.record], check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_readings_are_the_lines_of_the_record(self):
        lines = [line.split() for line in self.record.read_text().splitlines()
                 if not line.startswith("#")]
        found = list(ortung.readings(f"record:{self.record}"))
        self.assertEqual(len(found), len(lines))
        for (stamp, feature, words), line in zip(found, lines):
            self.assertEqual((str(stamp), feature), (line[0], line[1]))
            self.assertEqual([str(word) for word in words], line[3:])

    def test_tables_are_what_numpy_reads(self):
        tables = ortung.Tables(self.tables)
        stored = np.load(self.tables)
        names = [name for name in stored.files if name != "meta.json"]
        self.assertEqual(set(tables.arrays), set(names))
        for name in names:
            self.assertTrue(np.array_equal(tables.arrays[name], stored[name]))
        view = next(iter(tables.arrays.values()))
        self.assertFalse(view.flags.writeable or view.flags.owndata)
        self.assertIn("world", str(tables.meta))
        del tables
        view.sum()  # the file stays mapped

    def test_a_container_takes_and_gives_readings(self):
        container = ortung.Robot(ROBOT).container
        scan = next(name for name in container.features if "/LRF/" in name)
        self.assertIsNone(container.get("*/LRF/*"))
        for stamp, feature, words in ortung.readings(f"record:{self.record}"):
            if feature == scan:
                break
        container.set(stamp, scan, words)
        ranges = container.get("*/LRF/*")
        self.assertEqual(container.stamp(scan), stamp)
        self.assertTrue(np.array_equal(container.words(scan), words))
        seen = (words > 0) & (ranges < 7.9)
        self.assertTrue(np.allclose(ranges[seen], words[seen] / 1000.0, atol=1e-5))
        with self.assertRaises(KeyError) as caught:
            container.get("*/sonar9/*")
        self.assertIn(scan, str(caught.exception))
        with self.assertRaises(ValueError) as caught:
            container.set(1, scan, words[:3])
        self.assertIn(scan, str(caught.exception))

    def test_mcl_finds_the_robot_by_own_readings(self):
        own = ortung.Localization(ROBOT, self.tables, seed=3)
        whole = ortung.Localization(ROBOT, self.tables, source=f"record:{self.record}", seed=3)
        estimates = list(whole)
        self.assertGreater(len(estimates), 10)
        truth = None
        moment = []
        for stamp, feature, words in ortung.readings(f"record:{self.record}"):
            if moment and stamp != moment[0][0]:
                for one in moment:
                    own.container.set(*one)
                own.update()
                moment = []
            moment.append((stamp, feature, words))
        truth = whole.container.get("*/groundTruth/*")
        for one in (estimates[-1], own.estimate(stamp)):
            self.assertLess(np.hypot(one.x - truth[0], one.y - truth[1]), 0.3)
            self.assertEqual(one.status, "tracking")
            self.assertLess(np.hypot(one.x - truth[0], one.y - truth[1]), one.protection_m)
            self.assertLess(one.protection_m, 0.5)
            self.assertLess(0.0, one.protection_rad)
            self.assertLess(one.protection_rad, 0.2)
        particles = own.particles
        self.assertEqual(particles.shape[1], 4)
        self.assertAlmostEqual(float(particles[:, 3].sum()), 1.0, places=3)
        self.assertLess(np.hypot(*(np.average(particles[:, :2], axis=0, weights=particles[:, 3])
                                   - truth[:2])), 0.4)

    def test_starts_where_it_is_told(self):
        here = ortung.Localization(ROBOT, self.tables)  # anywhere: nothing to say before readings come
        pose, truth = (1.0, -0.5, 4.0), (1.0, -0.5, 4.0 - 2 * np.pi)
        told = ortung.Localization(ROBOT, self.tables, start=pose)
        here.set_pose(*pose, sigma_position=0.2, sigma_heading=0.1)
        for one in (told, here):
            particles = one.particles
            np.testing.assert_allclose(particles[:, :2].mean(axis=0), truth[:2], atol=0.05)
            self.assertLess(np.abs(np.angle(np.exp(1j * (particles[:, 2] - truth[2])))).max(), 1.0)
        by_hand = here.particles
        n = len(by_hand)
        self.assertGreater(n, 100)
        angles = np.angle(np.exp(1j * (by_hand[:, 2] - truth[2])))
        found = np.cov(by_hand[:, 0], by_hand[:, 1])
        # an estimate of a variance is off by sqrt(2 / n) of it, one of a covariance by sqrt(1 / n)
        np.testing.assert_allclose(found, [[0.04, 0], [0, 0.04]], atol=5 * 0.04 * np.sqrt(2 / n))
        self.assertAlmostEqual(angles.var(), 0.01, delta=5 * 0.01 * np.sqrt(2 / n))
        np.testing.assert_allclose([np.cov(by_hand[:, i], angles)[0, 1] for i in (0, 1)], 0,
                                   atol=5 * 0.02 * np.sqrt(1 / n))
        source = f"record:{self.record}"
        known = ortung.Localization(ROBOT, self.tables, source=source, start="truth")
        first = next(known)
        truth = known.container.get("*/groundTruth/*")
        self.assertEqual(first.status, "tracking")
        self.assertLess(np.hypot(first.x - truth[0], first.y - truth[1]), 0.2)
        for start in ("nowhere", "", "Truth"):
            with self.assertRaisesRegex(ValueError, f"start is '{start}', expected 'global', 'truth' or"):
                ortung.Localization(ROBOT, self.tables, start=start)
        for start, shown in (((1, 2), r"\(1, 2\)"), (None, "None"), ((1, 2, "x"), r"\(1, 2, 'x'\)"),
                             ([0.0] * 100, "of the type list")):
            with self.assertRaisesRegex(ValueError, f"^start is {shown}, expected 'global', 'truth' or .x, y, theta.$"):
                ortung.Localization(ROBOT, self.tables, start=start)
            with self.assertRaisesRegex(ValueError, f"^start is {shown}, expected 'global', 'truth' or .x, y, theta.$"):
                ortung.evaluate(source, ROBOT, self.tables, start=start)

    def test_maps_have_their_peak_at_the_robot(self):
        whole = ortung.Localization(ROBOT, self.tables, source=f"record:{self.record}")
        for _ in whole:
            pass
        truth = whole.container.get("*/groundTruth/*")
        chart = whole.probability_map(["*/LRF/*"])
        left, right, low, high = whole.extent
        rows, columns = chart.shape
        row, column = np.unravel_index(np.nanargmax(chart), chart.shape)
        x = left + (column + 0.5) * (right - left) / columns
        y = low + (row + 0.5) * (high - low) / rows
        self.assertLess(np.hypot(x - truth[0], y - truth[1]), 0.5)
        expected = whole.expectation_map("*/LRF/*", 90, truth[2])
        self.assertEqual(expected.shape, chart.shape)
        here = whole.container.expectation("*/LRF/*", *truth)[90]
        cell = expected[int((truth[1] - low) / (high - low) * rows),
                        int((truth[0] - left) / (right - left) * columns)]
        self.assertLess(abs(here - cell), 0.5)

    def test_maps_of_what_is_not_there_name_what_is(self):
        here = ortung.Localization(ROBOT, self.tables, source=f"record:{self.record}")
        next(here)
        np.testing.assert_array_equal(here.probability_map("*/LRF/*"), here.probability_map(["*/LRF/*"]))
        scan = next(one for one in here.container.features if "/LRF/" in one)
        for pattern in ("*/lidar/*", ["*/lidar/*"], ["*/odometry/*"]):
            text = pattern if isinstance(pattern, str) else pattern[0]
            with self.assertRaises(KeyError) as caught:
                here.probability_map(pattern)
            self.assertIn(f"no feature that localizes fits '{text}'; there are {scan}", str(caught.exception))
        with self.assertRaisesRegex(ValueError, "'scan' is not model/type/feature.*; there are .*" + scan):
            here.probability_map("scan")
        with self.assertRaisesRegex(ValueError, "features is empty"):
            here.probability_map([])
        with self.assertRaisesRegex(TypeError, r"features is 3, expected a text \(str\) or a list of any length, each a text"):
            here.probability_map(3)
        with self.assertRaisesRegex(KeyError, f"there is no feature a/b/c; there are .*{scan}"):
            here.expectation_map("a/b/c")

    def test_threads_take_turns_at_a_localization(self):
        def estimates(others):
            here = ortung.Localization(ROBOT, self.tables, source=f"record:{self.record}", seed=3)
            stop, failures = threading.Event(), []

            def look():
                try:
                    while not stop.is_set():
                        here.particles, here.estimate(0), here.container.get("*/LRF/*")
                        here.probability_map(["*/LRF/*"], [0.0])
                except BaseException as error:
                    failures.append(error)

            threads = [threading.Thread(target=look) for _ in range(others)]
            for one in threads:
                one.start()
            try:
                found = [(one.x, one.y, one.theta) for one in here]
            finally:
                stop.set()
                for one in threads:
                    one.join()
            self.assertEqual(failures, [])
            return found

        self.assertEqual(estimates(2), estimates(0))

    def test_a_forked_process_has_readings_of_its_own(self):
        here = ortung.Localization(ROBOT, self.tables, source=f"record:{self.record}", threads=2)
        own, twin = (ortung.Localization(ROBOT, self.tables, threads=2) for _ in range(2))
        readings = ortung.readings(f"record:{self.record}")
        next(here), next(readings)
        moment = {feature: (stamp, words) for stamp, feature, words in
                  itertools.islice(ortung.readings(f"record:{self.record}"), 100)}

        def update(one):
            for feature, (stamp, words) in moment.items():
                one.container.set(stamp, feature, words)
            return repr(one.update())

        for work, expected in (
                (lambda: next(here), "RuntimeError: the readings of this Localization were opened before"),
                (lambda: next(readings), "RuntimeError: these Readings were opened before this process"),
                (lambda: here.particles.shape, str(here.particles.shape)),
                (lambda: update(own), update(twin))):
            self.assertIn(expected, in_child(work))

    def test_errors_keep_file_and_line(self):
        bad = pathlib.Path(self.folder.name) / "bad.toml"
        bad.write_text(ROBOT.read_text() + "\nnonsense = [\n")
        with self.assertRaises(ortung.ConfigError) as caught:
            ortung.Robot(bad)
        self.assertRegex(str(caught.exception), r"bad\.toml.*\d+")
        torn = pathlib.Path(self.folder.name) / "torn.tables"
        torn.write_bytes(self.tables.read_bytes()[:1000])
        with self.assertRaises(ortung.TableError) as caught:
            ortung.Tables(torn)
        self.assertIn("torn.tables", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
