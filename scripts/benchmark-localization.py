#!/usr/bin/env python3
"""Tries whether localization can be trusted, on all laser logs, and prints tables as Markdown.

  scripts/benchmark-localization.py build/release/bin/ortung ../shared/data [--only tracking,wake-ups,kidnaps,teleports,faults]
      [--logs intel,fhw] [--cases N] [--quick] [--mrpt] [--out DIR]

Tracking from the truth and from an unknown start; wake-ups at random moments; kidnaps, and teleports after Fox, Burgard,
Thrun (JAIR 1999); and constructed faults, each at other moments of the log. What fails is listed. All runs go into
OUT/benchmark.json, which `ortung compare` reads. With --mrpt, MRPT's pf-localization (Debian: mrpt-apps) tracks the same logs,
and a table has both.
"""
import argparse
import concurrent.futures
import json
import os
import random
import shutil
import subprocess
import sys

import sweeps
from evaluate import LASER, import_laser, mean, run

WINDOW_S = 30.0  # that a fault lasts
SHORT_S = 5.0
TELEPORTS_PER_M = 0.005
WALLS_MISSING = 0.2

# {window}: 30 s, {short}: 5 s, {at}: a moment, others for each run.
FAULTS = (
    ("none", []),
    ("crowd around the robot, 30 s", ["readings=crowd@{window}"]),
    ("scanner frozen, 30 s", ["readings=frozen@{window}"]),
    ("no readings, 30 s", ["readings=missing@{window}"]),
    ("4 of 5 scans dropped", ["readings=drop:0.8"]),
    ("a fifth of the walls missing in the map", None),
    ("odometry 20 % too long", ["odometry=scale:1.2"]),
    ("odometry backwards, 5 s", ["odometry=reverse@{short}"]),
    ("wheels slip, 5 s", ["odometry=slip@{short}"]),
    ("odometry jumps 1.7 m, 60 degrees", ["odometry=jump:1.5,0.8,60@{at}"]),
    ("no odometry", ["odometry=none"]),
    ("odometry all zero", ["odometry=zero"]),
    ("scans 2 s late", ["readings=late:2"]),
    ("30 % of beams random", ["readings=random:0.3"]),
    ("half of the beams shortened", ["readings=short:0.5"]),
    ("turns 20 % too large", ["odometry=turn:1.2"]),
)
PARTS = ("tracking", "wake-ups", "kidnaps", "teleports", "faults")


class Bench:
    """Commands of `ortung eval` as sweeps, as many at a time as there are cores, and what they gave."""

    def __init__(self, ortung, out):
        self.ortung = ortung
        self.out = out
        self.sweeps = sweeps.Sweeps(ortung, out, os.cpu_count())
        self.runs = []  # of all commands, as eval's JSON has them
        self.notes = []  # what went wrong

    def evaluate(self, name, jobs):
        """All jobs (base, arguments): their JSON, or None, in their order; notes why there is none. @param name of the sweep"""
        words = [["--source", "record:" + base + ".rec", *arguments] for base, arguments in jobs]
        unique = list(dict.fromkeys(" ".join(w) for w in words))  # of short logs some moments are the same
        lists = {" ".join(w): w for w in words}
        # What a run of MCL gives does not depend on threads, and the cores are busy with others.
        found = {}
        for task in self.sweeps.tasks(name, ["eval", "{job}", "--threads", "1"], {"job": [lists[one] for one in unique]}):
            found[task["values"]["job"]] = task
        results = []
        for (base, _), job in zip(jobs, words):
            task = found[" ".join(job)]
            figures = task["figures"]
            if figures is None:
                self.notes.append("%s: %s" % (os.path.basename(base), last_of(task.get("failed", "not done"))))
            else:
                figures = figures if "runs" in figures else {"runs": [figures], "summary": []}
                self.runs += figures["runs"]
            results.append(figures)
        return results

    def tell_notes(self):
        for note in self.notes:
            print("- not run: %s" % note)
        self.notes = []


def last_of(text):
    """The last line of what a command said."""
    return (text.strip().splitlines() or [""])[-1].removeprefix("ortung eval: ")


def table(title, head, rows):
    print("\n## %s\n\n| %s |\n|%s" % (title, " | ".join(head), "---|" * len(head)))
    for row in rows:
        print("| %s |" % " | ".join(row))
    print(flush=True)


def cell(value, form="%.3f"):
    return "-" if value is None or value != value else form % value


def rate(share):
    """A number of successes with its Wilson interval."""
    low, high = share["wilson95"]
    return "%d of %d (%.0f to %.0f %%)" % (share["count"], share["of"], 100 * low, 100 * high)


