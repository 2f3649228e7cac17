#!/usr/bin/python3
"""Runs what takes hours: long searches of the fuzz targets, everything with sanitizers, threads under stress, and a soak.

long-tests.py [fuzz] [sanitizers] [threads] [soak] [--minutes 60] [--executions 10000000] [--jobs 2] [--write docs/reliability.md]

Without a part all of them run, one after the other:
  fuzz        each target of tests/fuzz until it was executed --executions times, with what was found before as its corpus
  sanitizers  all tests with the address and undefined-behaviour sanitizers, full logs and every case (ORTUNG_LONG_TESTS=1)
  threads     all tests that have threads with the thread sanitizer, again and again for --minutes
  soak        scripts/soak.py for --minutes, with Chromium looking at the page

A run that was cut is gone on with when started again: executions of fuzz targets add up, in FOLDER/state.json (--folder, build/long).
--write puts what is known by then behind the mark in the page, with commits and dates. Ends with 1 if anything was found.
"""

import argparse
import datetime
import json
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Lock

ROOT = Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- long: begin -->", "<!-- long: end -->"
PARTS = ("fuzz", "sanitizers", "threads", "soak")
CHUNK_S = 120  # how long a target is searched before what it did is written down


def say(text):
    print(text, file=sys.stderr, flush=True)


def output(command, **more):
    return subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT, **more).stdout.strip()


def stamp():
    """Commit and date of what runs; a + for what is not committed."""
    changed = "+" if output(["git", "status", "--porcelain", "--untracked-files=no"]) else ""
    return output(["git", "rev-parse", "--short", "HEAD"]) + changed, datetime.date.today().isoformat()


def build(preset, *options):
    subprocess.run(["cmake", "--preset", preset, *options], check=True, cwd=ROOT, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "--preset", preset], check=True, cwd=ROOT, stdout=sys.stderr)


def tests_of(preset):
    listed = json.loads(output(["ctest", "--test-dir", f"build/{preset}", "--show-only=json-v1"]))
    return [t for t in listed["tests"] if "command" in t]


class State:
    """What was done so far, by part; written whenever it changes."""

    def __init__(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        self.folder, self.file, self.lock = folder, folder / "state.json", Lock()
        self.parts = json.loads(self.file.read_text()) if self.file.is_file() else {}

    def put(self, part, name, row):
        with self.lock:
            commit, date = stamp()
            self.parts.setdefault(part, {})[name] = {**row, "commit": commit, "date": date}
            new = self.file.with_suffix(".new")
            new.write_text(json.dumps(self.parts, indent=1, sort_keys=True))
            new.replace(self.file)

    def get(self, part, name):
        return self.parts.get(part, {}).get(name, {})


def search(test, state, options):
    """Goes on with one fuzz target; its row of the state has what all its runs did together."""
    name = test["name"].removeprefix("fuzz.")
    row = {"executions": 0, "seconds": 0.0, "found": [], **state.get("fuzz", name)}
    corpus = state.folder / "fuzz" / name
    found = state.folder / "found" / name
    for folder in (corpus, found):
        folder.mkdir(parents=True, exist_ok=True)
    program, *arguments = test["command"]
    seeds = arguments[-1]
    kept = [a for a in arguments if a.startswith("-") and not a.startswith(("-runs", "-seed"))]
    environment = dict(e.split("=", 1) for p in test.get("properties", []) if p["name"] == "ENVIRONMENT" for e in p["value"])
    while row["executions"] < options.executions and time.monotonic() < options.until:
        left = options.executions - row["executions"]
        start = time.monotonic()
        run = subprocess.run([program, *kept, f"-runs={left}", f"-max_total_time={CHUNK_S}", "-print_final_stats=1",
                              f"-artifact_prefix={found}/", corpus, seeds],
                             capture_output=True, text=True, errors="replace", env={**os.environ, **environment})
        told = re.search(r"number_of_executed_units:\s*(\d+)", run.stderr)
        row["executions"] += int(told[1]) if told else 0
        row["seconds"] = round(row["seconds"] + time.monotonic() - start, 1)
        row["found"] = sorted(f.name for f in found.iterdir())
        if run.returncode != 0 and (not told or not row["found"]):
            row["found"].append("ended by itself: " + run.stderr.strip().splitlines()[-1][:200])
        state.put("fuzz", name, row)
        say(f"fuzz {name}: {row['executions']:,} executions in {row['seconds']:.0f} s, {len(row['found'])} found")
        if run.returncode != 0:
            say(run.stderr[-2000:])
            return


def fuzz(state, options):
    build("fuzz")
    tests = [t for t in tests_of("fuzz") if t["name"].startswith("fuzz.")]
    # Whoever has the least behind it comes first, so that a run that is cut leaves no target out.
    tests.sort(key=lambda t: state.get("fuzz", t["name"].removeprefix("fuzz.")).get("executions", 0))
    with ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(lambda test: search(test, state, options), tests))


