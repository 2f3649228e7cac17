#!/usr/bin/python3
"""Mutation testing: changes the program at many places, one at a time, and sees whether a test notices.

mutate.py [--mutants 300] [--seed 1] [--jobs N] [--folder build/mutants] [--report docs/testing.md]

The sources are copied, mutants are written into the copy behind a switch, it is built once, and the tests that come past
a mutant are run with it switched on until one of them fails. Needs python3-clang-19 and a configured `dev` build.
A run that was cut is gone on with when started again. `--again` runs only those that survived, after tests were added:
the same places, the tests and sources of today; what was noticed before counts as noticed still.
"""

import argparse
import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from mutation import report, tree, trial  # noqa: E402
from mutation.sites import Site  # noqa: E402

# They look at the sources and at installations, not at what the program does; or that the pages' commands succeed, for long.
LEAVE_OUT = r"^(hygiene|docs)\."


def say(text):
    print(text, file=sys.stderr, flush=True)


def main():
    root = Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mutants", type=int, default=300, help="how many, the same number in each top-level folder")
    parser.add_argument("--seed", default="1", help="another seed draws other places")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--folder", type=Path, default=root / "build/mutants")
    parser.add_argument("--build", type=Path, default=root / "build/dev", help="a configured build, for its compile commands")
    parser.add_argument("--report", type=Path, help="write the figures into this file, between its two marks")
    parser.add_argument("--again", action="store_true", help="try the survivors of the last run again")
    parser.add_argument("--leave-out", default=LEAVE_OUT, help="tests not to be run, a regular expression")
    options = parser.parse_args()

    copy = tree.Tree(root, options.folder.resolve())
    if not (options.build / "compile_commands.json").is_file():
        sys.exit(f"mutate: {options.build} is not configured: cmake --preset dev")
    results_file = copy.folder / "results.json"
    memory = copy.folder / "places.json"
    noticed = []
    if options.again:
        found = tree.find(root, options.build.resolve(), memory, options.jobs, say)
        before = json.loads(copy.list.read_text())
        results = json.loads(results_file.read_text())
        survivors = [Site(**s) for n, s in enumerate(before) if s is not None and results.get(str(n), "") is None]
        noticed = [Site(**s) for n, s in enumerate(before) if s is not None and results.get(str(n)) is not None]
        chosen, gone = report.found_again(survivors, found)
        for site in gone:
            say(f"no longer there: {site.key()}")
        copy = tree.Tree(root, options.folder.resolve() / "again")
        copy.folder.mkdir(exist_ok=True)
        (copy.folder / "results.json").unlink(missing_ok=True)
    elif copy.list.is_file():
        say(f"going on with what {copy.folder} holds; remove it to begin anew")
        chosen = [Site(**s) if s else None for s in json.loads(copy.list.read_text())]
    else:
        found = tree.find(root, options.build.resolve(), memory, options.jobs, say)
        chosen = tree.choose(found, options.mutants // len(tree.rooms(root)), options.seed)
        say(f"{len(chosen)} mutants, of {len(found)} places")
    copy.write(chosen)
    chosen = copy.compile(chosen, options.jobs, say)
    copy.write(chosen)
    trials = trial.Trials(copy, options.jobs, say, options.leave_out)
    trials.baseline()
    results = dict.fromkeys(range(len(noticed)), "before") | {n + len(noticed): r for n, r in trials.run(chosen).items()}
    text = report.text(noticed + chosen, results, root / "tests/mutants.txt", options)
    print(text)
    if options.report:
        report.put(options.report, text)


if __name__ == "__main__":
    main()