def wrong(runs):
    """Mean and worst share of time wrong while saying `tracking`, if the program tells it."""
    shares = [r["wrong_while_tracking_share"] for r in runs if r.get("wrong_while_tracking_share") is not None]
    return "%.4f / %.4f" % (mean(shares), max(shares)) if shares else "-"


def common(base):
    return ["--robot", base + "-robot.toml", "--tables", base + ".ortung"]


def tracking(bench, bases, cases):
    runs = cases or 5
    jobs = [(base, common(base) + ["--start", start, "--runs", str(runs)]) for base in bases for start in ("truth", "global")]
    rows = []
    for (base, arguments), result in zip(jobs, bench.evaluate("tracking", jobs)):
        if result is None:
            continue
        summary = result["summary"][0] if result["summary"] else None  # of one run there is none
        all_runs = result["runs"]
        good = [r for r in all_runs if r["converged_after_s"] is not None]
        row = [os.path.basename(base), arguments[arguments.index("--start") + 1]]
        row += ([rate(summary["converged"]), rate(summary["never_lost"])] if summary else
                ["%d of %d" % (len(good), len(all_runs)), "%d of %d" % (sum(r["lost_share"] == 0 for r in good), len(all_runs))])
        column = lambda key: [r[key] for r in good]
        row += [cell(mean(column("converged_after_s")), "%.1f")]
        row += [cell(mean(column("position_%s_m" % k))) for k in ("median", "p95", "p99")]
        row += [cell(max(column("position_max_m"), default=None)), cell(mean(column("lost_share")), "%.4f"),
                cell(mean(column("nees_mean")), "%.1f"), cell(mean(column("nees_above_share"))), wrong(good),
                cell(mean(column("update_ms_p50")), "%.2f"), cell(max(column("update_ms_max"), default=None), "%.0f")]
        rows.append(row)
    table("Tracking", ["log", "start", "converged", "never lost", "after [s]", "median [m]", "p95 [m]", "p99 [m]", "most [m]",
                       "lost", "NEES", "NEES > 16.3", "wrong while tracking", "ms p50", "ms most"], rows)


def cases_of(bench, bases, title, arguments_of):
    """A table of cases, and a list of those that failed."""
    jobs = [(base, common(base) + arguments_of(base)) for base in bases]
    rows = []
    failures = []
    events = right = 0
    for (base, _), result in zip(jobs, bench.evaluate(title.split(",")[0].lower(), jobs)):
        if result is None:
            continue
        name = os.path.basename(base)
        summary = result["summary"][0]
        share = summary["right"]
        events += share["of"]
        right += share["count"]
        rows.append([name, rate(share)] +
                    ["%s / %s" % (cell(summary[k]["p50"], f), cell(summary[k]["p95"], f))
                     for k, f in (("after_s", "%.1f"), ("after_m", "%.1f"), ("after_readings", "%.0f"))] +
                    [cell(summary["update_ms"]["max"], "%.0f"), wrong(result["runs"])])
        for one in result["runs"]:
            failures += ["%s %s %d (seed %d), at %.1f s in (%.1f, %.1f) m" % (
                name, one["case"]["kind"], one["case"]["number"], one["seed"], e["at_s"], e["x_m"], e["y_m"])
                for e in one["case"]["events"] if not e["right"]]
    rows.append(["all", "%d of %d" % (right, events), "", "", "", "", ""])
    table(title, ["log", "right (95 %)", "after [s], p50 / p95", "way [m]", "readings", "ms most", "wrong while tracking"], rows)
    for failure in failures:
        print("- never right: " + failure)


def wake_ups(bench, bases, cases):
    cases_of(bench, bases, "Wake-ups", lambda _: ["--wake-ups", str(cases or 50)])


def kidnaps(bench, bases, cases):
    cases_of(bench, bases, "Kidnaps", lambda _: ["--kidnap", str(cases or 20)])


def teleports(bench, bases, cases):
    cases_of(bench, bases, "Teleports, %g a metre" % TELEPORTS_PER_M,
             lambda _: ["--teleport", str(TELEPORTS_PER_M), "--runs", str(cases or 20)])


def duration(base):
    """Seconds from the first to the last reading of a record."""
    lines = subprocess.run(["zstdcat", "-f", base + ".rec"], check=True, stdout=subprocess.PIPE, text=True).stdout
    stamps = [int(line.split(" ", 1)[0]) for line in lines.splitlines() if not line.startswith("#")]
    return (stamps[-1] - stamps[0]) / 1e6


