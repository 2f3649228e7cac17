"""Runs the tests that come past a mutant with the mutant switched on, until one notices."""

import json
import random
import time
from concurrent.futures import ThreadPoolExecutor

from .tests import tests_of, together

MOST = 100000  # ortung_mutant::kMost


class Trials:
    """results: number -> name of the test that noticed, or None; kept in a file, so that a run can be gone on with."""

    def __init__(self, tree, jobs, say, leave_out):
        self.tree, self.jobs, self.say = tree, jobs, say
        self.tests = list(tests_of(tree.build, leave_out))
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
            passed, test.seconds, reached, test.joins = rows[test.name]
            self.reached[test.name] = set(reached)
            if not passed:
                self.say(f"without mutants, {test.name} fails: left out")
        self.tests = [t for t in self.tests if rows[t.name][0]]
        self.say(f"{len(self.tests)} tests pass without mutants")

    def measure(self):
        """test's name -> whether it passes, how long it takes [s], numbers of the mutants that it comes past, whether
        it passes in one process with others, too."""
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
            rows = dict(pool.map(one, enumerate(self.tests)))
            for test in self.tests:
                test.seconds = rows[test.name][1]
            groups = together([t for t in self.tests if rows[t.name][0]])
            quarrel = set()
            for group, passed in zip(groups, pool.map(lambda g: g.run({}, 900), groups)):
                if not passed:
                    self.say(f"these pass one by one, but not in one process: {group.command[0]} {group.filters}")
                    quarrel.update((*group.command, name) for name in group.filters)
        return {t.name: (*rows[t.name], not any((*t.command, name) in quarrel for name in t.filters)) for t in self.tests}

    def run(self, chosen):
        results = {}
        if self.file.is_file():
            results = {int(k): v for k, v in json.loads(self.file.read_text()).items()}
        todo = [n for n, site in enumerate(chosen) if site is not None and n not in results]
        random.Random(len(chosen)).shuffle(todo)  # so that what a run that was cut has tried is a sample of all

        def one(number):
            coming_past = [t for t in self.tests if number in self.reached[t.name]]
            for tests in together(coming_past):
                if not tests.run({"ORTUNG_MUTANT": str(number)}, 10 + 10 * tests.seconds):
                    return number, tests.name, len(coming_past)
            return number, None, len(coming_past)

        with ThreadPoolExecutor(self.jobs) as pool:
            for count, (number, noticed, tests) in enumerate(pool.map(one, todo), 1):
                results[number] = noticed
                self.file.write_text(json.dumps(results))
                verdict = noticed or ("SURVIVED " + str(tests) + " tests")
                self.say(f"{count}/{len(todo)} {chosen[number].key()}: {verdict}")
        return results
