"""Tests of what is tried out in Python: sensors, players, worlds, pictures."""
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

try:
    import numpy as np
except ImportError:
    print("test_trying.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

import ortung

MAPS = pathlib.Path(sys.argv.pop())
ROBOT = MAPS / "robots" / "pioneer.toml"
ARENA = MAPS / "fields" / "arena.toml"
LAMP, OTHER = np.array([-2.0, 1.0]), np.array([1.5, -1.5])


class Lamp:
    """How bright a lamp is: a quarter at each doubling of the way, and the way above the floor is 1 m."""

    sigma = 0.02
    outliers = 0.03

    def expected(self, poses):
        assert np.isfinite(poses).all()
        return 1.0 / (1.0 + ((poses[:, :2] - LAMP) ** 2).sum(axis=1))


class Bearing:
    """The direction of a lamp from the robot, its p written by hand."""

    def __init__(self, lamp=LAMP):
        self.lamp = lamp

    def read(self, pose):
        way = self.lamp - pose[:2]
        return np.arctan2(way[1], way[0]) - pose[2]

    def probability(self, reading, poses):
        way = self.lamp - poses[:, :2]
        off = np.arctan2(way[:, 1], way[:, 0]) - poses[:, 2] - reading[0]
        return 0.95 * np.exp(-0.5 * (np.angle(np.exp(1j * off)) / 0.05) ** 2) + 0.05


class Sensors(unittest.TestCase):
    def test_weigh_by_what_they_expect(self):
        container = ortung.SensorContainer()
        container.add_sensor("me/lamp/brightness", Lamp())
        self.assertEqual(container.probability(0, 0, 0), -1.0)  # no reading yet: nothing expected
        container.set_values(1, "me/lamp/brightness", 0.25)
        # The lamp is at sqrt(5) m from (0, 0): 1 / 6 are expected there.
        r = (0.25 - 1.0 / 6.0) / 0.02
        self.assertAlmostEqual(container.probability(0, 0, 0), 0.97 * np.exp(-0.5 * r * r) + 0.03, 5)
        self.assertAlmostEqual(container.expectation("me/lamp/*", 0, 0, 0)[0], 1.0 / 6.0, 6)
        np.testing.assert_array_equal(container.get("*/lamp/*"), [0.25])
        self.assertEqual(container.words("*/lamp/*"), np.float32(0.25).view(np.uint32))
        self.assertEqual(container.format("*/lamp/*"), "numbers count=1")
        self.assertIn("1 numbers", container.help("*/lamp/*"))

    def test_weigh_by_probabilities_of_their_own(self):
        container = ortung.SensorContainer()
        container.add_sensor("me/lamp/bearing", Bearing())
        container.set_values(1, "me/lamp/bearing", [np.pi / 2])
        self.assertAlmostEqual(container.probability(-2, 0, 0), 1.0, 5)
        self.assertAlmostEqual(container.probability(-2, 0, 0.05), 0.95 * np.exp(-0.5) + 0.05, 5)

    def test_learn_if_they_can(self):
        class Table:
            sigma = 0.1

            def __init__(self):
                self.seen = {}

            def learn(self, pose, reading):
                self.seen[tuple(np.round(pose[:2], 3))] = reading[0]

            def expected(self, poses):
                return np.array([self.seen.get(tuple(np.round(one[:2], 3)), np.nan) for one in poses])

        table, container = Table(), ortung.SensorContainer()
        region = ortung.FieldRegion(columns=4, rows=3, cell=0.5)
        container.add_sensor("me/table/x", table)
        container.learn_values("me/table/x", region, region.centres[:, 0])
        self.assertEqual(len(table.seen), 12)
        container.set_values(1, "me/table/x", 0.75)
        self.assertAlmostEqual(container.probability(0.75, 0.25, 0), 1.0, 5)
        self.assertAlmostEqual(container.probability(0.8, 0.25, 0), 0.05, 5)  # nothing expected: the floor

    def test_mistakes_come_back_to_who_asked(self):
        class Broken:
            def probability(self, reading, poses):
                raise LookupError("the lamp is off")

        class Wide:
            sigma = 1.0

            def expected(self, poses):
                return np.zeros((len(poses), 2))

        for sensor, kind, message in ((Broken(), LookupError, "the lamp is off"), (Wide(), ValueError, r"expected \(1, 1\)")):
            container = ortung.SensorContainer()
            container.add_sensor("me/lamp/x", sensor)
            container.set_values(1, "me/lamp/x", 1.0)
            with self.assertRaisesRegex(kind, message):
                container.probability(0, 0, 0)
        container = ortung.SensorContainer()
        for sensor, kind, message in ((3, TypeError, "class 'int'"), (type("S", (), {"sigma": 0, "expected": None})(), ValueError, "sigma")):
            with self.assertRaisesRegex(kind, message):
                container.add_sensor("me/lamp/x", sensor)
        with self.assertRaisesRegex(ValueError, "values is 0"):
            container.add_sensor("me/lamp/x", Lamp(), 0)
        self.assertEqual(container.features, [])

    def test_are_evaluated_by_a_record_with_their_readings(self):
        class Lamps:
            sigma, is_angle = 0.05, True

            def expected(self, poses):
                away = np.array([LAMP, OTHER]) - poses[:, None, :2]
                return np.arctan2(away[..., 1], away[..., 0]) - poses[:, 2, None]

        with tempfile.TemporaryDirectory(prefix="ortung-trying-") as folder:
            robot, tables = pathlib.Path(folder, "robot.toml"), pathlib.Path(folder, "arena.ortung")
            robot.write_text('[robot]\nname = "lamp_finder"\nradius_m = 0.2\n[[sensor]]\nplugin = "odometry"\n')
            ortung.learn(ARENA, robot, tables)
            sensors = {"me/lamp/brightness": Lamp(), "me/lamp/bearings": (Lamps(), 2)}
            sim = ortung.Simulation(ARENA, seed=4)
            it = sim.add_robot(robot, start=(-0.5, -0.2, 0.5))
            it.wander(0.4)
            container = ortung.Robot(robot).container
            container.add_sensor("me/lamp/brightness", Lamp())
            container.add_sensor("me/lamp/bearings", Lamps(), values=2)
            random = np.random.default_rng(7)
            record = f"record:{folder}/run.rec"
            with ortung.RecordWriter(pathlib.Path(folder, "run.rec"), container, sim.world.fingerprint) as writer:
                for cycle in range(1500):
                    sim.step()
                    for reading in it.readings:
                        writer.write(*reading)
                    if cycle % 20 == 0 and it.readings:
                        truth = it.container.get("*/groundTruth/*")[None]
                        stamp = it.readings[0][0]
                        writer.write_values(stamp, "me/lamp/brightness", Lamp().expected(truth)[0] + random.normal(0, 0.01))
                        writer.write_values(stamp, "me/lamp/bearings", Lamps().expected(truth)[0] + random.normal(0, 0.02, 2))
            with self.assertRaisesRegex(RuntimeError, "nothing to localize with"):
                ortung.evaluate(record, robot, tables)
            runs = [ortung.evaluate(record, robot, tables, particles=3000, threads=threads, sensors=sensors) for threads in (1, 2)]
            self.assertLess(runs[0].figures["position_median_m"], 0.1)
            np.testing.assert_array_equal(runs[0].path, runs[1].path)

            class Broken(Lamp):
                def expected(self, poses):
                    raise ZeroDivisionError("no lamp")

            with self.assertRaisesRegex(ZeroDivisionError, "no lamp"):
                ortung.evaluate(record, robot, tables, sensors={"me/lamp/brightness": Broken()})
            Broken.learn = lambda self, pose, reading: None
            with self.assertRaisesRegex(ValueError, r"brightness: the sensor has learn\(\)"):
                ortung.evaluate(record, robot, tables, sensors={"me/lamp/brightness": Broken()})
            with self.assertRaisesRegex(ValueError, "found 'lamp'"):
                ortung.evaluate(record, robot, tables, sensors={"lamp": Lamp()})
            with self.assertRaisesRegex(TypeError, "sensors is 3, expected a dict"):
                ortung.evaluate(record, robot, tables, sensors=3)

    def test_localize_a_robot_with_several_threads(self):
        with tempfile.TemporaryDirectory(prefix="ortung-trying-") as folder:
            robot, tables = pathlib.Path(folder, "robot.toml"), pathlib.Path(folder, "arena.ortung")
            robot.write_text('[robot]\nname = "lamp_finder"\nradius_m = 0.2\n[[sensor]]\nplugin = "odometry"\n')
            ortung.learn(ARENA, robot, tables)
            results = []
            for threads in (1, 2):
                here = ortung.Localization(robot, tables, particles=3000, threads=threads)
                here.container.add_sensor("me/lamp/brightness", Lamp())
                bearings = {"me/lamp/bearing": Bearing(), "me/lamp/other": Bearing(OTHER)}
                for feature, bearing in bearings.items():
                    here.container.add_sensor(feature, bearing)
                sim = ortung.Simulation(ARENA, seed=4)
                it = sim.add_robot(robot, start=(-0.5, -0.2, 0.5))
                it.wander(0.4)
                random = np.random.default_rng(7)
                for cycle in range(1500):
                    sim.step()
                    now = None
                    for stamp, feature, words in it.readings:
                        now = stamp
                        if "odometry" in feature:
                            here.container.set(stamp, feature, words)
                    if cycle % 20 or now is None:
                        continue
                    # The readings are of the pose that odometry's are of, before the robot moved.
                    truth = it.container.get("*/groundTruth/*")
                    here.container.set_values(now, "me/lamp/brightness", Lamp().expected(truth[None]) + random.normal(0, 0.01))
                    for feature, bearing in bearings.items():
                        here.container.set_values(now, feature, bearing.read(truth) + random.normal(0, 0.02))
                    here.update()
                    found = here.estimate(now)
                results.append((found.x, found.y, found.theta))
                self.assertLess(np.hypot(found.x - truth[0], found.y - truth[1]), 0.3)
                self.assertLess(abs(np.angle(np.exp(1j * (found.theta - truth[2])))), 0.2)
            self.assertEqual(*results)


class Players(unittest.TestCase):
    def test_drive_their_robots_by_what_these_read(self):
        class Straight:
            """Drives on until the scanner sees something near, and is done."""

            def __init__(self):
                self.calls = 0

            def sense_and_act(self, robot):
                self.calls += 1
                ranges = robot.container.get("*/LRF/*")
                middle = ranges[80:100]
                if np.nanmin(middle) < 0.6:
                    robot.drive(0.0)
                    return False
                robot.drive(0.5)

        sim = ortung.Simulation(ARENA, noise=False)
        robot = sim.add_robot(ROBOT, start=(0, 0, 0))
        player = Straight()
        robot.play(player)
        sim.step(1500)
        calls = player.calls
        self.assertTrue(100 < calls < 1500)
        # 2 m to the wall at x = 3 would be left; the scanner sits 0.1 m before the middle and stops in front of the box or wall.
        ahead = ortung.World(ARENA).cast([robot.pose], height=0.3)[0]
        self.assertTrue(0.4 < ahead < 0.72, ahead)
        self.assertEqual(robot.velocity, (0.0, 0.0, 0.0))
        sim.step(10)
        self.assertEqual(player.calls, calls)  # it has ended

    def test_see_what_the_same_world_shows(self):
        sim = ortung.Simulation(ARENA, noise=False)
        robot = sim.add_robot(ROBOT, start=(0.3, -0.4, 1.0))
        sim.step()
        x, y, heading = robot.pose
        sensor = (x + 0.1 * np.cos(heading), y + 0.1 * np.sin(heading), heading)
        expected = sim.world.scan([sensor], beams=180, fov=np.pi, max_range=8.0, height=0.3)[0]
        np.testing.assert_allclose(robot.container.get("*/LRF/*"), expected, atol=2e-3)  # words are millimetres
        np.testing.assert_allclose(sim.world.cast([sensor], max_range=8.0), expected[89:91].mean(), rtol=0.05)

    def test_runs_repeat_bit_by_bit(self):
        def run(seed):
            sim = ortung.Simulation(ARENA, seed=seed)
            robot = sim.add_robot(ROBOT)
            robot.wander()
            sim.step(300)
            return robot.pose, [tuple(words) for _, _, words in robot.readings]

        self.assertEqual(run(5), run(5))
        self.assertNotEqual(run(5), run(6))

    def test_who_raises_is_stopped(self):
        class Angry:
            def sense_and_act(self, robot):
                raise OSError("no")

        sim = ortung.Simulation(ARENA)
        robot = sim.add_robot(ROBOT, start=(0, 0, 0))
        robot.play(Angry())
        with self.assertRaisesRegex(OSError, "no"):
            sim.step(10)
        self.assertEqual(sim.now, 10_000)  # the cycle was completed
        sim.step(10)
        self.assertEqual(sim.now, 110_000)
        with self.assertRaisesRegex(TypeError, "sense_and_act"):
            robot.play(7)
        with self.assertRaises(ortung.PluginError):
            robot.play("nobody")
        for wrong in (lambda: robot.drive(float("nan")), lambda: robot.place(99, 0, 0), lambda: sim.step(-1),
                      lambda: sim.add_robot(ROBOT, start=(0, 0, 0)), lambda: robot.set_manipulator("kicker", "kick")):
            with self.assertRaises((ValueError, TypeError)):
                wrong()

    def test_threads_take_turns(self):
        sim = ortung.Simulation(ARENA)
        robot = sim.add_robot(ROBOT)
        robot.wander()
        looks, stop = [], threading.Event()

        def look():
            while not stop.is_set():
                looks.append((robot.pose, robot.container.get("*/LRF/*"), len(robot.readings), repr(sim)))

        thread = threading.Thread(target=look)
        thread.start()
        sim.step(200)
        stop.set()
        thread.join()
        self.assertEqual(sim.now, 2_000_000)


class Worlds(unittest.TestCase):
    def test_have_what_their_file_says(self):
        world = ortung.World(ARENA)
        self.assertEqual(world.extent, (-3.0, 3.0, -2.0, 2.0))
        # Up from (0, 0) the wall's edge is at y = 2; down from (1.2, 0) a box of 0.4 m in height around y = -1.3.
        np.testing.assert_allclose(world.cast([(0, 0, np.pi / 2), (1.2, 0, -np.pi / 2)]), [2.0, 1.1], atol=1e-3)
        self.assertTrue(world.is_free(0, 0, 0.2))
        self.assertFalse(world.is_free(2.95, 0, 0.2))
        self.assertEqual(len(world.landmarks), 4)
        region = world.region(0.1, ROBOT)
        self.assertEqual(region.open.shape, (40, 60))
        self.assertGreater(region.open.sum(), region.standable.sum())
        centres = region.centres.reshape(40, 60, 2)
        for row, column in ((20, 30), (5, 50), (2, 2)):
            x, y = centres[row, column]
            self.assertEqual(bool(region.open[row, column]), world.is_free(x, y, 0.0, 0.5))
        for wrong in (lambda: world.cast([(0, 0)]), lambda: world.cast([(0, 0, np.nan)]), lambda: world.scan([(0, 0, 0)], beams=0),
                      lambda: world.cast([(0, 0, 0)], max_range=0), lambda: world.region(0)):
            with self.assertRaises(ValueError):
                wrong()
        with self.assertRaises(ortung.ConfigError):
            ortung.World("/nonexistent.toml")

    def test_may_be_maps_of_nav2(self):
        with tempfile.TemporaryDirectory(prefix="ortung-trying-") as folder:
            pathlib.Path(folder, "map.pgm").write_bytes(b"P5 20 10 255\n" + bytes(
                0 if x in (0, 19) or y in (0, 9) else 254 for y in range(10) for x in range(20)))
            pathlib.Path(folder, "map.yaml").write_text("image: map.pgm\nresolution: 0.5\norigin: [-5, -2.5, 0]\nnegate: 0\n"
                                                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
            world = ortung.World(pathlib.Path(folder, "map.yaml"))
            # A room of 20 x 10 cells of 0.5 m with a wall of one cell, whose surfaces are in the middle of its cells.
            np.testing.assert_allclose(world.cast([(0, 0, 0), (0, 0, np.pi / 2)]), [4.75, 2.25], atol=1e-5)
            np.testing.assert_allclose(np.abs(world.walls[:, :4]).max(), 4.75, atol=0.05)  # within a tenth of a cell
            learned = ortung.learn(pathlib.Path(folder, "map.yaml"), ROBOT, pathlib.Path(folder, "map.ortung"))
            self.assertEqual(learned["open"], 90 * 40)


class Imports(unittest.TestCase):
    def test_load_only_what_is_needed(self):
        code = ("import sys, ortung; heavy = ('numpy', 'matplotlib', 'gymnasium', 'ortung._sim', 'ortung._learning', 'ortung.draw'); "
                "print([one for one in heavy if one in sys.modules and one != 'gymnasium'])")
        result = subprocess.run([sys.executable, "-c", "import importlib.util as u, sys\n"
                                 "if u.find_spec('gymnasium'): print([])\nelse:\n    " + code.replace("; ", "\n    ")],
                                capture_output=True, text=True, check=True)
        self.assertEqual(result.stdout.strip(), "[]")


class Pictures(unittest.TestCase):
    def test_have_what_they_show(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("Matplotlib is not there (python3-matplotlib)")
        matplotlib.use("Agg")
        with tempfile.TemporaryDirectory(prefix="ortung-trying-") as folder:
            tables, record = pathlib.Path(folder, "arena.ortung"), pathlib.Path(folder, "run.rec")
            ortung.learn(ARENA, ROBOT, tables)
            sim = ortung.Simulation(ARENA)
            robot = sim.add_robot(ROBOT)
            robot.wander()
            with ortung.RecordWriter(record, robot.container) as writer:
                for _ in range(800):
                    sim.step()
                    for one in robot.readings:
                        writer.write(*one)
            here = ortung.Localization(ROBOT, tables, source=f"record:{record}")
            next(here)
            run = ortung.evaluate(f"record:{record}", ROBOT, tables)
            chart = ortung.draw.map(here, log=True, pose=(0, 0, 0))
            self.assertEqual(chart.images[0].get_array().shape, here.probability_map().shape)
            self.assertEqual(tuple(chart.images[0].get_extent()), here.extent)
            self.assertEqual((*chart.get_xlim(), *chart.get_ylim()), here.extent)
            self.assertEqual(chart.get_title(), "")
            fresh = ortung.draw.map(ortung.Localization(ROBOT, tables))
            self.assertEqual(fresh.get_title(), "no reading yet: all poses are equally probable")
            way = ortung.draw.run(run, ARENA)
            truth = next(line for line in way.lines if line.get_label() == "truth")
            np.testing.assert_array_equal(truth.get_xydata(), run.truth[:, :2])
            estimated = next(line for line in way.lines if line.get_label() == "tracking")
            self.assertGreater(truth.get_linewidth(), 1.5 * estimated.get_markersize())  # a band on which estimates lie
            self.assertLess(truth.get_zorder(), estimated.get_zorder())
            way.figure.canvas.draw()
            self.assertGreater(way.get_legend().get_window_extent().x0, way.get_window_extent().x1)  # beside the field
            drawn = sum(len(line.get_xydata()) for line in way.lines if line.get_label() in ("tracking", "uncertain", "lost"))
            self.assertEqual(drawn, len(run.estimates))
            body = ortung.draw.robot(ortung.Robot(ROBOT), pose=(1, 2, 0.5))
            self.assertEqual(body.get_title(), "pioneer")
            ring = ortung.draw.robot(ortung.Robot(ROBOT.parent / "sonar_ring.toml"))
            self.assertEqual(len(ring.lines), 16)  # a dot for each sonar of the ring,
            self.assertEqual(len(ring.get_legend().get_texts()), 1)  # and one name
            field = ortung.draw.world(ortung.World(ARENA))
            self.assertLess(field.get_xlim()[0], -3.0)
            for axes in (chart, way, body, field):
                axes.figure.savefig(pathlib.Path(folder, "picture.png"))
                self.assertGreater(pathlib.Path(folder, "picture.png").stat().st_size, 5000)


if __name__ == "__main__":
    unittest.main()