def remove_walls(base):
    """World and robot with a map that lacks a fifth of its walls, in squares of 1 m; returns what their names begin with."""
    other = base + "-fifth"
    with open(base + ".pgm", "rb") as picture:
        magic, size, most, cells = picture.read().split(b"\n", 3)
    columns, rows = map(int, size.split())
    if magic != b"P5" or most != b"255" or len(cells) != columns * rows:
        sys.exit("%s.pgm: is not as `ortung import` writes it" % base)
    cells = bytearray(cells)
    with open(base + ".yaml") as text:
        settings = text.read()
    tile = round(1.0 / next(float(line.split()[1]) for line in settings.splitlines() if line.startswith("resolution:")))
    chance = random.Random(1)
    for top in range(0, rows, tile):
        for left in range(0, columns, tile):
            if chance.random() >= WALLS_MISSING:
                continue
            for row in range(top, min(top + tile, rows)):
                for i in range(row * columns + left, row * columns + min(left + tile, columns)):
                    if cells[i] < 90:  # occupied: free
                        cells[i] = 254
    name = os.path.basename(base)
    with open(other + ".pgm", "wb") as picture:
        picture.write(b"\n".join((magic, size, most, cells)))
    for suffix in (".yaml", ".toml"):
        with open(base + suffix) as text, open(other + suffix, "w") as copy:
            copy.write(text.read().replace(name + ".pgm", name + "-fifth.pgm").replace(name + ".yaml", name + "-fifth.yaml"))
    shutil.copy(base + "-robot.toml", other + "-robot.toml")
    return other


def without_walls(ortung, base):
    """The same, with tables."""
    other = remove_walls(base)
    run([ortung, "learn", "--world", other + ".toml", "--robot", other + "-robot.toml", "--out", other + ".ortung"])
    return other


def fault_jobs(base, seconds, texts, runs):
    """The arguments of each run of one fault on one log, or nothing if the log is too short for it."""
    needs = WINDOW_S if any("{window}" in t for t in texts) else SHORT_S if any("{short}" in t or "{at}" in t for t in texts) else 0
    if needs and seconds < 20 + needs:
        return []
    if not needs:
        return [(base, ["--start", "truth", "--runs", str(runs), *[w for t in texts for w in ("--fault", t)]])]
    jobs = []
    for i in range(runs):
        begin = 10 + (seconds - 20 - needs) * (i + 0.5) / runs
        window = "%.1f-%.1f" % (begin, begin + needs)
        filled = [t.format(window=window, short=window, at="%.1f" % begin) for t in texts]
        jobs.append((base, ["--start", "truth", "--seed", str(i + 1), *[w for t in filled for w in ("--fault", t)]]))
    return jobs


def faults(bench, bases, cases):
    runs = cases or 8
    lost_rows = []
    wrong_rows = []
    failures = []
    lengths = {base: duration(base) for base in bases}
    jobs = []
    owners = []
    for name, texts in FAULTS:
        for base in bases:
            if texts is None:
                other = without_walls(bench.ortung, base)
                some = [(base, common(other) + ["--any-world", "--start", "truth", "--runs", str(runs)])]
            else:
                some = [(b, common(b) + a) for b, a in fault_jobs(base, lengths[base], texts, runs)]
            jobs += some
            owners += [(name, base)] * len(some)
    found = {}
    for owner, result in zip(owners, bench.evaluate("faults", jobs)):
        found.setdefault(owner, []).extend(result["runs"] if result else [])
    for name, _ in FAULTS:
        of = {base: found.get((name, base), []) for base in bases}
        lost = []
        row = [name]
        for base in bases:
            shares = [1.0 if r["lost_share"] is None else r["lost_share"] for r in of[base]]
            lost += shares
            row.append("%.3f / %.3f" % (mean(shares), max(shares)) if shares else "-")
            failures += ["%s, %s, seed %d%s: lost for %.1f %% of the time" % (
                name, os.path.basename(base), r["seed"], ", " + ", ".join(r["faults"]) if r["faults"] else "", 100 * s)
                for r, s in zip(of[base], shares) if s > 0.01]
        all_runs = [r for base in bases for r in of[base]]
        lost_rows.append(row + ["%.3f / %.3f" % (mean(lost), max(lost)) if lost else "-",
                                "%d of %d" % (sum(s == 0 for s in lost), len(lost))])
        wrong_rows.append([name] + [wrong(of[base]) for base in bases] + [wrong(all_runs)])
    names = [os.path.basename(base) for base in bases]
    table("Faults: share of time lost, mean / worst of %d runs" % runs, ["fault", *names, "all", "never lost"], lost_rows)
    if any(column != "-" for row in wrong_rows for column in row[1:]):
        table("Faults: share of time wrong while tracking, mean / worst", ["fault", *names, "all"], wrong_rows)
    for failure in failures:
        print("- " + failure)


