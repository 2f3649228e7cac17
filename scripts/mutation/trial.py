"""Runs the tests that come past a mutant with the mutant switched on, until one notices."""

import json
import os
import re
import signal
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

MOST = 100000  # ortung_mutant::kMost


class Test:
    """One test of ctest's list, run as ctest would."""

    def __init__(self, entry):
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        self.name = entry["name"]
        self.command = entry["command"]
        self.folder = properties.get("WORKING_DIRECTORY")
        self.environment = dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", []))
        self.seconds = 0.0

    def run(self, environment, limit_s):
        """Whether it passed. A test that does not end in time is stopped with all its children and has failed."""
        merged = {**os.environ, **self.environment, **environment}
        with tempfile.TemporaryDirectory(prefix="ortung_mutant.") as folder:
            merged["TMPDIR"] = folder
            process = subprocess.Popen(self.command, cwd=self.folder, env=merged, start_new_session=True,
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                return process.wait(timeout=limit_s) == 0
            except subprocess.TimeoutExpired:
                return False
            finally:
                try:
                    os.killpg(process.pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
                process.wait()


def tests_of(build, leave_out):
    out = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True, text=True)
    return [Test(t) for t in json.loads(out.stdout)["tests"] if "command" in t and not re.search(leave_out, t["name"])]


class Trials:
    """results: number -> name of the test that noticed, or None; kept in a file, so that a run can be gone on with."""

    def __init__(self, tree, jobs, say, leave_out):
        self.tree, self.jobs, self.say = tree, jobs, say
        self.tests = tests_of(tree.build, leave_out)
        self.file = tree.folder / "results.json"
        self.reached = {}

    def baseline(self):
        """Each test without a mutant: how long it takes, and past which mutants it comes. Known as long as nothing changes."""
        memory = self.tree.folder / "baseline.json"
        files = [self.tree.source / name for name in self.tree.files()]
        files += [f for place in ("bin", "lib") for f in (self.tree.build / place).rglob("*")]
        built = max(f.stat().st_mtime_ns for f in files if f.is_file())
        known = json.loads(memory.read_text()) if memory.is_file() else {}
        if known.get("built") == built:
            rows = known["tests"]
        else:
            rows = self.measure()
            memory.write_text(json.dumps({"built": built, "tests": rows}))
        for test in self.tests:
            passed, test.seconds, reached = rows[test.name]
            self.reached[test] = set(reached)
            if not passed:
                self.say(f"without mutants, {test.name} fails: left out")
        self.tests = [t for t in self.tests if rows[t.name][0]]
        self.say(f"{len(self.tests)} tests pass without mutants")

    def measure(self):
        """test's name -> whether it passes, how long it takes [s], numbers of the mutants that it comes past."""
        folder = self.tree.folder / "reached"
        folder.mkdir(exist_ok=True)

        def one(indexed):
            number, test = indexed
            path = folder / f"{number}"
            path.write_bytes(bytes(MOST))
            start = time.monotonic()
            passed = test.run({"ORTUNG_MUTANTS_REACHED": str(path)}, 900)
            seconds = time.monotonic() - start
            reached = [i for i, byte in enumerate(path.read_bytes()) if byte]
            path.unlink()
            return test.name, (passed, seconds, reached)

        with ThreadPoolExecutor(self.jobs) as pool:
            return dict(pool.map(one, enumerate(self.tests)))

    def run(self, chosen):
        results = {}
        if self.file.is_file():
            results = {int(k): v for k, v in json.loads(self.file.read_text()).items()}
        todo = [n for n, site in enumerate(chosen) if site is not None and n not in results]

        def one(number):
            # First what is quick and comes past few others: it is about this place.
            coming_past = sorted((t for t in self.tests if number in self.reached[t]), key=lambda t: t.seconds * len(self.reached[t]))
            for test in coming_past:
                if not test.run({"ORTUNG_MUTANT": str(number)}, 10 + 10 * test.seconds):
                    return number, test.name, len(coming_past)
            return number, None, len(coming_past)

        with ThreadPoolExecutor(self.jobs) as pool:
            for count, (number, noticed, tests) in enumerate(pool.map(one, todo), 1):
                results[number] = noticed
                self.file.write_text(json.dumps(results))
                verdict = noticed or ("SURVIVED " + str(tests) + " tests")
                self.say(f"{count}/{len(todo)} {chosen[number].key()}: {verdict}")
        return results
