"""Tests that Python does what the program does: tables, figures and records are the same."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    print("test_job.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

import ortung

MAPS = pathlib.Path(sys.argv.pop())
PROGRAM = sys.argv.pop()
ROBOT = MAPS / "robots" / "pioneer.toml"
ARENA = MAPS / "fields" / "arena.toml"
TIMES = ("update_ms_p50", "update_ms_p99", "update_ms_max", "realtime_factor")


class Job(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="ortung-job-")
        cls.tables = cls.path("arena.ortung")
        cls.learned = ortung.learn(ARENA, ROBOT, cls.tables)
        cls.record = cls.path("run.rec")
        sim = ortung.Simulation(ARENA, seed=2)
        robot = sim.add_robot(ROBOT)
        robot.wander()
        with ortung.RecordWriter(cls.record, robot.container, sim.world.fingerprint) as record:
            for _ in range(1200):
                sim.step()
                for reading in robot.readings:
                    record.write(*reading)
        cls.source = f"record:{cls.record}"

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def path(cls, name):
        return pathlib.Path(cls.folder.name) / name

    def program(self, *words):
        return subprocess.run([PROGRAM, *map(str, words)], check=True, capture_output=True, text=True).stdout

    def test_tables_have_the_bits_of_the_programs(self):
        other = self.path("program.ortung")
        self.program("learn", "--world", ARENA, "--robot", ROBOT, "--out", other)
        self.assertEqual(self.tables.read_bytes(), other.read_bytes())
        threads = self.path("threads.ortung")
        self.assertEqual(ortung.learn(ortung.World(ARENA), ROBOT, threads, threads=2), self.learned)
        self.assertEqual(threads.read_bytes(), other.read_bytes())
        self.assertEqual(self.learned["bytes"], other.stat().st_size)
        self.assertEqual((self.learned["columns"], self.learned["rows"]), (60, 40))

    def test_learning_can_be_stopped(self):
        out = self.path("none.ortung")

        def stop(share):
            self.assertTrue(0.0 <= share <= 1.0)
            raise StopIteration("enough")

        with self.assertRaisesRegex(StopIteration, "enough"):
            ortung.learn(ARENA, ROBOT, out, progress=stop)
        self.assertFalse(out.exists())
        for wrong, message in ((dict(cell=0), "cell is"), (dict(heading_step_deg=7), "divide a turn"),
                               (dict(threads=0), "threads"), (dict(area="nowhere"), "nowhere")):
            with self.assertRaisesRegex(ValueError, message):
                ortung.learn(ARENA, ROBOT, out, **wrong)

    def test_figures_are_those_of_the_program(self):
        out = self.path("figures.json")
        self.program("eval", "--source", self.source, "--robot", ROBOT, "--tables", self.tables, "--seed", 3, "--json", out)
        expected = json.loads(out.read_text())
        shares = []
        run = ortung.evaluate(self.source, ROBOT, self.tables, seed=3, progress=shares.append)
        self.assertEqual(shares, sorted(shares))

        def compare(found, its, where):
            for name, value in found.items():
                if isinstance(value, dict):
                    compare(value, its[name], where + name)
                elif name not in TIMES:
                    self.assertEqual(None if math.isnan(value) else value, its[name], where + name)

        compare(run.figures, expected, "")
        left = set(expected) - set(run.figures)  # what the command line says, and what Python does not do yet
        self.assertEqual(left, {"source", "robot", "tables", "world", "seed", "particles", "start", "faults", "gaps",
                                "bound_median_m", "bound_rmse_m", "bound_heading_rmse_deg", "ratio_median", "ratio_rmse",
                                "grid_divergence_median", "grid_distance_median_m", "map_gone_cells", "map_new_cells"})
        n = run.figures["compared_moments"]
        self.assertEqual([run.times.shape, run.truth.shape, run.estimates.shape, run.status.shape],
                         [(n,), (n, 3), (n, 3), (n,)])
        np.testing.assert_allclose(np.hypot(*(run.truth - run.estimates)[:, :2].T), run.position_errors, atol=1e-12)
        turned = run.truth[:, 2] - run.estimates[:, 2]
        np.testing.assert_allclose(np.abs(np.angle(np.exp(1j * turned))), run.heading_errors, atol=1e-9)
        later = run.times >= run.figures["converged_after_s"]
        self.assertAlmostEqual(np.sqrt(np.mean(run.position_errors[later]**2)), run.figures["position_rmse_m"], 9)
        self.assertAlmostEqual(np.mean(run.status == "tracking"), run.figures["tracking_share"], 12)
        self.assertEqual(len(run.update_ms), run.figures["steps"])
        self.assertTrue(np.all(np.diff(run.path[:, 0]) >= 0))

    def test_runs_that_cannot_be_are_refused(self):
        with self.assertRaisesRegex(ZeroDivisionError, "stop"):
            def stop(share):
                raise ZeroDivisionError("stop")
            ortung.evaluate(self.source, ROBOT, self.tables, progress=stop)
        with self.assertRaisesRegex(ValueError, "KIND:PATH"):
            ortung.evaluate("", ROBOT, self.tables)
        with self.assertRaisesRegex(ValueError, "above 0"):
            ortung.evaluate(self.source, ROBOT, self.tables, converged_m=0)
        lone = self.path("lone.rec")
        with ortung.RecordWriter(lone) as record:
            record.write(0, "odometry/odometry/pose", next(w for _, f, w in ortung.readings(self.source) if "odometry" in f))
        with self.assertRaisesRegex(RuntimeError, "nothing to localize with"):
            ortung.evaluate(f"record:{lone}", ROBOT, self.tables)

    def test_another_world_must_be_permitted(self):
        other = self.path("other.rec")
        with ortung.RecordWriter(other, ortung.Robot(ROBOT).container, "0" * 16) as record:
            for reading in ortung.readings(self.source):
                record.write(*reading)
        source = f"record:{other}"
        for call in (lambda **more: ortung.evaluate(source, ROBOT, self.tables, **more),
                     lambda **more: ortung.Localization(ROBOT, self.tables, source, **more)):
            with self.assertRaisesRegex(ortung.WorldMismatch, "comes from the world 0{16}, but .* or give any_world=True$"):
                call()
            call(any_world=True)
        permitted = ortung.evaluate(source, ROBOT, self.tables, any_world=True)
        np.testing.assert_array_equal(permitted.path, ortung.evaluate(self.source, ROBOT, self.tables).path)

    def test_nothing_of_another_kind_is_overwritten(self):
        notes = self.path("notes.txt")
        pathlib.Path(notes).write_text("mine\n")
        with self.assertRaisesRegex(FileExistsError, "force=True"):
            ortung.RecordWriter(notes)
        with self.assertRaisesRegex(FileExistsError, "it is a robot file"):
            ortung.learn(ARENA, ROBOT, ROBOT)
        with self.assertRaisesRegex(FileExistsError, "it is a record"):
            ortung.learn(ARENA, ROBOT, self.record)
        self.assertEqual(pathlib.Path(notes).read_text(), "mine\n")
        with ortung.RecordWriter(notes, force=True):
            pass
        with ortung.RecordWriter(notes):  # a record is replaced by a record
            pass
        self.assertTrue(pathlib.Path(notes).read_text().startswith("# ortung record"))

    def test_what_is_misspelt_is_told(self):
        class Sensor:
            sigma = 1.0

            def expected(self, poses):
                return poses[:, :1]

        container = ortung.SensorContainer()
        with self.assertRaisesRegex(TypeError, "is a class, expected an object"):
            container.add_sensor("a/b/c", Sensor)
        container.add_sensor("a/b/c", Sensor())
        with ortung.RecordWriter(self.path("misspelt.rec"), container) as record:
            with self.assertRaisesRegex(KeyError, "did you mean 'a/b/c'"):
                record.write(1, "a/b/d", [1])

    def test_records_are_what_was_written(self):
        copy = self.path("copy.txt")
        readings = list(ortung.readings(self.source))
        container = ortung.Robot(ROBOT).container
        with ortung.RecordWriter(copy, container, ortung.World(ARENA).fingerprint) as record:
            for stamp, feature, words in readings:
                container.set(stamp, feature, words)
                if "LRF" in feature or "groundTruth" in feature:
                    record.write_values(stamp, feature, container.get(feature))
                else:
                    record.write(stamp, feature, words)
        again = ortung.readings(f"record:{copy}")
        for (stamp, feature, words), other in zip(readings, again, strict=True):
            self.assertEqual((stamp, feature), other[:2])
            np.testing.assert_array_equal(words, other[2])
        self.assertEqual(again.world, ortung.World(ARENA).fingerprint)
        for wrong, message in ((lambda r: r.write(5, "a/b", [1]), "model/type/feature"), (lambda r: r.write(5, "a/b/c", [-1]), "uint32"),
                               (lambda r: (r.write(5, "a/b/c", [1]), r.write(4, "a/b/c", [1])), "order of time"),
                               (lambda r: r.write_values(5, "a/b/c", 1.0), "container")):
            torn = self.path("torn.rec")
            with self.assertRaisesRegex(ValueError, message), ortung.RecordWriter(torn) as record:
                wrong(record)
            self.assertFalse(torn.exists())
        with self.assertRaisesRegex(RuntimeError, "closed"):
            with ortung.RecordWriter(self.path("closed.rec")) as record:
                record.close()
                record.write(0, "a/b/c", [])

    def test_samples_are_views_that_outlive_the_belief(self):
        here = ortung.Localization(ROBOT, self.tables, source=self.source)
        next(here)
        first, second = here.samples, here.samples
        for name in ("x", "y", "theta", "log_weight"):
            self.assertTrue(np.shares_memory(first[name], second[name]))
            self.assertFalse(first[name].flags.writeable or first[name].flags.owndata)
        particles = here.particles
        np.testing.assert_array_equal(np.column_stack([first[name] for name in ("x", "y", "theta")]), particles[:, :3])
        kept = {name: one.copy() for name, one in first.items()}
        for _ in range(5):
            next(here)
        later = here.samples
        self.assertFalse(np.shares_memory(later["x"], first["x"]))
        del here, later, second
        for name, one in first.items():
            np.testing.assert_array_equal(one, kept[name])

    def test_maps_have_logarithms(self):
        here = ortung.Localization(ROBOT, self.tables, source=self.source)
        for _ in here:
            pass
        plain, log = here.probability_map(["*/LRF/*"]), here.probability_map(["*/LRF/*"], log=True)
        np.testing.assert_array_equal(np.isnan(plain), np.isnan(log))
        np.testing.assert_allclose(np.exp(log), plain, rtol=1e-5)

    def test_everything_says_what_it_is(self):
        sim = ortung.Simulation(ARENA)
        robot = sim.add_robot(ROBOT, start=(0, 0, 0))
        here = ortung.Localization(ROBOT, self.tables, source=self.source)
        run = ortung.evaluate(self.source, ROBOT, self.tables)
        record = ortung.RecordWriter(self.path("repr.rec"))
        for one, words in ((sim, ("arena", "1 robots")), (robot, ("pioneer", "x=0.000")), (here, ("pioneer", "status=")),
                           (next(here), ("x=", "status=")), (run, ("position_rmse_m",)), (record, ("repr.rec",)),
                           (ortung.World(ARENA), ("arena", "6 m x 4 m")), (ortung.Robot(ROBOT), ("pioneer",)),
                           (ortung.Tables(self.tables), ("arena.ortung",)), (ortung.readings(self.source), ("run.rec",)),
                           (robot.container, ("180DegreeScan",)), (ortung.World(ARENA).region(0.5), ("columns=12",))):
            for word in words:
                self.assertIn(word, repr(one))

    def test_everything_has_a_sentence_of_help(self):
        def sentence(one):
            lines = (one.__doc__ or "").strip().splitlines()
            if lines and "(" in lines[0] and "->" in lines[0]:  # pybind11's signature
                lines = lines[1:]
            return " ".join(lines).strip()

        for name in ortung.__all__:
            one = getattr(ortung, name)
            if name == "__version__":
                continue
            self.assertGreater(len(sentence(one)), 10, name)
            if not isinstance(one, type) or name == "Autoreset":  # whose members are pybind11's
                continue
            for member, what in vars(one).items():
                if member.startswith("_") or not (callable(what) or isinstance(what, property)):
                    continue
                self.assertGreater(len(sentence(what)), 3, f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
