#!/usr/bin/env python3
"""Counts the instructions of the hot calls and compares them with the golden ones.

  hot_calls.py PROGRAM GOLDEN

Counts, unlike times, are the same on a busy machine. A call that takes more than 3 % more instructions than its golden count
has become slower unseen; one that takes as many less has a golden count that would hide the next loss. With $ORTUNG_NEW_GOLDEN
the golden counts are written anew. Ends with 77 where valgrind or AVX2 is missing.
"""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

TOLERANCE = 0.03
HEAD = """# Instructions of one call each: tests/instructions, built by g++ 12 with the flags of the preset dev, counted by callgrind.
# After a change that is meant: ORTUNG_NEW_GOLDEN=1 ctest --preset dev -R instructions
"""


def counted(program):
    """{name of a call: its instructions}, in the order in which they were made."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        ran = subprocess.run(["valgrind", "--tool=callgrind", "--instr-atstart=no", "--callgrind-out-file=" + out, program],
                             capture_output=True, text=True)
        if ran.returncode == 77:
            skip(ran.stderr)
        if ran.returncode:
            sys.exit("%s ended with %d:\n%s" % (program, ran.returncode, ran.stderr))
        counts = {}
        for file in sorted(glob.glob(out + ".*"), key=lambda name: int(name.rsplit(".", 1)[1])):
            with open(file) as profile:
                text = profile.read()
            name = re.search(r"^desc: Trigger: Client Request: (\w+)$", text, re.M)[1]
            counts[name] = int(re.search(r"^totals: (\d+)$", text, re.M)[1])
        return counts


def golden_of(file):
    with open(file) as golden:
        lines = [line.split() for line in golden if line.strip() and not line.startswith("#")]
    return {name: int(count) for name, count in lines}


def complaints(counts, golden):
    """What differs, a line each."""
    for name in golden.keys() - counts.keys():
        yield "%s was not counted" % name
    for name, count in counts.items():
        if name not in golden:
            yield "%s takes %d instructions and has no golden count" % (name, count)
            continue
        change = count / golden[name] - 1
        if abs(change) > TOLERANCE:
            yield "%s takes %+.1f %% instructions: %d, expected %d" % (name, 100 * change, count, golden[name])


def skip(why):
    print("skipped:", why.strip())
    sys.exit(77)


def main():
    program, golden = sys.argv[1:]
    if not shutil.which("valgrind"):
        skip("valgrind is not installed")
    counts = counted(program)
    for name, count in counts.items():
        print("%-24s %12d" % (name, count))
    if os.environ.get("ORTUNG_NEW_GOLDEN"):
        with open(golden, "w") as file:
            file.write(HEAD + "".join("%s %d\n" % pair for pair in counts.items()))
        return
    found = list(complaints(counts, golden_of(golden)))
    print("\n".join(found) or "all as expected")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
