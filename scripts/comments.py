#!/usr/bin/env python3
"""Counts comments that can't be read by themselves, and how much of the public headers is comment.

usage: comments.py [--list] [--most SHARE] [--least SHARE] [FOLDER...]

A comment behind a member ("///< ...") is a fragment if it begins with a preposition or another word that only goes on
with what the name says ("of the robot", "that it asks for"). --list shows them. Ends with 1 if more than --most of all
are fragments, or if less than --least of the lines of public headers are comments.
"""

import argparse
import re
import subprocess
import sys

BEGINS_LATE = re.compile(
    r"(of|that|which|who|whose|where|for|in|by|since|from|to|with|as|until|while|when|if|at|on|without|between|likewise|"
    r"then|so|not|and|or|up|before|after|behind|among|within|below|above|than|the same)\b|\"\"|\.\.\.|[\d.]+[;:,]? ")


def files(folders):
    listed = subprocess.run(["git", "ls-files", "--", *folders], check=True, capture_output=True, text=True).stdout
    return [name for name in listed.split() if re.search(r"\.(hpp|cpp|h)$", name) and not name.startswith("tests/")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folders", nargs="*", default=["."])
    parser.add_argument("--list", action="store_true", help="show all fragments")
    parser.add_argument("--most", type=float, default=1.0, help="share of fragments, at most")
    parser.add_argument("--least", type=float, default=0.0, help="share of comment lines in public headers, at least")
    options = parser.parse_args()
    members = fragments = lines = comments = 0
    for name in files(options.folders):
        with open(name, encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                found = re.search(r"///< (.*)", line)
                if found:
                    members += 1
                    if BEGINS_LATE.match(found.group(1)):
                        fragments += 1
                        if options.list:
                            print(f"{name}:{number}: {line.strip()}")
                if "/include/" in name and line.strip():
                    lines += 1
                    comments += bool(re.match(r"\s*//", line)) or found is not None
    of_members, of_lines = fragments / max(members, 1), comments / max(lines, 1)
    print(f"{fragments} of {members} comments behind members are fragments ({100 * of_members:.1f} %); "
          f"{100 * of_lines:.0f} % of the public headers' lines have comments")
    return of_members > options.most or of_lines < options.least


if __name__ == "__main__":
    sys.exit(main())
