#!/usr/bin/env python3
"""Runs the experiments of docs/tuning.md: puts their tables into the page, and draws its pictures.

  scripts/tuning.py build/release/bin/ortung [--only NAME,...] [--drives 3] [--out DIR] [--write docs/tuning.md]

Each experiment changes one key of a robot file, or disturbs its readings, and evaluates the same recorded drives. With --write the
pictures go into pictures/ beside the page.
"""
import argparse
import json
import os
import re
import sys

import results_page
import sweeps
from evaluate import MAPS, mean, run

HEAD = ("converged", "after [s]", "median [m]", "RMSE [m]", "heading RMSE [deg]", "lost", "NEES", "tracking", "samples")
SCANNER = ("pioneer_lrf", "f2000_hall")
POSTS = ("pioneer_posts", "f2000")
SIGMAS = {"range_sigma_m": 0.1, "range_sigma_per_m": 0.05, "bearing_sigma_deg": 3.0}


def sigmas(factor):
    return {key: value * factor for key, value in SIGMAS.items()}


def noise(factor):
    """Of odometry: what the simulated robot has, times a factor."""
    return {"[motion] turn_per_turn": 0.028 * factor, "[motion] turn_per_m": 0.0175 * factor, "[motion] way_per_m": 0.02 * factor,
            "[motion] way_per_turn": 0.002 * factor}


# Name: robot and field; the column of what is varied; rows of (what it is, keys, further arguments); rows of the picture.
EXPERIMENTS = {
    "Sensor noise": (POSTS, "sigmas of the model", [
        ("a fifth", sigmas(0.2), []), ("half", sigmas(0.5), []), ("right", {}, []), ("twice", sigmas(2.0), []),
        ("five times", sigmas(5.0), [])], (0, 2, 4)),
    "Outliers": (POSTS, "`outliers`, half of the sightings false", [
        (str(v), {"outliers": v}, ["--fault", "readings=random:0.5"]) for v in (0.001, 0.05, 0.3)], None),
    "Exponent": (SCANNER, "`exponent`, people around for 20 s", [
        (str(v), {"exponent": v}, ["--fault", "readings=crowd@20-40"]) for v in (0.005, 0.06, 0.3, 1.0)], (0, 1, 3)),
    "Motion noise": (POSTS, "noise in `[motion]`", [
        ("none of it", noise(0.0), []), ("right", noise(1.0), []), ("five times", noise(5.0), []), ("twenty times", noise(20.0), [])],
        (0, 1, 3)),
    "Odometry that is wrong": (POSTS, "`[motion]`, odometry says 20 % too much", [
        (name, keys, ["--fault", "odometry=scale:1.2"]) for name, keys in
        (("noise as if it were right", noise(1.0)), ("five times that", noise(5.0)),
         ("`way_scale = 0.833`", {**noise(1.0), "[motion] way_scale": 0.8333}))], (0, 1, 2)),
    "Mount": (SCANNER, "scanner turned by, in truth 0", [
        ("%g degrees" % v, {"pose": "{ x_m = 0.1, y_m = 0.0, z_m = 0.3, theta_deg = %g }" % v}, []) for v in (0, 1, 3)], (0, 2)),
    "Late readings": (POSTS, "stamps of readings late by", [
        ("%g s" % v, {}, ["--fault", "readings=late:%g" % v] if v else []) for v in (0, 0.1, 0.2, 0.5)], None),
    "Samples": (POSTS, "`particles`, of which `min_particles`", [
        ("%d, %d" % (n, m), {"[mcl] particles": n, "[mcl] min_particles": m}, []) for n, m in
        ((100, 100), (500, 500), (20000, 100), (20000, 500), (20000, 5000))], None),
    "Cells": (SCANNER, "`ortung learn --cell`", [("%g m" % v, {}, []) for v in (0.05, 0.1, 0.2, 0.4)], None),
}


