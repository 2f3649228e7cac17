#!/usr/bin/env python3
"""Runs the evaluation of docs/motion.md and prints its tables as Markdown.

  scripts/evaluate-motion.py build/release/bin/ortung ../shared/data [--only mrclam,laser,network] [--seeds 5] [--out DIR]

MRCLAM: motion is learned on robots 1 and 2 of run 6, and tried on robots 3, 4 and 5.
Lasers: motion is learned on the first half of a log, and tried on all of it.
"""
import argparse
import json
import os
import re
import tempfile

from evaluate import run

HAND_SET = {  # turn_per_turn, turn_per_m, way_per_m, way_per_turn
    "default": "",
    "hand-set, measured": "0.13,0.09,0.02,0.03",
    "hand-set, narrow": "0.1,0.05,0.1,0.05",
    "hand-set, narrow ways": "0.2,0.1,0.05,0.03",
    "hand-set, wide turns": "0.3,0.1,0.05,0.05",
    "hand-set, wide": "0.3,0.2,0.1,0.1",
    "hand-set, wide ways": "0.2,0.1,0.2,0.1",
}
LASER = ["carmen/intel", "carmen/freiburg-101", "mrpt_sena_telecom", "mrpt_localization_demo"]
HEAD = "| motion | runs | converged | median [m] | RMSE [m] | heading RMSE [deg] | NEES | lost |\n|" + "---|" * 8


def keep(file, out, drop):
    """The table [motion] of a file without some keys."""
    lines = [line for line in open(file) if not re.match(drop, line)]
    open(out, "w").writelines(lines)
    return out


def row(ortung, name, cases, tables, motion, seeds, start):
    results = []
    for record, robot in cases:
        for seed in range(1, seeds + 1):
            with tempfile.NamedTemporaryFile(suffix=".json") as out:
                run([ortung, "eval", "--source", "record:" + record, "--robot", robot, "--tables", tables,
                     "--start", start, "--seed", seed, "--json", out.name] + (["--motion", motion] if motion else []))
                results.append(json.load(open(out.name)))
    good = [r for r in results if r["converged_after_s"] is not None]
    m = lambda key: sum(r[key] for r in good) / max(len(good), 1)
    print("| %s | %d | %d | %.3f | %.3f | %.2f | %.1f | %.3f |" % (
        name, len(results), len(good), m("position_median_m"), m("position_rmse_m"), m("heading_rmse_deg"),
        m("nees_mean"), m("lost_share")), flush=True)


def import_mrclam(ortung, data, out):
    base = [os.path.join(out, "ds6-%d" % r) for r in range(1, 6)]
    for robot in range(1, 6):
        run([ortung, "import", "mrclam", os.path.join(data, "utias_mrclam/ds6"), "--robot", robot, "--out",
             base[robot - 1] + ".rec", "--world", os.path.join(out, "ds6.toml"), "--robot-file",
             base[robot - 1] + "-robot.toml", "--force"])
        # What was learned of these robots is in the file already: here it is learned anew.
        with open(base[robot - 1] + "-robot.toml") as file:
            text = file.read()
        with open(base[robot - 1] + "-robot.toml", "w") as file:
            file.write(text.split("[motion]")[0])
    return base


def mrclam(ortung, data, out, seeds):
    base = import_mrclam(ortung, data, out)
    tables = os.path.join(out, "ds6.ortung")
    run([ortung, "learn", "--world", os.path.join(out, "ds6.toml"), "--robot", base[0] + "-robot.toml", "--out", tables,
         "--cell", "0.05"])
    learned = os.path.join(out, "motion.toml")
    print(run([ortung, "learn-motion", base[0] + ".rec", base[1] + ".rec", "--robot", base[0] + "-robot.toml", "--out",
               learned]))
    cases = [(b + ".rec", b + "-robot.toml") for b in base[2:]]
    variants = dict(HAND_SET)
    variants["learned"] = learned
    variants["learned, no delay"] = keep(learned, learned + "-1.toml", "delay")
    variants["learned, noise only"] = keep(learned, learned + "-2.toml", "delay|way_scale|turn_scale|.*bias")
    variants["learned, no slip"] = keep(learned, learned + "-3.toml", "slip")
    for start in ("truth", "global"):
        print("\nMRCLAM run 6, robots 3 to 5, start %s:\n\n%s" % (start, HEAD), flush=True)
        for name, motion in variants.items():
            row(ortung, name, cases, tables, motion, seeds, start)


