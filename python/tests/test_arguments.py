"""Tests what is said of wrong arguments, files that are not shipped, misspelt members of sensors, and lacking libraries."""
import inspect
import pathlib
import sys
import unittest
import warnings

try:
    import numpy as np
except ImportError:
    print("test_arguments.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

import ortung

WALL = "sonar/range/wallDistance"


class Arguments(unittest.TestCase):
    def refused(self, text, function, *args, **kwargs):
        with self.assertRaises(TypeError) as caught:
            function(*args, **kwargs)
        self.assertEqual(str(caught.exception), text)

    def test_of_unknown_names_name_the_one_that_was_meant(self):
        self.refused("Localization() has no argument 'sed': did you mean 'seed'?",
                     ortung.Localization, "robot.toml", "t.ortung", sed=3)
        self.refused("evaluate() has no argument 'partikles': did you mean 'particles'?",
                     ortung.evaluate, "record:r", "robot.toml", "t.ortung", partikles=3)
        self.refused("learn() has no argument 'heading_step': did you mean 'heading_step_deg'?",
                     ortung.learn, "world.toml", "robot.toml", "t.ortung", heading_step=3)
        self.refused("SensorContainer.add_scalar() has no argument 'sigam': did you mean 'sigma'?",
                     ortung.SensorContainer().add_scalar, WALL, sigam=1)
        self.refused("World() has no argument 'colour', it takes file", ortung.World, "world.toml", colour=2)
        self.refused("Simulation() has no argument 'noize': did you mean 'noise'?", ortung.Simulation, "w.toml", noize=False)

    def test_of_the_wrong_number_are_named(self):
        self.refused("Robot() lacks 'robot', a path, as str or pathlib.Path", ortung.Robot)
        self.refused("SensorContainer.get() takes feature; 2 arguments were given by their places",
                     ortung.SensorContainer().get, WALL, 3)
        self.refused("SensorContainer.get() got 'feature' twice, by its place and by its name",
                     ortung.SensorContainer().get, WALL, feature=WALL)

    def test_of_the_wrong_type_say_which_one_is_right(self):
        self.refused("Robot(): robot is 3, expected a path, as str or pathlib.Path", ortung.Robot, 3)
        self.refused("Localization(): seed is 'x', expected a whole number (int)", ortung.Localization, "r", "t", seed="x")
        self.refused("RecordWriter(): container is 3, expected a SensorContainer or None", ortung.RecordWriter, "r.rec", 3)
        self.refused("SensorContainer.probability(): theta is 'ahead', expected a number (float)",
                     ortung.SensorContainer().probability, 1, 2, "ahead")
        self.refused("learn(): threads is 1.5, expected a whole number (int)", ortung.learn, "w", "r", "t", threads=1.5)
        with self.assertRaisesRegex(TypeError, r"^Localization\(\): seed is -1, expected a whole number that fits"):
            ortung.Localization("r", "t", seed=-1)

        class Odd:
            def __repr__(self):
                raise RuntimeError("no")

        self.refused("Robot(): robot is an Odd, expected a path, as str or pathlib.Path", ortung.Robot, Odd())

    def test_leave_the_errors_of_what_is_called_as_they_are(self):
        with self.assertRaisesRegex(ortung.ConfigError, "nowhere.toml"):
            ortung.Robot("nowhere.toml")
        with self.assertRaisesRegex(TypeError, "the sensor is a class"):
            ortung.SensorContainer().add_sensor(WALL, int)

    def test_of_pictures_are_named_alike(self):
        self.refused("map() has no argument 'lgo': did you mean 'log'?", ortung.draw.map, None, lgo=True)
        self.refused("run(): run is 'x', expected an EvaluatedRun (of evaluate())", ortung.draw.run, "x")
        self.refused("robot(): robot is 'r.toml', expected a Robot (of a robot file: ortung.Robot(FILE))",
                     ortung.draw.robot, "r.toml")
        self.refused("map(): localization is None, expected a Localization (of a robot file and tables: "
                     "ortung.Localization(ROBOT, TABLES))", ortung.draw.map, None)
        self.refused("world(): world is 3, expected a World, or the file of one", ortung.draw.world, 3)
        self.assertEqual(list(inspect.signature(ortung.draw.world).parameters), ["world", "axes"])

    def test_are_told_by_the_help(self):
        for function, words in ((ortung.make, ("record", "ortung.environments()", "docs/learning.md")),
                                (ortung.make_vec, ("threads", "autoreset", "copy", "NextStep", "ortung.environments()")),
                                (ortung.evaluate, ("start: 'global'", "'truth'", "(x, y, theta)", "progress: a function", "any_world")),
                                (ortung.Localization.probability_map, ("features: the name", "pattern", "'*/LRF/*'")),
                                (ortung.SensorContainer.learn_values, ("noise-free readings in metres", "heading_step")),
                                (ortung.sweep.table, ("figures: names", "position_rmse_m"))):
            for word in words:
                self.assertIn(word, function.__doc__)
        self.assertNotIn("The same of", ortung.SensorContainer.learn_values.__doc__)

    def test_are_in_the_help_as_before(self):
        self.assertTrue(ortung.learn.__doc__.startswith("learn(world: object, robot: os.PathLike, out: os.PathLike, "))


class Package(unittest.TestCase):
    def test_shows_its_public_names_only(self):
        shown = [name for name in dir(ortung) if not name.startswith("_")]
        self.assertEqual(shown, sorted({*ortung.__all__, "draw", "multi_agent", "single_agent", "sweep"} - {"__version__"}))
        for name in dir(ortung):
            getattr(ortung, name)


class Files(unittest.TestCase):
    def test_that_are_not_shipped_name_the_nearest(self):
        for kind, file, text in (
                ("robots", "pionier.toml", r"no 'pionier.toml' among the shipped robots \(did you mean 'pioneer.toml'\?\); "
                                           "looked in .*/robots and in"),
                ("robot", "pioneer.toml", r"no shipped 'robot' \(did you mean 'robots'\?\)"),
                ("robots", "nothing", "no 'nothing' among the shipped robots; looked in ")):
            with self.assertRaisesRegex(FileNotFoundError, text):
                ortung.shipped_file(kind, file)

    def test_that_are_absolute_stay(self):
        self.assertEqual(ortung.shipped_file("robots", "/nowhere/r.toml"), pathlib.Path("/nowhere/r.toml"))


class Members(unittest.TestCase):
    def test_that_are_misspelt_are_named(self):
        class Lamp:
            sigma = 0.1
            outlier = 0.2  # not `outliers`
            colour = "red"

            def expected(self, poses):
                return poses[:, 0]

        with self.assertWarnsRegex(UserWarning, f"{WALL}: the sensor's 'outlier' is not used; did you mean 'outliers'?"):
            ortung.SensorContainer().add_sensor(WALL, Lamp())
        Lamp.outliers = 0.2
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            ortung.SensorContainer().add_sensor(WALL, Lamp())


class Probability(unittest.TestCase):
    def test_of_no_reading_is_no_expectation(self):
        container = ortung.SensorContainer()
        self.assertEqual(container.probability(0, 0, 0), -1)
        container.add_scalar(WALL)
        region = ortung.FieldRegion(10, 10, 0.1)
        container.learn_values(WALL, region, np.ones(100))
        container.set_values(1, WALL, 1.0)
        self.assertAlmostEqual(container.probability(0.5, 0.5, 0), 1.0, places=3)


class Needs(unittest.TestCase):
    def test_are_said_in_one_wording(self):
        from ortung._needs import needs
        self.assertEqual(needs("pictures", "Matplotlib", ["python3-matplotlib"], "why"),
                         "pictures need Matplotlib, on Debian 12: apt-get install python3-matplotlib (why)")


if __name__ == "__main__":
    unittest.main()
