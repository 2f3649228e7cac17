#!/usr/bin/env python3
"""Of a build that was stopped, CI runs the tests whose programs are there, and names the others."""
import pathlib
import subprocess
import tempfile
import unittest

UNREADY = pathlib.Path(__file__).resolve().parents[2] / ".ci/unready.py"
TESTS = """
add_test(built "FOLDER/bin/built")
add_test(room.stopped "FOLDER/bin/stopped" "some.toml")
add_test(script "/bin/sh" "FOLDER/bin/built")
add_test(room.script_of_stopped "/bin/sh" "-c" "FOLDER/bin/stopped")
add_test(cases_NOT_BUILT "FOLDER/bin/cases_NOT_BUILT")
"""
STOPPED = ["cases_NOT_BUILT", "room.script_of_stopped", "room.stopped"]


class Unready(unittest.TestCase):
    def setUp(self):
        self.root = tempfile.TemporaryDirectory()
        self.addCleanup(self.root.cleanup)
        self.folder = pathlib.Path(self.root.name).resolve()
        (self.folder / "bin").mkdir()
        (self.folder / "bin/built").write_text("#!/bin/sh\n")
        (self.folder / "bin/built").chmod(0o755)
        (self.folder / "CTestTestfile.cmake").write_text(TESTS.replace("FOLDER", str(self.folder)))

    def unready(self, *options):
        return subprocess.run([UNREADY, self.folder, *options], check=True, capture_output=True, text=True).stdout.strip()

    def test_names_what_is_not_built(self):
        self.assertEqual(sorted(self.unready().split()), STOPPED)

    def test_its_pattern_leaves_out_these_alone(self):
        ran = subprocess.run(["ctest", "--test-dir", self.folder, "-E", self.unready("--pattern")], capture_output=True, text=True)
        self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
        self.assertIn("out of 2", ran.stdout)


if __name__ == "__main__":
    unittest.main()
