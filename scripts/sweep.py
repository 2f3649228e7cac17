#!/usr/bin/env python3
"""Measures what each constant of the filter changes: half of it, and twice as much, on recordings.

  cmake --preset dev -B build/sweep -DORTUNG_SWEEP=ON -DORTUNG_TESTS=OFF && cmake --build build/sweep
  scripts/sweep.py build/sweep/bin/ortung ../shared/data [--only lead.kEnoughNats,polish,...] [--write docs/constants.md]

Of shares it is the odds that are halved and doubled. With --write the page gets the rows that were measured. All of it takes about
half an hour on two cores.
"""
import argparse
import concurrent.futures
import json
import os
import subprocess
import sys
import tempfile
import typing

import constants
import evaluate
import results_page

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FACTORS = (0.5, 2.0)
CASES = [  # recording, options of `ortung eval`
    ("belgioioso", []), ("jarvis", []), ("ds1", []), ("ds6", []),
    ("belgioioso", ["--kidnap", "4"]), ("ds1", ["--kidnap", "3"]), ("jarvis", ["--wake-ups", "8"]),
    ("belgioioso", ["--fault", "odometry=slip@100-105"]), ("ds6", ["--fault", "odometry=none@100-200"]),
    ("ds1", ["--fault", "readings=late:0.75"])]


class Figures(typing.NamedTuple):
    """What one case has come to. `bits` are all figures but those of time: equal if nothing has changed."""
    bits: str
    right: int      # runs that found the place
    wrong: float    # share of moments over 1 m off while tracking
    tracking: float
    lost: float
    median: float   # [m]


def without_times(value):
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items() if "ms" not in k.split("_") and k != "realtime_factor"}
    return [without_times(v) for v in value] if isinstance(value, list) else value


def figures_of(result):
    bits = json.dumps(without_times(result), sort_keys=True)
    if "summary" not in result:
        right = int(result["converged_after_s"] is not None)
        return Figures(bits, right, result["wrong_while_tracking_share"] or 0.0, result["tracking_share"] or 0.0,
                       result["lost_share"] or 0.0, result["position_median_m"])
    [all_runs] = result["summary"]
    return Figures(bits, all_runs["right"]["count"], all_runs["wrong_while_tracking_share"] or 0.0,
                   all_runs["tracking_share"] or 0.0, all_runs["lost_share"] or 0.0, all_runs["position_m"]["p50"])


class Bench:
    """Recordings with their tables in a folder, and the program that runs over them."""

    def __init__(self, ortung, data, out, names=tuple(sorted({name for name, _ in CASES}))):
        self.ortung, self.out = os.path.abspath(ortung), out
        for name in names:
            if name in evaluate.LASER:
                evaluate.import_laser(self.ortung, data, out, name)
            else:
                self.import_landmarks(data, name)

    def import_landmarks(self, data, name):
        base = os.path.join(self.out, name)
        evaluate.import_mrclam(self.ortung, data, base, name, 3)
        evaluate.run([self.ortung, "learn", "--world", base + ".toml", "--robot", base + "-robot.toml", "--out",
                      base + ".ortung", "--cell", "0.05", "--force"])

    def figures(self, values):
        """Of all cases, with other values of constants: {part.name: value}."""
        variables = {"ORTUNG_CONSTANTS": " ".join("%s=%.17g" % item for item in values.items())}
        return [self.case(name, options, variables) for name, options in CASES]

    def case(self, name, options, variables):
        with tempfile.NamedTemporaryFile(suffix=".json") as out:
            self.evaluate(name, ["--json", out.name, *options], variables)
            with open(out.name) as file:
                return figures_of(json.load(file))

    def evaluate(self, name, options, variables):
        """`ortung eval` of a recording, with more variables of the environment; raises RuntimeError with what it said."""
        base = os.path.join(self.out, name)
        words = [self.ortung, "eval", "--source", "record:%s.rec" % base, "--robot", base + "-robot.toml", "--tables",
                 base + ".ortung", "--threads", "1", *options]
        done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, **variables})
        if done.returncode != 0:
            raise RuntimeError("%s: %s" % (" ".join(words), done.stderr.strip()[-300:]))


