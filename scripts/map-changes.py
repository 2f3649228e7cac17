#!/usr/bin/env python3
"""Measures how soon walls that moved are noticed, and how often what did not change is called changed. Prints tables in Markdown.

  scripts/map-changes.py build/release/bin/ortung [../shared/data] [--walls 5] [--seeds 5] [--only alarms,walls,sim] [--logs intel,aces]
                         [--out DIR] [--write docs/method/self-calibration.md]

alarms  logs of laser scanners with maps made of them: groups of cells that are sure to have changed (some of them are people in the map)
walls   the same logs with maps in which 1.5 m of a straight wall stand half a metre farther into the room, --walls of each log, chosen
        by a seed among those that the robot passes at least three times: whether it is noticed before the third pass ends. A pass is a
        piece of way within 4 m on the wall's side, with six updates at least
sim     simulated drives of a Pioneer in a small room, --seeds of each: as it was learned, and with a box half a metre farther along

Only `ortung localize --belief` is asked; noticed is a wall if a third of its cells is sure to be gone.
"""
import argparse
import ast
import os
import random
import sys
import tempfile

import numpy as np

import results_page
from evaluate import LASER, MAPS, import_laser, run

CELL = 0.1
INTO = 0.5    # the way that walls are moved [m]
LENGTH = 1.5  # of a piece of wall [m]
NEAR = 4.0    # a pass is within [m]
UPDATES = 6   # of a pass, at least


def localize(ortung, robot, tables, source, seed=1):
    """Stamps [us] and positions, and the cells that are sure to have changed: rows of kind (0 gone, 1 new), x, y."""
    with tempfile.TemporaryDirectory() as folder:
        belief = os.path.join(folder, "belief")
        text = run([ortung, "localize", "--robot", robot, "--tables", tables, "--source", source, "--start", "global", "--any-world",
                    "--seed", seed, "--belief", belief])
        rows = np.array([[float(v) for v in line.split()[:3]] for line in text.splitlines()[1:]])
        stamps, path = rows[:, 0], rows[:, 1:]
        with np.load(belief) as saved:
            if "changes" not in saved:
                return stamps, path, np.zeros((0, 3))
            numbers, middles = saved["changes"], saved["changes_m"]
    sure = numbers[:, 8] == 1
    return stamps, path, np.column_stack([numbers[sure, 0], middles[sure]])


def way(path):
    return float(np.hypot(*np.diff(path, axis=0).T).sum())


def groups(cells):
    """How many groups of cells there are, of one kind each, no farther from each other than two cells."""
    left = list(map(tuple, cells))
    count = 0
    while left:
        count += 1
        group = [left.pop()]
        while group:
            kind, x, y = group.pop()
            near = [c for c in left if c[0] == kind and max(abs(c[1] - x), abs(c[2] - y)) < 2.5 * CELL]
            left = [c for c in left if c not in near]
            group += near
    return count


def alarms(options, out):
    rows = []
    total = [0.0, 0]
    for name in options.logs:
        base = import_laser(options.ortung, options.data, out, name)
        _, path, cells = localize(options.ortung, base + "-robot.toml", base + ".ortung", "record:" + base + ".rec")
        count = groups(cells)
        total = [total[0] + way(path), total[1] + count]
        rows.append("| %s | %.0f | %d | %d |" % (name, way(path), len(cells), count))
        print(rows[-1], file=sys.stderr)
    rows.append("| all | %.0f | | %d: %.1f in 1,000 m |" % (*total, 1000 * total[1] / total[0]))
    return "| log | way [m] | cells | groups |\n|---|---|---|---|\n" + "\n".join(rows)


class Map:
    """The picture of a log's map, the top row first."""

    def __init__(self, base):
        with open(base + ".pgm", "rb") as file:
            assert file.readline() == b"P5\n"
            self.columns, self.rows = map(int, file.readline().split())
            file.readline()
            self.cells = np.frombuffer(file.read(), np.uint8).reshape(self.rows, self.columns)
        with open(base + ".yaml") as file:
            self.yaml = file.read()
        values = dict(line.split(":", 1) for line in self.yaml.splitlines() if ":" in line)
        self.edge = float(values["resolution"])
        self.origin = ast.literal_eval(values["origin"].strip())
        assert self.origin[2] == 0, "a map that is not turned"

    def x(self, column):
        return self.origin[0] + (column + 0.5) * self.edge

    def y(self, row):
        return self.origin[1] + (self.rows - 1 - row + 0.5) * self.edge

    def write(self, base, cells, name):
        with open(base + ".pgm", "wb") as file:
            file.write(b"P5\n%d %d\n255\n" % (self.columns, self.rows) + cells.tobytes())
        with open(base + ".yaml", "w") as file:
            file.write(self.yaml.replace(name + ".pgm", os.path.basename(base) + ".pgm"))


def passes(path, wall_y, xs, side):
    """The updates of each pass of a piece of wall."""
    points = np.column_stack([xs, np.full(len(xs), wall_y)])
    away = np.sqrt(((path[:, None] - points[None]) ** 2).sum(2)).min(1)
    near = np.nonzero((away < NEAR) & ((path[:, 1] - wall_y) * side > 0.3))[0]
    found = np.split(near, np.nonzero(np.diff(near) > 15)[0] + 1) if len(near) else []
    return away.min(), [p for p in found if len(p) >= UPDATES]