def laser(ortung, data, out, seeds):
    for folder in LASER:
        name = os.path.basename(folder)
        base = os.path.join(out, name)
        run([ortung, "import", "scanlog", os.path.join(data, folder), "--out", base + ".rec", "--world", base + ".toml",
             "--robot-file", base + "-robot.toml", "--force"])
        run([ortung, "learn", "--world", base + ".toml", "--robot", base + "-robot.toml", "--out", base + ".ortung"])
        learned = base + "-motion.toml"
        text = run([ortung, "learn-motion", base + ".rec", "--robot", base + "-robot.toml", "--out", learned, "--to", "0.5"])
        print("\n%s, start truth: %s\n\n%s" % (name, ", ".join(
            "%s %s" % pair for pair in re.findall(r"(\w+) += (\S+)", text) if not pair[0].startswith("floor")), HEAD))
        cases = [(base + ".rec", base + "-robot.toml")]
        row(ortung, "default", cases, base + ".ortung", "", seeds, "truth")
        row(ortung, "learned", cases, base + ".ortung", learned, seeds, "truth")
        row(ortung, "corrections, default noise", cases, base + ".ortung",
            keep(learned, learned + "-1.toml", "(turn|way)_per|slip"), seeds, "truth")


def network(ortung, data, out, seeds):
    base = import_mrclam(ortung, data, out)
    print("\nMRCLAM run 6, robots 1 to 3\n")
    print(run([ortung, "train-motion"] + [b + ".rec" for b in base[:3]] +
              ["--robot", base[0] + "-robot.toml", "--out", os.path.join(out, "mrclam.json")]))
    folder = os.path.join(data, "crob_lab_jarvis/complex_path_fast")
    jarvis = os.path.join(out, "jarvis")
    run([ortung, "import", "scanlog", os.path.join(folder, "security"), "--out", jarvis + ".rec", "--robot-file",
         jarvis + "-robot.toml", "--force", "--option", "odom=%s/odom.txt.xz" % folder, "--option",
         "commands=%s/cmd_vel.txt" % folder])
    print("\njarvis, complex_path_fast\n")
    print(run([ortung, "train-motion", jarvis + ".rec", "--robot", jarvis + "-robot.toml", "--out", jarvis + ".json",
               "--step", "0.2", "--hidden", "12"]))
    maps = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "maps")
    robot = os.path.join(maps, "robots/pioneer.toml")
    record = os.path.join(out, "pioneer.rec")
    run([ortung, "import", "sim", os.path.join(maps, "fields/arena.toml"), "--out", record, "--option", "duration=300",
         "--with-robot", robot])
    print("\nthe simulated pioneer (differential)\n")
    print(run([ortung, "train-motion", record, "--robot", robot, "--out", os.path.join(out, "pioneer.json")]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung")
    parser.add_argument("data")
    parser.add_argument("--only", default="mrclam,laser,network")
    parser.add_argument("--seeds", type=int, default=5, help="runs of each log")
    parser.add_argument("--out", default="out/evaluate-motion")
    arguments = parser.parse_args()
    os.makedirs(arguments.out, exist_ok=True)
    for part in arguments.only.split(","):
        {"mrclam": mrclam, "laser": laser, "network": network}[part](
            arguments.ortung, arguments.data, arguments.out, arguments.seeds)


if __name__ == "__main__":
    main()
