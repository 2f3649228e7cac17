"""Tests sweeps from Python: here, and by something that has futures as Dask has."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from ortung import sweep

MAPS = pathlib.Path(sys.argv.pop())
PROGRAM = sys.argv.pop()

SWEEP = """
command = ["eval", "--source", "sim:{maps}/fields/f2000.toml?duration=10", "--robot", "{maps}/robots/pioneer_posts.toml",
           "--tables", "field.ortung", "--set", "mcl.particles={{n}}", "--seed", "{{seed}}", "--start", "truth", "--no-times"]
[vary]
n = [100, 300]
seed = "1..3"
"""


class Futures:
    """What Dask's Client has of it; remembers what was asked for."""

    def __init__(self):
        self.submitted = []

    def submit(self, function, *arguments, pure):
        assert not pure  # a result that is not there any more is no result
        self.submitted.append(arguments)
        return lambda: function(*arguments)

    def gather(self, futures):
        return [future() for future in reversed(futures)][::-1]


class Sweep(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory(prefix="ortung-sweep-")
        cls.folder = pathlib.Path(cls.kept.name)
        os.environ["ORTUNG_PROGRAM"] = PROGRAM
        subprocess.run([PROGRAM, "learn", "--world", MAPS / "fields" / "f2000.toml", "--robot", MAPS / "robots" / "pioneer_posts.toml",
                        "--cell", "0.2", "--out", cls.folder / "field.ortung"], check=True, capture_output=True)
        cls.file = cls.folder / "sweep.toml"
        cls.file.write_text(SWEEP.format(maps=MAPS))

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def test_names_its_tasks(self):
        self.assertEqual(sweep.plan(str(self.file)), ["n=%d,seed=%d" % (n, seed) for n in (100, 300) for seed in (1, 2, 3)])

    def test_has_the_same_figures_by_futures(self):
        here, there = str(self.folder / "here"), str(self.folder / "there")
        self.assertEqual(sweep.run(str(self.file), here), ["6 of 6 tasks were run, 0 failed\n"])
        client = Futures()
        self.assertEqual(len(sweep.run(str(self.file), there, shards=4, client=client)), 4)
        self.assertEqual(client.submitted, [(str(self.file), there, i, 4) for i in (1, 2, 3, 4)])
        self.assertEqual(sweep.figures(here), sweep.figures(there))
        rows = sweep.table(here, by=["n"], figures=["position_rmse_m"])
        self.assertEqual([(row["n"], row["tasks"], row["done"]) for row in rows], [("100", "3", "3"), ("300", "3", "3")])
        for row in rows:
            errors = [task["figures"]["position_rmse_m"] for task in sweep.figures(here) if task["values"]["n"] == row["n"]]
            known = [error for error in errors if error is not None]
            self.assertAlmostEqual(float(row["position_rmse_m"]), sum(known) / len(known), places=12)
        inside = sweep.table(here, by=["n"], figures=["at_corrections.nees_mean"])
        with self.assertRaisesRegex(sweep.SweepError, "no finished task has a figure 'no.such'"):
            sweep.table(here, by=["n"], figures=["no.such"])
        self.assertGreater(float(inside[0]["at_corrections.nees_mean"]), 0.0)
        self.assertTrue(sweep.table_text(here, by=["n"]).startswith("| n | done | "))

    def test_tells_what_is_missing_and_why_it_failed(self):
        some = str(self.folder / "some")
        sweep.run_shard(str(self.file), some, 1, 6)
        found = sweep.figures(some)
        self.assertEqual([task["figures"] is not None for task in found], [True] + 5 * [False])
        self.assertEqual(found[0]["task"], "n=100,seed=1")
        self.assertEqual(found[0]["values"], {"n": "100", "seed": "1"})
        with self.assertRaisesRegex(sweep.SweepError, "none.toml"):
            sweep.plan(str(self.folder / "none.toml"))


if __name__ == "__main__":
    unittest.main()
