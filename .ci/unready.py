#!/usr/bin/env python3
"""Names the tests that can't run, since a program of theirs is not built: unready.py BUILD_FOLDER [--pattern for ctest -E]."""
import json
import pathlib
import re
import subprocess
import sys


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    listed = subprocess.run(["ctest", "--test-dir", folder, "--show-only=json-v1"], check=True, capture_output=True, text=True)
    unready = []
    for test in json.loads(listed.stdout)["tests"]:
        # CTest tells no command if its program is not there. A script's arguments may name others that are not.
        command = test.get("command", [])
        files = [pathlib.Path(word) for word in command if word.startswith(f"{folder}/bin/")]
        # A program that is asked for its tests at the end of its build has one test of this name before.
        if test["name"].endswith("_NOT_BUILT") or not command or not all(file.exists() for file in files):
            unready.append(test["name"])
    print("^(" + "|".join(map(re.escape, unready)) + ")$" if "--pattern" in sys.argv else " ".join(unready))


if __name__ == "__main__":
    main()
