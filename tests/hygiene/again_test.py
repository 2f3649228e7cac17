#!/usr/bin/env python3
"""A few failed tests of programs that talk to each other are run again, by their exact names; nothing else is."""
import pathlib
import subprocess
import tempfile
import unittest

AGAIN = pathlib.Path(__file__).resolve().parents[2] / "scripts/again.py"


class Again(unittest.TestCase):
    def again(self, *failed):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "tests.xml"
            cases = "".join('<testcase name="%s"><failure message=""/></testcase>' % name for name in failed)
            file.write_text('<testsuite><testcase name="server.Fine"/><testcase name="web.Skipped"><skipped/></testcase>%s</testsuite>' % cases)
            done = subprocess.run([AGAIN, file], capture_output=True, text=True)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return done.stdout.strip() if done.returncode == 0 else None

    def test_what_has_other_programs_is_run_again(self):
        self.assertEqual(self.again("ros2_live.floors"), r"^(ros2_live\.floors)$")
        self.assertEqual(self.again("server.A/B.C", "devices.D"), r"^(server\.A/B\.C|devices\.D)$")

    def test_what_can_only_fail_for_its_own_sake_is_not(self):
        for name in ("mcl.Mcl.IsRight", "container.served.A", "app.Learn.Writes", "playing.A"):
            self.assertIsNone(self.again(name), name)
            self.assertIsNone(self.again("server.A", name), name)

    def test_many_failures_are_no_accident(self):
        self.assertIsNotNone(self.again("web.A", "web.B", "web.C"))
        self.assertIsNone(self.again("web.A", "web.B", "web.C", "web.D"))

    def test_without_failures_nothing_is(self):
        self.assertIsNone(self.again())


if __name__ == "__main__":
    unittest.main()
