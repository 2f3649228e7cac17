#!/usr/bin/env python3
"""Measures lrf_iconic on logs of laser scanners: positions, wrong ones, time. Prints a table in Markdown.

  scripts/evaluate-iconic.py build/release/bin/ortung build/release/bin/iconic_fixes ../shared/data [--only intel,aces] [--out DIR] [--wrong]

Each log is imported and its robot gets lrf_iconic, which reads the scanner; the tables are learned with that alone ("learning") and
with the imported scanner's end points, too ("with the scan"), in seconds of the processor. A position is right within 0.3 m and
0.2 rad of the log's reference. --wrong also prints each wrong one.
"""
import argparse
import os
import re
import resource
import subprocess
import sys
import tempfile

from evaluate import LASER, run

NAV350 = ("crob_lab_jarvis/complex_path_fast/nav350", LASER["jarvis"][1])
LOGS = {**LASER, "nav350": NAV350}
ICONIC = "\n[[sensor]]\nplugin = \"lrf_iconic\"\nreads = \"*/LRF/scan\"\n"
HEAD = ("| log | scans | with positions | all wrong | with one alone | wrong | median error [m] | NEES | ms (median) | ms (95 %) | "
        "ms (most) | learning [s] | with the scan [s] |")


def learn(ortung, base, robot, out):
    """Seconds of the processor that learning takes."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run([ortung, "learn", "--world", base + ".toml", "--robot", robot, "--out", out, "--force"])
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def prepare(ortung, data, out, name):
    """Record, robot and tables of a log, as iconic_fixes expects them; returns both times to learn [s]."""
    folder, options = LOGS[name]
    base = os.path.join(out, name)
    run([ortung, "import", "scanlog", os.path.join(data, folder), "--out", base + ".rec", "--world", base + ".toml",
         "--robot-file", base + "-robot.toml", "--force",
         *[word for o in options for word in ("--option", o.format(data=data))]])
    robot = open(base + "-robot.toml").read() + ICONIC
    for end, text in (("-both.toml", robot), ("-iconic.toml", re.sub("(?m)^perception = .*$", "localizes = false", robot))):
        with open(base + end, "w") as file:
            file.write(text)
    return [learn(ortung, base, base + "-%s.toml" % kind, base + "-%s.ortung" % kind) for kind in ("iconic", "both")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung")
    parser.add_argument("iconic_fixes")
    parser.add_argument("data", help="folder of the logs")
    parser.add_argument("--only", default="", help="names of logs, by commas")
    parser.add_argument("--out", help="folder that keeps the files")
    parser.add_argument("--wrong", action="store_true", help="print wrong positions")
    arguments = parser.parse_args()
    names = arguments.only.split(",") if arguments.only else list(LOGS)
    unknown = [name for name in names if name not in LOGS]
    if unknown:
        sys.exit("no log is called %s, expected of %s" % (", ".join(unknown), ", ".join(LOGS)))
    with tempfile.TemporaryDirectory() as folder:
        out = arguments.out or folder
        os.makedirs(out, exist_ok=True)
        print(HEAD + "\n|" + "---|" * (HEAD.count("|") - 1), flush=True)
        totals = [0] * 5
        for name in names:
            seconds = prepare(arguments.ortung, arguments.data, out, name)
            options = ["--wrong"] if arguments.wrong else []
            *wrong, row = run([arguments.iconic_fixes, *options, out, name]).splitlines()
            print("\n".join([*wrong, row + " %.2f | %.2f |" % tuple(seconds)]), flush=True)
            totals = [a + int(b) for a, b in zip(totals, row.split("|")[2:7])]
        print("| all | %d | %d | %d | %d | %d | | | | | | | |" % tuple(totals))


if __name__ == "__main__":
    main()