def changed(text, keys):
    """The robot file with other values: of all sensors that have the key, or "[table] key"."""
    for key, value in keys.items():
        if key.startswith("["):
            table, name = key.split()
            if table not in text:
                text += "\n%s\n" % table
            text = re.sub(r"(?m)^%s *=.*\n" % name, "", text)
            text = text.replace(table + "\n", "%s\n%s = %s\n" % (table, name, value), 1)
        else:
            text, count = re.subn(r"(?m)^%s *=.*$" % key, "%s = %s" % (key, value), text)
            if count == 0:
                sys.exit("tuning: the robot file has no key " + key)
    return text


class Bench:
    def __init__(self, ortung, out, drives):
        self.ortung, self.out, self.drives = os.path.abspath(ortung), os.path.abspath(out), drives
        self.sweeps = sweeps.Sweeps(ortung, out, os.cpu_count())

    def files(self, setup):
        """World, robot file's text and what the names of recorded drives begin with."""
        robot, field = setup
        world = os.path.join(MAPS, "fields", field + ".toml")
        base = os.path.join(self.out, robot)
        file = base + "-list.toml"  # all landmarks of a moment together, so that some may be false
        with open(os.path.join(MAPS, "robots", robot + ".toml")) as shipped, open(file, "w") as out:
            out.write(shipped.read().replace('features = "each"', 'features = "list"'))
        for seed in range(1, self.drives + 1):
            record = "%s-%d.rec" % (base, seed)
            if not os.path.exists(record):
                run([self.ortung, "import", "sim", world, "--with-robot", file, "--option", "duration=60", "--option",
                     "seed=%d" % seed, "--out", record])
        return world, file, open(file).read(), base

    def tables(self, name, world, robot, cell):
        """Tables of a robot, which are learned once."""
        tables = os.path.join(self.out, "%s-%s.ortung" % (name, cell))
        if not os.path.exists(tables):
            run([self.ortung, "learn", "--world", world, "--robot", robot, "--cell", cell, "--out", tables])
        return tables

    def variant(self, name, number, world, robot, text, cell):
        """A row's robot file and tables."""
        base = os.path.join(self.out, "%s-%d" % (re.sub(r"\W+", "-", name), number))
        with open(base + ".toml", "w") as file:
            file.write(text)
        if name == "Mount":  # tables are of a sensor where it sits
            return base + ".toml", self.tables(os.path.basename(base), world, base + ".toml", cell)
        return base + ".toml", self.tables(os.path.basename(robot), world, robot, cell)

    def drawn(self, name, number, words, source):
        """What a report of one drive draws."""
        page_file = os.path.join(self.out, "%s-%d.html" % (re.sub(r"\W+", "-", name), number))
        run([self.ortung, "eval", *words, "--source", source, "--force", "--report", page_file])
        page = open(page_file).read()
        begin = page.index('id="data">') + len('id="data">')
        return json.loads(page[begin:page.index("</script>", begin)])


def row(runs):
    good = [r for r in runs if r["converged_after_s"] is not None]
    m = lambda key, form: form % mean([r[key] for r in good]) if good else "-"
    return ["%d of %d" % (len(good), len(runs)), m("converged_after_s", "%.1f"), m("position_median_m", "%.3f"),
            m("position_rmse_m", "%.3f"), m("heading_rmse_deg", "%.2f"), m("lost_share", "%.3f"), m("nees_mean", "%.1f"),
            "%.2f" % mean([r["tracking_share"] for r in runs]), m("particles_mean", "%.0f")]


def peaks(times, values, seconds):
    """The greatest value of each piece of so many seconds: what is drawn is no wider than a screen."""
    found = {}
    for time, value in zip(times, values):
        if value is not None:
            piece = int(time / seconds)
            found[piece] = max(found.get(piece, 0.0), value)
    return [((piece + 0.5) * seconds, value) for piece, value in sorted(found.items())]