def change(before, after):
    """In words, for the page: how many cases changed, and the greatest change for the worse and the better of each kind."""
    moved = [i for i in range(len(before)) if before[i].bits != after[i].bits]
    if not moved:
        return "nothing"
    words = ["%d of %d" % (len(moved), len(before))]
    ratio = [after[i].median / before[i].median - 1.0 for i in moved if before[i].right and after[i].right]
    worst, best = max(ratio + [0.0]), min(ratio + [0.0])
    words += ["median %+.0f %%" % (100.0 * extreme) for extreme in (worst, best) if abs(extreme) >= 0.05]
    for what, of, least in (("tracking", lambda f: f.tracking, 0.03), ("lost", lambda f: f.lost, 0.01),
                            ("wrong while tracking", lambda f: f.wrong, 0.002)):
        greatest = max((of(after[i]) - of(before[i]) for i in moved), key=abs)
        if abs(greatest) >= least:
            words.append("%s %+.1f points" % (what, 100.0 * greatest))
    right = sum(f.right for f in after) - sum(f.right for f in before)
    if right:
        words.append("%+d runs right" % right)
    return ", ".join(words)


def put(page, rows):
    """The page with what was measured now: {Constant: (half, twice)}, in the order of the headers."""
    head, mark, old = page.partition("<!-- constants -->\n")
    kept = {key: line for key, (line, _) in constants.rows_of(old).items()}
    lines, before = [], (None, None)
    for c in constants.declared(ROOT):
        if c in rows:
            kept[c.key] = "| `%s` | %s | %s | %s |" % (c.name, c.shown, *rows[c])
        if c.key not in kept:
            continue
        if c.room != before[0]:
            lines += ["", "## %s" % c.room.capitalize()]
        if (c.room, c.part) != before:
            lines += ["", "### `%s`" % c.part, "", "| constant | value | half of it | twice as much |", "|---|---|---|---|"]
        before = (c.room, c.part)
        lines.append(kept[c.key])
    return head + mark + "\n".join(lines[1:]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung", help="of a build with ORTUNG_SWEEP")
    parser.add_argument("data", help="folder with the recordings, see docs/results/data.md")
    parser.add_argument("--only", help="constants (PART.NAME) or parts of the filter, by commas; default: all")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--out", default="out/sweep", help="folder for records and tables")
    parser.add_argument("--write", metavar="FILE", help="put the rows into this page")
    arguments = parser.parse_args()
    wanted = constants.declared(ROOT)
    if arguments.only:
        only = arguments.only.split(",")
        if unknown := [o for o in only if o not in {c.key for c in wanted} | {c.part for c in wanted}]:
            parser.error("--only has %s, which no header of mcl/src declares" % ", ".join(unknown))
        wanted = [c for c in wanted if c.key in only or c.part in only]
    os.makedirs(arguments.out, exist_ok=True)
    bench = Bench(arguments.ortung, arguments.data, arguments.out)
    before = bench.figures({})
    if [f.bits for f in bench.figures({"lead.kEnoughNats": 1.0})] == [f.bits for f in before]:
        sys.exit("%s does not take ORTUNG_CONSTANTS: expected a build with ORTUNG_SWEEP" % arguments.ortung)
    rows = {}
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        asked = {c: [pool.submit(bench.figures, {c.key: c.times(f)}) for f in FACTORS] for c in wanted}
        for c, futures in asked.items():
            rows[c] = tuple(outcome(before, future) for future in futures)
            print("%s = %s | %s | %s" % (c.key, c.shown, *rows[c]), flush=True)
            if arguments.write:
                results_page.rewrite(arguments.write, lambda page: put(page, rows))


def outcome(before, future):
    try:
        return change(before, future.result())
    except RuntimeError as error:
        return "fails: " + str(error).split(": ")[-1].replace("|", "/")


if __name__ == "__main__":
    main()
