#!/usr/bin/env python3
"""Counts errors beyond the protection level, drive by drive and cause by cause. Prints a table in Markdown.

  scripts/protection.py build/release/bin/ortung [../shared/data] [--drives 60] [--only sim,logs] [--logs intel,aces] [--out DIR] [--write docs/method/trust.md]

sim   simulated drives of a minute: four robots, in a hall and on a field, without faults and with each fault of a kind that they can
      meet, --drives of each; the simulator's seed, the fault's and the filter's differ
logs  the logs of laser scanners (../shared/data), without faults and with each fault, --drives / 20 seeds of each (at least 1)

A drive counts as beyond if its error was beyond the level once while tracking. Shares of time are of that status; the ratio is the
median level by the median error while tracking. --write puts the tables behind their marks in the page.
"""
import argparse
import json
import os
import statistics
import sys
import tempfile

import results_page
from evaluate import LASER, MAPS, import_laser, run

ROBOTS = {"pioneer_lrf": "f2000_hall", "pioneer": "f2000", "pioneer_posts": "f2000", "sonar_ring": "f2000_hall"}
SCANNERS = ("pioneer_lrf", "pioneer")
FAULTS = ("", "odometry=scale:1.1", "odometry=turn:1.2", "odometry=slip@{0}-{1}", "odometry=jump:0.3,0.1,20@{0}", "odometry=zero@{0}-{1}",
          "odometry=none@{0}-{1}", "odometry=reverse@{0}-{1}", "readings=drop:0.5", "readings=missing@{0}-{2}",
          "readings=frozen@{0}-{2}", "readings=late:0.3@{0}")
SCANS = ("readings=random:0.3", "readings=short:0.3", "readings=crowd@{0}-{3}")  # of scanners
HEAD = "| | drives | beyond the level once | of the time tracked | of the time uncertain | median level by median error | tracked |"


def chosen(options, faults):
    """The faults that are tried, each with its number, which its seeds follow from."""
    names = options.faults.split(",") if options.faults else None
    return [(n, f) for n, f in enumerate(faults) if names is None or name_of(f) in names]


def name_of(fault):
    return fault.split("=")[0].split("/")[-1] + " " + fault.split("=")[1].split("@")[0] if fault else "no fault"


class Row:
    """What drives of one kind have said."""

    def __init__(self):
        self.runs = []

    def add(self, runs):
        self.runs += runs

    def text(self, name):
        tracked = [r for r in self.runs if r["beyond_protection_share"] is not None]
        beyond = sum(1 for r in tracked if r["beyond_protection_share"] > 0)

        def share(key, weight):
            pairs = [(r[key], weight(r)) for r in self.runs if r[key] is not None]
            total = sum(w for _, w in pairs)
            return "%.4f" % (sum(v * w for v, w in pairs) / total) if total else "-"
        ratios = [r["protection_ratio"] for r in tracked if r["protection_ratio"] is not None]
        return "| %s | %d | %d | %s | %s | %s | %s |" % (
            name, len(self.runs), beyond, share("beyond_protection_share", lambda r: r["tracking_share"]),
            share("beyond_protection_uncertain_share", lambda r: 1 - r["tracking_share"]),
            "%.1f" % statistics.median(ratios) if ratios else "-", share("tracking_share", lambda r: 1))


def drive(ortung, sources, robot, tables, fault, seed, runs):
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        run([ortung, "eval", *[word for source in sources for word in ("--source", source)], "--robot", robot, "--tables", tables,
             "--start", "truth", "--seed", str(seed), "--runs", str(runs), "--json", out.name, *(["--fault", fault] if fault else [])])
        result = json.load(open(out.name))
    return result["runs"] if "runs" in result else [result]


def table(title, rows):
    lines = ["", "## " + title, "", HEAD, "|---|---|---|---|---|---|---|"]
    lines += [row.text(name) for name, row in rows.items()]
    whole = Row()
    for row in rows.values():
        whole.add(row.runs)
    lines.append(whole.text("all"))
    print("\n".join(lines), flush=True)


def simulated(options, out):
    rows = {}
    for robot, world in ROBOTS.items():
        file, field = os.path.join(MAPS, "robots", robot + ".toml"), os.path.join(MAPS, "fields", world + ".toml")
        tables = os.path.join(out, robot + ".ortung")
        run([options.ortung, "learn", "--world", field, "--robot", file, "--out", tables, "--force"])
        for number, fault in chosen(options, FAULTS + (SCANS if robot in SCANNERS else ())):
            sources = ["sim:%s?duration=60&seed=%d" % (field, 1000 * number + i) for i in range(1, options.drives + 1)]
            row = rows.setdefault("%s, %s" % (robot, name_of(fault)), Row())
            row.add(drive(options.ortung, sources, file, tables, fault.format(20, 24, 25, 40), number + 1, 1))
    table("Protection levels: simulated drives", rows)


def recorded(options, out):
    rows = {}
    for name in LASER:
        if options.logs and name not in options.logs.split(","):
            continue
        base = import_laser(options.ortung, options.data, out, name)
        for number, fault in chosen(options, FAULTS + SCANS):
            row = rows.setdefault(name_of(fault), Row())
            row.add(drive(options.ortung, ["record:" + base + ".rec"], base + "-robot.toml", base + ".ortung",
                          fault.format(60, 65, 70, 80), number + 1, max(1, options.drives // 20)))
    table("Protection levels: logs", rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung")
    parser.add_argument("data", nargs="?", help="folder of the logs")
    parser.add_argument("--drives", type=int, default=60)
    parser.add_argument("--only", default="sim,logs")
    parser.add_argument("--faults", metavar="NAMES", help="rows of the tables, by commas, as 'no fault,odometry none'; all by default")
    parser.add_argument("--logs", metavar="NAMES", help="logs, by commas; all by default")
    parser.add_argument("--out")
    parser.add_argument("--write", metavar="PAGE")
    options = parser.parse_args()
    parts = options.only.split(",")
    if unknown := [p for p in parts if p not in ("sim", "logs")]:
        parser.error("unknown part %s, expected sim or logs" % ", ".join(unknown))
    if "logs" in parts and not options.data:
        parser.error("logs need their folder")
    with tempfile.TemporaryDirectory() as folder:
        out = options.out or folder
        os.makedirs(out, exist_ok=True)
        with results_page.written(options.write):
            if "sim" in parts:
                simulated(options, out)
            if "logs" in parts:
                recorded(options, out)


if __name__ == "__main__":
    main()