def run_tests(preset, state, part, options, *arguments):
    """Runs tests of a preset; its row says how many ran and which failed."""
    results = state.folder / f"{part}.xml"
    start = time.monotonic()
    environment = {**os.environ, "ORTUNG_LONG_TESTS": "1"}
    run = subprocess.run(["ctest", "--preset", preset, "-j", str(options.jobs), "--output-junit", results, *arguments],
                         cwd=ROOT, env=environment, stdout=sys.stderr)
    head = re.search(r"<testsuite[^>]*>", results.read_text(errors="replace"))[0]
    count = {word: int(re.search(rf'{word}="(\d+)"', head)[1]) for word in ("tests", "failures", "skipped")}
    return {**count, "seconds": round(time.monotonic() - start), "fine": run.returncode == 0}


def sanitizers(state, options):
    build("asan")
    state.put("sanitizers", "all", run_tests("asan", state, "sanitizers", options))


def threads(state, options):
    build("tsan")
    until = min(options.until, time.monotonic() + 60 * options.minutes)
    total = {"rounds": 0, "tests": 0, "failures": 0, "seconds": 0, "fine": True}
    while total["fine"] and (total["rounds"] == 0 or time.monotonic() < until):
        row = run_tests("tsan", state, "threads", options)
        total["rounds"] += 1
        for word in ("tests", "failures", "seconds"):
            total[word] += row[word]
        total["fine"] = row["fine"]
        state.put("threads", "all", total)


def soak(state, options):
    build("release")
    run = subprocess.run([ROOT / "scripts/soak.py", ROOT / "build/release/bin/ortung", "--minutes", str(options.minutes),
                          "--hours", str(options.minutes / 3), "--viewers", "3"], text=True, stdout=subprocess.PIPE)
    say(run.stdout)
    lines = [line for line in run.stdout.splitlines() if line and not line.startswith("|")]
    state.put("soak", "all", {"minutes": options.minutes, "said": lines, "fine": run.returncode == 0})


def page(parts):
    """All that is known, as Markdown."""
    lines = []
    if "fuzz" in parts:
        lines += ["| fuzz target | executions | hours | found | commit |", "| --- | --- | --- | --- | --- |"]
        for name, row in sorted(parts["fuzz"].items()):
            found = ", ".join(row["found"]) or "-"
            lines.append(f"| `{name}` | {row['executions']:,} | {row['seconds'] / 3600:.1f} | {found} | "
                         f"{row['commit']} ({row['date']}) |")
        lines.append("")
    for part, what in (("sanitizers", "tests with the address and undefined-behaviour sanitizers"),
                       ("threads", "tests with the thread sanitizer")):
        for row in parts.get(part, {}).values():
            rounds = f" in {row['rounds']} rounds" if "rounds" in row else ""
            lines += [f"{row['tests']:,} {what}{rounds}, {row['seconds'] / 60:.0f} min: {row['failures']} failed "
                      f"({row['commit']}, {row['date']}).", ""]
    for row in parts.get("soak", {}).values():
        lines += [f"Soak of {row['minutes']:.0f} min, {'all stays' if row['fine'] else 'FAILED'} ({row['commit']}, {row['date']}): "
                  + "; ".join(row["said"]) + ".", ""]
    return "\n".join(lines).rstrip()


def is_fine(parts):
    rows = [row for part in parts.values() for row in part.values()]
    return all(row.get("fine", True) and not row.get("found") for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", metavar="PART", help="of " + ", ".join(PARTS) + "; all of them by default")
    parser.add_argument("--minutes", type=float, default=60, help="of the stress of threads, and of the soak")
    parser.add_argument("--executions", type=int, default=10_000_000, help="of each fuzz target")
    parser.add_argument("--at-most", type=float, metavar="MINUTES", help="stop searching then; go on another time")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--folder", type=Path, default=ROOT / "build/long")
    parser.add_argument("--write", type=Path, metavar="PAGE", help="put the results behind their mark in this page")
    options = parser.parse_args()
    unknown = [p for p in options.parts if p not in PARTS]
    if unknown:
        parser.error(f"unknown part {', '.join(unknown)}, expected some of {', '.join(PARTS)}")
    options.until = time.monotonic() + 60 * options.at_most if options.at_most else float("inf")
    state = State(options.folder.resolve())
    for part in options.parts or PARTS:
        globals()[part](state, options)
    text = page(state.parts)
    print(text)
    if options.write:
        whole = options.write.read_text()
        head, rest = whole.split(BEGIN, 1)
        options.write.write_text(head + BEGIN + "\n" + text + "\n" + END + rest.split(END, 1)[1])
    sys.exit(0 if is_fine(state.parts) else 1)


if __name__ == "__main__":
    main()