def moved_walls(grid, path, count, rng):
    """Straight pieces along x that can stand half a metre farther into the room, beside the robot's path."""
    occupied, free = grid.cells < 90, grid.cells > 250
    length, into = round(LENGTH / grid.edge), round(INTO / grid.edge)
    found = []
    for _ in range(200000):
        if len(found) == count:
            break
        row, column = rng.randrange(2 * into, grid.rows - 2 * into), rng.randrange(length, grid.columns - 2 * length)
        here = slice(column, column + length)
        if not occupied[row, column] or occupied[row - 1:row + 2, here].any(0).mean() < 0.97:
            continue
        for step in (1, -1):
            if free[row + step * np.arange(3, 2 * into + 2)][:, here].mean() < 0.98:
                continue
            new = row + step * into
            least, around = passes(path, grid.y(new), grid.x(np.arange(column, column + length)), -step)
            taken = any(abs(new - w[1]) < into and abs(column - w[2]) < length for w in found)
            if least > 0.5 and len(around) >= 3 and not taken:
                found.append((row, new, column, length, around))
                break
    return found


def walls(options, out):
    rows = []
    for name in options.logs:
        base = import_laser(options.ortung, options.data, out, name)
        grid = Map(base)
        stamps, path, _ = localize(options.ortung, base + "-robot.toml", base + ".ortung", "record:" + base + ".rec")
        noticed = tried = 0
        for row, new, column, length, around in moved_walls(grid, path, options.walls, random.Random(1)):
            cells = grid.cells.copy()
            cells[row - 2:row + 3, column:column + length] = 205
            low, high = sorted((row, new))
            cells[low:high + 1, column:column + length] = 205
            cells[new, column:column + length] = 0
            other = os.path.join(out, "moved")
            grid.write(other, cells, name)
            with open(base + ".toml") as world, open(other + ".toml", "w") as file:
                file.write(world.read().replace(name + ".yaml", "moved.yaml"))
            run([options.ortung, "learn", "--world", other + ".toml", "--robot", base + "-robot.toml", "--out", other + ".ortung", "--force"])
            end = 1e-6 * (stamps[around[2][-1]] - stamps[0]) + 5.0
            *_, found = localize(options.ortung, base + "-robot.toml", other + ".ortung", "record:%s.rec?to_s=%.3f" % (base, end))
            gone = found[(found[:, 0] == 0) & (abs(found[:, 2] - grid.y(new)) < 0.2) &
                         (found[:, 1] > grid.x(column) - CELL) & (found[:, 1] < grid.x(column + length) + CELL)]
            tried += 1
            noticed += len(gone) >= LENGTH / CELL / 3
        rows.append((name, tried, noticed))
        print(rows[-1], file=sys.stderr)
    rows.append(("all", sum(r[1] for r in rows), sum(r[2] for r in rows)))
    return "| log | walls | noticed |\n|---|---|---|\n" + "\n".join("| %s | %d | %d |" % r for r in rows)


def sim(options, out):
    world = os.path.join(MAPS, "fields/arena.toml")
    robot = os.path.join(MAPS, "robots/pioneer_lrf.toml")
    tables = os.path.join(out, "arena.ortung")
    run([options.ortung, "learn", "--world", world, "--robot", robot, "--out", tables, "--force"])
    with open(world) as file:
        text = file.read()
    moved = os.path.join(out, "arena-moved.toml")
    assert "center_m = [1.2, -1.3]" in text
    with open(moved, "w") as file:
        file.write(text.replace("center_m = [1.2, -1.3]", "center_m = [0.7, -1.3]"))
    rows = []
    for what, where, seconds in (("as it was learned", world, 600), ("a box half a metre farther along, 180 s", moved, 180)):
        metres, count, noticed = 0.0, 0, 0
        for seed in range(1, options.seeds + 1):
            _, path, cells = localize(options.ortung, robot, tables, "sim:%s?duration=%d&seed=%d" % (where, seconds, seed), seed)
            metres += way(path)
            count += groups(cells)
            noticed += len(cells) > 5
        rows.append("| %s | %d | %.0f | %d | %d |" % (what, options.seeds, metres, count, noticed))
        print(rows[-1], file=sys.stderr)
    return "| room | drives | way [m] | groups | noticed |\n|---|---|---|---|---|\n" + "\n".join(rows)


PARTS = {"alarms": ("Map changes: logs", alarms), "walls": ("Map changes: moved walls", walls), "sim": ("Map changes: simulated drives", sim)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung")
    parser.add_argument("data", nargs="?", default="../shared/data")
    parser.add_argument("--walls", type=int, default=5)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--only", default=",".join(PARTS))
    parser.add_argument("--logs", default="intel,fhw,aces,freiburg-101,freiburg-079,jarvis,belgioioso,sena_telecom")
    parser.add_argument("--out", default=None, help="where imported logs stay (default: a folder that is removed)")
    parser.add_argument("--write", default=None, help="page whose tables are replaced")
    options = parser.parse_args()
    options.logs = [name for name in options.logs.split(",") if name in LASER]
    with tempfile.TemporaryDirectory() as temporary:
        out = options.out or temporary
        os.makedirs(out, exist_ok=True)
        with results_page.written(options.write):
            for name in options.only.split(","):
                title, measure = PARTS[name]
                print("\n## %s\n" % title, flush=True)
                print(measure(options, out), flush=True)


if __name__ == "__main__":
    main()