def beside_rows(runs, others):
    """Rows of ours beside MRPT's: tracking of each log and start, errors at the times of updates, since MRPT's program tells no
    others; and why there are dashes."""
    rows, reasons = [], []
    for other in others:
        ours = [r for r in runs if os.path.basename(r["source"]) == other["log"] + ".rec" and r["start"] == other["start"] and
                not r["faults"] and "case" not in r]
        ours_good = [r for r in ours if r["converged_after_s"] is not None]
        good = [r for r in other["runs"] if r["converged_after"] is not None]
        row = [other["log"], other["start"], str(other["samples"])]
        row += ["%d of %d" % (len(g), len(a)) if a else "-" for g, a in ((ours_good, ours), (good, other["runs"]))]
        for mine, its, form in (("lost_share", "lost", "%.4f"), ("position_median_m", "median", "%.3f"),
                                ("position_rmse_m", "rmse", "%.3f")):
            row += [cell(mean([r["at_corrections"][mine] for r in ours_good]), form), cell(mean([r[its] for r in good]), form)]
        row += [cell(mean([r["update_ms_p50"] for r in ours]), "%.2f"), cell(mean([r["update_ms"] for r in other["runs"]]), "%.1f")]
        rows.append(row)
        reasons += ["%s, start %s, %d samples: MRPT not run: %s" % (other["log"], other["start"], other["samples"], why)
                    for why in dict.fromkeys(other["not_run"])]
        if other["runs"] and not good:
            reasons.append("%s, start %s, %d samples: MRPT never converged" % (other["log"], other["start"], other["samples"]))
    return rows, reasons


def mrpt(bench, data, logs, cases):
    if shutil.which("pf-localization") is None:
        print("\n## MRPT's pf-localization beside it\n\nLeft out: pf-localization is not installed (Debian: mrpt-apps).")
        return
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "compare-mrpt.sh")
    file = os.path.join(bench.out, "mrpt.json")
    done = subprocess.run([script, data, "--logs", ",".join(logs), "--samples", "2000", "--seeds", str(cases or 2), "--jobs", "1",
                           "--longest", "600", "--budget", "3600", "--json", file], stdout=subprocess.DEVNULL, check=False)
    if done.returncode != 0:
        print("\n## MRPT's pf-localization beside it\n\nLeft out: compare-mrpt.sh failed.")
        return
    with open(file) as text:
        rows, reasons = beside_rows(bench.runs, json.load(text))
    table("MRPT's pf-localization beside it, errors at updates",
          ["log", "start", "MRPT's samples", "converged, ours", "MRPT", "lost, ours", "MRPT", "median [m], ours", "MRPT",
           "RMSE [m], ours", "MRPT", "ms, ours", "MRPT"], rows)
    for reason in reasons:
        print("- " + reason)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung")
    parser.add_argument("data")
    parser.add_argument("--only", default=",".join(PARTS), help="of " + ", ".join(PARTS))
    parser.add_argument("--logs", default=",".join(LASER), help="of " + ", ".join(LASER))
    parser.add_argument("--cases", type=int, help="of each part and log, instead of 5 runs, 50 wake-ups, 20 kidnaps, 20 versions "
                                                  "with teleports and 8 runs a fault")
    parser.add_argument("--quick", action="store_true", help="2 of each: whether it works")
    parser.add_argument("--mrpt", action="store_true", help="also run MRPT's pf-localization, which takes minutes")
    parser.add_argument("--out", default="out/benchmark")
    arguments = parser.parse_args()
    parts = arguments.only.split(",")
    logs = arguments.logs.split(",")
    for given, known, option in ((parts, PARTS, "--only"), (logs, LASER, "--logs")):
        if unknown := [g for g in given if g not in known]:
            parser.error("%s is %s, expected some of %s" % (option, ",".join(unknown), ", ".join(known)))
    cases = arguments.cases or (2 if arguments.quick else None)
    if cases is not None and cases < 1:
        parser.error("--cases is %d, expected at least 1" % cases)
    arguments.out = os.path.abspath(arguments.out)
    os.makedirs(arguments.out, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        bases = list(pool.map(lambda name: import_laser(arguments.ortung, arguments.data, arguments.out, name), logs))
    bench = Bench(arguments.ortung, arguments.out)
    for part in parts:
        {"tracking": tracking, "wake-ups": wake_ups, "kidnaps": kidnaps, "teleports": teleports,
         "faults": faults}[part](bench, bases, cases)
        bench.tell_notes()
        with open(os.path.join(arguments.out, "benchmark.json"), "w") as file:
            json.dump({"compared_steps": sum(r["compared_steps"] for r in bench.runs), "runs": bench.runs}, file, indent=1)
    if arguments.mrpt:
        mrpt(bench, arguments.data, logs, cases)


if __name__ == "__main__":
    main()