def panel(data, kind, title, top, left, width, height):
    """Error (line) and the filter's own sigma (area) of one run. kind: position [m] or heading [degrees]"""
    scale_x = width / max(data["time"][-1], 1e-9)
    points = lambda values: ["%.0f,%.0f" % (left + t * scale_x, 20 + height * (1 - min(v, top) / top))
                             for t, v in peaks(data["time"], values, 0.4)]
    area = ["%d,%d" % (left, 20 + height), *points(data[kind + "Sigma"]), "%d,%d" % (left + width, 20 + height)]
    grid = "".join('<path d="M%d %.0fH%d" stroke="#ccd"/><text x="%d" y="%.0f" text-anchor="end">%.2g</text>' % (
        left, 20 + height * (1 - k / 2), left + width, left - 4, 24 + height * (1 - k / 2), top * k / 2) for k in range(3))
    return ('<text x="%d" y="12" font-weight="bold">%s</text>%s<polygon points="%s" fill="#9aa7b8" fill-opacity="0.45"/>'
            '<polyline points="%s" fill="none" stroke="#d45500" stroke-width="1.2"/><text x="%d" y="%d" text-anchor="end">60 s</text>') % (
        left, title, grid, " ".join(area), " ".join(points(data[kind])), left + width, 34 + height)


def picture(file, kind, rows, chosen):
    """Panels beside each other, on one scale: that of the run which is best known to be right, times a few."""
    width, height, gap = 270, 110, 50
    top = 0.0
    for i in chosen:  # large enough for most of each, before convergence left out
        errors = sorted(v for t, v in zip(rows[i][1]["time"], rows[i][1][kind]) if t > 5 and v is not None)
        top = max(top, errors[int(0.98 * (len(errors) - 1))])
    panels = [panel(rows[i][1], kind, re.sub("`", "", rows[i][0]), 1.2 * top, gap + n * (width + gap), width, height)
              for n, i in enumerate(chosen)]
    total = len(chosen) * (width + gap) + 20
    with open(file, "w") as out:
        out.write('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="sans-serif" font-size="11">'
                  '<rect width="100%%" height="100%%" fill="#fff"/>%s</svg>\n' % (total, height + 42, "".join(panels)))


def experiment(bench, name, pictures):
    setup, column, variants, chosen = EXPERIMENTS[name]
    world, robot, text, base = bench.files(setup)
    words = []  # of each row
    for i, (what, keys, extra) in enumerate(variants):
        file, tables = bench.variant(name, i, world, robot, changed(text, keys), what.split()[0] if name == "Cells" else "0.1")
        words.append(["--robot", file, "--tables", tables, *extra])
    found = bench.sweeps.groups(re.sub(r"\W+", "-", name.lower()), ["eval", "--source", "record:%s-{seed}.rec" % base, "{row}"],
                                {"row": words, "seed": sweeps.seeds(bench.drives)})
    print("\n## %s\n\n| %s | %s |\n|%s" % (name, column, " | ".join(HEAD), "---|" * (len(HEAD) + 1)))
    for (what, *_), runs in zip(variants, found.values()):
        print("| %s | %s |" % (what, " | ".join(row(runs))), flush=True)
    if chosen and pictures:
        drawn = {i: (variants[i][0], bench.drawn(name, i, words[i], "record:%s-1.rec" % base)) for i in chosen}
        picture(os.path.join(pictures, "tuning-%s.svg" % name.lower().replace(" ", "-")),
                "heading" if name == "Mount" else "position", drawn, chosen)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung")
    parser.add_argument("--only", default=",".join(EXPERIMENTS), help="of " + ", ".join(EXPERIMENTS))
    parser.add_argument("--drives", type=int, default=3)
    parser.add_argument("--out", default="out/tuning")
    parser.add_argument("--write", metavar="FILE", help="put tables into this page, and pictures beside it")
    arguments = parser.parse_args()
    names = arguments.only.split(",")
    if unknown := [n for n in names if n not in EXPERIMENTS]:
        parser.error("--only is %s, expected some of %s" % (",".join(unknown), ", ".join(EXPERIMENTS)))
    os.makedirs(arguments.out, exist_ok=True)
    pictures = os.path.join(os.path.dirname(arguments.write), "pictures") if arguments.write else arguments.out
    bench = Bench(arguments.ortung, arguments.out, arguments.drives)
    for name in names:
        with results_page.written(arguments.write):
            experiment(bench, name, pictures)


if __name__ == "__main__":
    main()
