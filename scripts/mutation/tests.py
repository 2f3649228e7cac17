"""The tests of a build, as ctest knows them; several of one program run in one process."""

import json
import os
import re
import signal
import subprocess
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path

FILTER = "--gtest_filter="
TOGETHER_S = 5.0  # of tests that run in one process


@dataclass
class Tests:
    """One test or several of a program of GoogleTest's."""
    name: str
    command: list  # without the filter
    folder: str
    environment: dict
    filters: list = field(default_factory=list)
    seconds: float = 0.0
    joins: bool = True  # may run in one process with others

    def run(self, environment, limit_s):
        """Whether all passed. What does not end in time is stopped with all its children and has failed."""
        command = self.command + ([FILTER + ":".join(self.filters), "--gtest_fail_fast"] if self.filters else [])
        merged = {**os.environ, **self.environment, **environment}
        with tempfile.TemporaryDirectory(prefix="ortung_mutant.") as folder:
            merged["TMPDIR"] = folder
            process = subprocess.Popen(command, cwd=self.folder, env=merged, start_new_session=True,
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
    """Each by itself."""
    out = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True, text=True)
    for entry in json.loads(out.stdout)["tests"]:
        if "command" not in entry or re.search(leave_out, entry["name"]):
            continue
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        yield Tests(entry["name"], [word for word in entry["command"] if not word.startswith(FILTER)],
                    properties.get("WORKING_DIRECTORY"), dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", [])),
                    [word.removeprefix(FILTER) for word in entry["command"] if word.startswith(FILTER)])


def together(tests):
    """The same tests in fewer processes, those that are quick first."""
    groups, open_groups = [], {}
    for test in sorted(tests, key=lambda t: t.seconds):
        place = (*test.command, test.folder, *sorted(test.environment.items()))
        group = open_groups.get(place)
        if test.joins and test.filters and group and group.seconds + test.seconds <= TOGETHER_S:
            group.filters += test.filters
            group.seconds += test.seconds
            group.name = f"{group.filters[0]} or another of {Path(test.command[0]).name}"
        elif test.joins:
            open_groups[place] = replace(test, filters=list(test.filters))
            groups.append(open_groups[place])
        else:
            groups.append(replace(test))
    return sorted(groups, key=lambda g: g.seconds / max(1, len(g.filters)))
