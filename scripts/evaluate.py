#!/usr/bin/env python3
"""Runs the evaluation of docs/results and prints its tables as Markdown.

  scripts/evaluate.py build/release/bin/ortung ../shared/data [--only sim,laser,...] [--seeds 3] [--out DIR] [--write docs/results]

For each log it imports, learns (once a map) and evaluates from an unknown and a known start. --write puts each table behind its mark
in the pages, <!-- table: HEADING -->, part by part, so that what fails later leaves what was there. All parts take some hours. Then
scripts/results_page.py makes docs/results.md of them.

Evaluations are sweeps in OUT/sweeps: run again, the script goes on where it was. They may be run elsewhere before: `ortung sweep run
OUT/sweeps/NAME.toml --dir OUT/sweeps/NAME --shard I/N` (docs/clusters.md).
"""
import argparse
import math
import os
import shutil
import statistics
import subprocess
import sys
import types
import typing

import ablations
import results_page
import sweeps

HERE = os.path.dirname(os.path.abspath(__file__))
MAPS = os.path.join(os.path.dirname(HERE), "maps")
LASER = {  # name: folder, options of the import
    "intel": ("carmen/intel", []),
    "aces": ("carmen/aces", []),
    "belgioioso": ("carmen/belgioioso", []),
    "freiburg-101": ("carmen/freiburg-101", []),
    "freiburg-079": ("carmen/freiburg-079", []),
    "fhw": ("carmen/fhw", []),
    "localization_demo": ("mrpt_localization_demo", []),
    "sena_telecom": ("mrpt_sena_telecom", []),
    "uwb_ro": ("mrpt_uwb_ro", []),
    "jarvis": ("crob_lab_jarvis/complex_path_fast/security",
               ["map={data}/crob_lab_jarvis/map_security_from_complex.yaml",
                "odom={data}/crob_lab_jarvis/complex_path_fast/odom.txt.xz"]),
}
HEAD = ("| start | seeds | converged | after [s] | median [m] | RMSE [m] | p95 [m] | heading RMSE [deg] | lost | "
        "NEES | samples | ms | RMSE at updates [m] |")
RULE = "|" + "---|" * 14


def run(arguments):
    """What a command prints; its trouble ends the script."""
    result = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit("%s\n%s" % (" ".join(map(str, arguments)), result.stderr))
    return result.stdout


def mean(values):
    values = [v for v in values if v is not None and not math.isnan(v)]
    return sum(values) / len(values) if values else float("nan")


def row(start, runs):
    """One row: means over the runs that converged."""
    good = [r for r in runs if r["converged_after_s"] is not None]
    m = lambda key: mean([r[key] for r in good])
    return "| %s | %d | %d | %.1f | %.3f | %.3f | %.3f | %.2f | %.3f | %.1f | %.0f | %.2f | %.3f |" % (
        start, len(runs), len(good), m("converged_after_s"), m("position_median_m"), m("position_rmse_m"),
        m("position_p95_m"), m("heading_rmse_deg"), m("lost_share"), m("nees_mean"), m("particles_mean"),
        m("update_ms_p50"), mean([r["at_corrections"]["position_rmse_m"] for r in good]))


class Case(typing.NamedTuple):
    """What is evaluated from some starts with some seeds."""
    name: str
    source: str
    robot: str
    tables: str


def evaluate(tools, name, cases, seeds, starts=("global",), extra=()):
    """Prints a row for each case and start."""
    command = ["eval", "--source", "{case.source}", "--robot", "{case.robot}", "--tables", "{case.tables}", "--start", "{start}", "--seed",
               "{seed}", *extra]
    found = tools.sweeps.groups(name, command, {"case": [one._asdict() for one in cases], "start": starts, "seed": sweeps.seeds(seeds)})
    for (case, start), runs in found.items():
        print("| %s %s" % (case, row(start, runs)), flush=True)


def of_log(base, name, part=""):
    """The case of an imported log with its own robot."""
    return Case(name, "record:" + base + ".rec" + part, base + "-robot.toml", base + ".ortung")


# Biases of a robot's camera are learned elsewhere: run and part, from which run and part, and what that says nothing of.
MRCLAM_LEARNED = (("ds6", "?from_s=440", "ds6", "?to_s=440", "mount"), ("ds6", "", "ds2", "", "mount,latency"),
                  ("ds1", "", "ds6", "", "mount"), ("ds2", "", "ds6", "", "mount"), ("ds3", "", "ds6", "", "mount"))


def import_mrclam(ortung, data, base, name, robot):
    """Record, world and robot file of one robot of a run; their names begin with `base`."""
    run([ortung, "import", "mrclam", os.path.join(data, "utias_mrclam", name), "--robot", str(robot), "--out", base + ".rec",
         "--world", base + ".toml", "--robot-file", base + "-robot.toml", "--force"])


def mrclam(tools, seeds):
    print("\n## Landmarks: MRCLAM\n\n| run, robot " + HEAD + "\n" + RULE, flush=True)
    cases = []
    missing = set()
    for name in ("ds6", "ds1", "ds2", "ds3"):
        tables = os.path.join(tools.out, name + ".ortung")
        for robot in range(1, 6):
            if not os.path.exists(os.path.join(tools.data, "utias_mrclam", name, "Robot%d_Odometry.dat.xz" % robot)):
                print("| %s, %d | no odometry in the data |" % (name, robot))
                missing.add((name, robot))
                continue
            base = os.path.join(tools.out, "%s-%d" % (name, robot))
            import_mrclam(tools.ortung, tools.data, base, name, robot)
            if robot == 1:
                run([tools.ortung, "learn", "--world", base + ".toml", "--robot", base + "-robot.toml", "--out", tables,
                     "--cell", "0.05"])
            cases.append(of_log(base, "%s, %d" % (name, robot))._replace(tables=tables))
    evaluate(tools, "mrclam", cases, seeds)
    mrclam_learned(tools, seeds, missing)


def mrclam_learned(tools, seeds, missing):
    """With biases of each camera that another run, or half of one, has told; of halves also without."""
    print("\n## Landmarks: MRCLAM with learned biases\n\n| run, robot, learned from " + HEAD + "\n" + RULE, flush=True)
    cases = []
    for name, part, other, other_part, fixed in MRCLAM_LEARNED:
        tables = os.path.join(tools.out, name + ".ortung")
        for robot in range(1, 6):
            if (name, robot) in missing or (other, robot) in missing:
                continue
            base = os.path.join(tools.out, "%s-%d" % (other, robot))
            learned = "%s-learned-for-%s.toml" % (base, name)
            run([tools.ortung, "calibrate", "noise", "record:" + base + ".rec" + other_part, "--robot", base + "-robot.toml", "--tables",
                 os.path.join(tools.out, other + ".ortung"), "--fixed", fixed, "--out", learned, "--force"])
            own = os.path.join(tools.out, "%s-%d" % (name, robot))
            case = Case("%s, %d, -" % (name + part, robot), "record:" + own + ".rec" + part, base + "-robot.toml", tables)
            if part:
                cases.append(case)
            cases.append(case._replace(name="%s, %d, %s" % (name + part, robot, other + other_part), robot=learned))
    evaluate(tools, "mrclam-learned", cases, seeds)


def lookalikes(tools, seeds):
    """Landmarks that nobody tells apart: reflectors alone and beside a laser, cylinders in scans."""
    print("\n## Landmarks without identity\n\n| log " + HEAD + "\n" + RULE, flush=True)
    folder = os.path.join(tools.data, "crob_lab_jarvis")
    base = import_beacons(tools.ortung, tools.out, "reflectors", "scanlog", os.path.join(folder, "complex_path_fast/security"),
                          ["%s=%s" % (key, os.path.join(folder, file)) for key, file in
                           (("map", "map_security_from_complex.yaml"), ("odom", "complex_path_fast/odom.txt.xz"),
                            ("reflectors", "complex_path_fast/reflectors.txt.xz"), ("reflector_map", "reflector_map.txt"))])
    head, odometry, scanner, reflectors = open(base + "-robot.toml").read().split("[[sensor]]")
    cases = []
    for name, sensors in (("reflectors", [reflectors]), ("laser", [scanner]), ("both", [scanner, reflectors])):
        with open(base + "-%s.toml" % name, "w") as robot:
            robot.write("[[sensor]]".join([head, odometry, *sensors]))
        cases.append(of_log(base, "jarvis, " + name)._replace(robot=base + "-%s.toml" % name))
    base = import_beacons(tools.ortung, tools.out, "lego", "lego", os.path.join(tools.data, "lego_brenner/robot4"))
    cases.append(of_log(base, "lego", "?from_s=27"))
    evaluate(tools, "lookalikes", cases, seeds)


def import_laser(ortung, data, out, name):
    """Record, world, robot file and tables of a log in `out`; returns what their names begin with."""
    folder, options = LASER[name]
    base = os.path.join(out, name)
    run([ortung, "import", "scanlog", os.path.join(data, folder), "--out", base + ".rec", "--world", base + ".toml",
         "--robot-file", base + "-robot.toml", "--force",
         *[word for o in options for word in ("--option", o.format(data=data))]])
    if not os.path.exists(base + ".ortung"):
        run([ortung, "learn", "--world", base + ".toml", "--robot", base + "-robot.toml", "--out", base + ".ortung"])
    return base


def fixed_robot(base):
    """MRPT's set has a fixed size, so ours is measured with that, too."""
    fixed = base + "-fixed.toml"
    with open(base + "-robot.toml") as robot, open(fixed, "w") as out_file:
        out_file.write(robot.read() + "\n[mcl]\nparticles = 10000\nmin_particles = 10000\n")
    return fixed


def laser(tools, seeds):
    print("\n## Laser\n\n| log " + HEAD + "\n" + RULE, flush=True)
    logs = []
    for name in LASER:
        base = import_laser(tools.ortung, tools.data, tools.out, name)
        fixed_robot(base)
        logs.append({"name": name, "base": base})
    command = ["eval", "--source", "record:{log.base}.rec", "--robot", "{log.base}-{set}.toml", "--tables", "{log.base}.ortung",
               "--start", "{start}", "--seed", "{seed}"]
    found = tools.sweeps.groups("laser", command, {"log": logs, "start": ["global", "truth"], "set": ["robot", "fixed"],
                                                   "seed": sweeps.seeds(seeds)})
    for (log, start, _), runs in found.items():
        print("| %s %s" % (log, row(start, runs)), flush=True)


# Beacon 1 of uwb_ro is wrong for minutes, 39 % of all; the others err by 0.1 m. Fitted to the first half of the log.
UWB_RO = """
[[sensor]]
plugin = "landmarks"
model = "uwb"
type = "landmarks"
features = "distances"
kind = "beacon"
identities = [%s]
pose = { x_m = 0.16, y_m = 0.0, z_m = 1.0 }
slant = true
max_range_m = 40.0
range_sigma_m = %s
outliers = %s
exponent = 0.5
"""


def import_beacons(ortung, out, name, kind, path, options=(), cell="0.1"):
    """Record, world, robot file and tables of a log in `out`; returns what their names begin with."""
    base = os.path.join(out, name)
    run([ortung, "import", kind, path, "--out", base + ".rec", "--world", base + ".toml", "--robot-file",
         base + "-robot.toml", "--force", *[word for o in options for word in ("--option", o)]])
    run([ortung, "learn", "--world", base + ".toml", "--robot", base + "-robot.toml", "--out", base + ".ortung",
         "--cell", cell, "--force"])
    return base


def import_uwb_ro(ortung, data, out):
    """Robots with the laser, the ranges and both, and tables of both; returns what their names begin with."""
    folder = os.path.join(data, "mrpt_uwb_ro")
    base = import_beacons(ortung, out, "uwb_ro_beacons", "rawlog",
                          os.path.join(folder, "raw/uwb_ro-localization_demo.rawlog"),
                          ["%s=%s" % (key, os.path.join(folder, file)) for key, file in
                           (("gt", "ref.txt"), ("map", "map.yaml"), ("beacons", "beacons.txt"))])
    head, odometry, scanner, _ = open(base + "-robot.toml").read().split("[[sensor]]")
    ranges = UWB_RO % ("1", 0.2, 0.4) + UWB_RO % ("2, 3", 0.12, 0.02)
    for name, sensors in (("laser", [scanner]), ("ranges", []), ("both", [scanner])):
        with open(base + "-%s.toml" % name, "w") as robot:
            robot.write("[[sensor]]".join([head, odometry, *sensors]) + (ranges if name != "laser" else ""))
    run([ortung, "learn", "--world", base + ".toml", "--robot", base + "-both.toml", "--out", base + ".ortung", "--force"])
    return base


def uwb_ro(tools, seeds):
    """Laser, ranges and both; then where the laser has a scan in ten."""
    base = import_uwb_ro(tools.ortung, tools.data, tools.out)
    for number, fault in enumerate(((), ("--fault", "laser/LRF/scan=drop:0.9"), ("--fault", "laser/LRF/scan=missing@30-90"))):
        cases = [of_log(base, "uwb_ro, %s %s" % (name, ", ".join(fault[1:])), "?from_s=180")._replace(robot=base + "-%s.toml" % name)
                 for name in ("laser", "ranges", "both") if not (fault and name == "ranges")]
        evaluate(tools, "uwb_ro-%d" % number, cases, seeds, extra=fault)


def beacons(tools, seeds):
    print("\n## Ranges and bearings of beacons\n\n| log " + HEAD + "\n" + RULE, flush=True)
    uwb_ro(tools, seeds)
    plaza = import_beacons(tools.ortung, tools.out, "plaza", "plaza", os.path.join(tools.data, "plaza"), cell="0.5")
    uwbpose = import_beacons(tools.ortung, tools.out, "uwbpose", "uwbpose", os.path.join(tools.data, "uwb_planar_pose"),
                             ["range_bias_m=0.19"])
    cases = [of_log(plaza, "plaza", "?from_s=970"), of_log(uwbpose, "uwbpose", "?from_s=65")]
    for x in (1.5, 3.0, 4.5):
        for y in (1.5, 3.0, 4.5):
            base = import_beacons(tools.ortung, tools.out, "roh-%.1f-%.1f" % (x, y), "roh",
                                  os.path.join(tools.data, "roh_bearings/(X%.1f,Y%.1f).csv" % (x, y)), cell="0.05")
            cases.append(of_log(base, "roh, %.1f m, %.1f m" % (x, y)))
    evaluate(tools, "beacons", cases, seeds)


class Setup(typing.NamedTuple):
    """A simulated robot on a field."""
    name: str
    field: str
    robot: str
    world: str
    tables: str


def setups(tools, pairs):
    """Robots on fields, with their tables."""
    made = []
    for robot, field in pairs:
        setup = Setup("%s, %s" % (robot, field), field, os.path.join(MAPS, "robots", robot + ".toml"),
                      os.path.join(MAPS, "fields", field + ".toml"), os.path.join(tools.out, robot + ".ortung"))
        run([tools.ortung, "learn", "--world", setup.world, "--robot", setup.robot, "--out", setup.tables, "--force"])
        made.append(setup)
    return made


# A laser alone can't tell the halves of the bare field apart (see the world's comment).
SETUPS = (("pioneer_lrf", "f2000_hall"), ("pioneer_posts", "f2000"), ("pioneer", "f2000"))
DRIVE = ["eval", "--source", "sim:{setup.world}?duration=60&seed={seed}", "--robot", "{setup.robot}", "--tables", "{setup.tables}",
         "--seed", "{seed}"]


def sim(tools, seeds):
    print("\n## Simulated soccer field, 60 s, a new drive for each seed\n\n| robot, field " + HEAD + "\n" + RULE, flush=True)
    found = tools.sweeps.groups("sim", DRIVE, {"setup": [one._asdict() for one in setups(tools, SETUPS)], "seed": sweeps.seeds(seeds)})
    for (setup,), runs in found.items():
        print("| %s %s" % (setup, row("global", runs)), flush=True)


def bound(tools, seeds):
    """Errors of simulated robots beside the Cramer-Rao bound, as medians over the drives."""
    print("\n## The bound\n\n| robot, field | drives | bound: median [m] | RMSE [m] | heading RMSE [deg] | error at updates: median [m] | "
          "RMSE [m] | ratio of medians | of RMSE |\n|" + "---|" * 9, flush=True)
    # Sixteen sonars take minutes to find a place.
    made = [{**one._asdict(), "start": "truth" if one.name.startswith("sonar") else "global"}
            for one in setups(tools, (*SETUPS, ("sonar_ring", "f2000_hall")))]
    command = [*DRIVE, "--start", "{setup.start}", "--bound", "{setup.world}"]
    for (setup,), runs in tools.sweeps.groups("bound", command, {"setup": made, "seed": sweeps.seeds(seeds)}).items():
        good = [r for r in runs if r["converged_after_s"] is not None]
        m = lambda key: statistics.median([r[key] for r in good])
        at = lambda key: statistics.median([r["at_corrections"][key] for r in good])
        print("| %s | %d of %d | %.4f | %.4f | %.3f | %.4f | %.4f | %.1f | %.1f |" % (
            setup, len(good), len(runs), m("bound_median_m"), m("bound_rmse_m"), m("bound_heading_rmse_deg"),
            at("position_median_m"), at("position_rmse_m"), m("ratio_median"), m("ratio_rmse")), flush=True)


def ablation(tools, _):
    ablations.simulated(tools)
    ablations.logged(tools)


# Where a fault of some seconds begins, in which the robot moves [s].
FAULT_FROM = {"jarvis": 20, "sena_telecom": 20, "intel": 600, "fhw": 200}
LATE_S = (0.5, 1, 2, 3)


def lost_shares(tools, name, pairs):
    """Share of the time lost of two runs from the truth, as text, by (log, fault). @param pairs (log, base, fault)"""
    cases = [{"name": "%s %s" % (log, fault), "base": base, "fault": fault} for log, base, fault in pairs]
    command = ["eval", "--source", "record:{case.base}.rec", "--robot", "{case.base}-robot.toml", "--tables", "{case.base}.ortung",
               "--start", "truth", "--seed", "{seed}", "--fault", "{case.fault}"]
    found = tools.sweeps.groups(name, command, {"case": cases, "seed": sweeps.seeds(2)})
    return {(log, fault): " / ".join("never converged" if r["lost_share"] is None else "%.3g" % round(r["lost_share"], 3)
                                     for r in found["%s %s" % (log, fault),]) for log, _, fault in pairs}


FAULTS = (("readings=crowd", 30), ("readings=frozen", 30), ("readings=missing", 30), ("odometry=slip", 4), ("odometry=reverse", 4),
          ("odometry=none", None), ("odometry=zero", None))
LATE_LOGS = ("intel", "belgioioso", "sena_telecom", "jarvis", "fhw", "freiburg-079", "aces")


def faults(tools, _):
    """Constructed faults at fixed times, and late stamps, seeds 1 and 2."""
    bases = {name: import_laser(tools.ortung, tools.data, tools.out, name) for name in dict.fromkeys((*FAULT_FROM, *LATE_LOGS))}
    text = lambda what, seconds, log: what + ("@%d-%d" % (FAULT_FROM[log], FAULT_FROM[log] + seconds) if seconds else "")
    found = lost_shares(tools, "constructed-faults", [(log, bases[log], text(*fault, log)) for fault in FAULTS for log in FAULT_FROM])
    print("\n## Constructed faults\n\n| fault | %s |\n|%s" % (" | ".join(FAULT_FROM), "---|" * (len(FAULT_FROM) + 1)), flush=True)
    for what, seconds in FAULTS:
        cells = [found[log, text(what, seconds, log)] for log in FAULT_FROM]
        print("| `%s`, %s | %s |" % (what, "%d s" % seconds if seconds else "all the time", " | ".join(cells)), flush=True)
    found = lost_shares(tools, "late", [(log, bases[log], "readings=late:%g" % late) for late in LATE_S for log in LATE_LOGS])
    print("\n## Late stamps\n\n| late by | %s |\n|%s" % (" | ".join(LATE_LOGS), "---|" * (len(LATE_LOGS) + 1)), flush=True)
    for late in LATE_S:
        print("| %g s | %s |" % (late, " | ".join(found[log, "readings=late:%g" % late] for log in LATE_LOGS)), flush=True)


def trust(tools, _):
    """Wake-ups, kidnaps, teleports and faults at other moments."""
    script = os.path.join(HERE, "benchmark-localization.py")
    common = [sys.executable, script, tools.ortung, tools.data, "--out", tools.out]
    print(run([*common, "--only", "wake-ups,kidnaps", "--cases", "20"]), end="")
    print(run([*common, "--only", "teleports", "--cases", "6", "--logs", "intel,belgioioso,jarvis,fhw"]), end="")
    print(run([*common, "--only", "faults", "--cases", "2", "--logs", "intel,belgioioso,jarvis,fhw,sena_telecom"]), end="", flush=True)


def mrpt(tools, _):
    """MRPT's pf-localization on the logs of `laser`."""
    if shutil.which("pf-localization") is None:
        print("\n## MRPT's pf-localization\n\nLeft out: pf-localization is not installed (Debian: mrpt-apps).")
        return
    rows = []
    for samples, seeds, longest in ((2000, 2, 600), (10000, 1, 900)):
        told = run([os.path.join(HERE, "compare-mrpt.sh"), tools.data, "--samples", str(samples), "--seeds", str(seeds), "--jobs", "1",
                    "--longest", str(longest), "--budget", "3600"])
        lines = [line for line in told.splitlines() if line.startswith("|")]
        rows += lines if not rows else lines[2:]
    print("\n## MRPT's pf-localization\n\n" + "\n".join(rows[:2] + sorted(rows[2:])))


def three_ways(tools, _):
    print("\n## One robot, three ways\n\n" + run([sys.executable, os.path.join(HERE, "three-ways.py"), tools.ortung]), end="", flush=True)


PARTS = {"sim": sim, "bound": bound, "ablations": ablation, "mrclam": mrclam, "beacons": beacons, "lookalikes": lookalikes, "laser": laser,
         "trust": trust,
         "faults": faults, "mrpt": mrpt, "three-ways": three_ways, "goalkeepers": results_page.goalkeepers}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung")
    parser.add_argument("data")
    parser.add_argument("--only", default=",".join(PARTS), help="of " + ", ".join(PARTS))
    parser.add_argument("--seeds", type=int, default=3, help="runs a row; the simulated ones get 20")
    parser.add_argument("--jobs", type=int, default=1, help="evaluations at a time; more of them take each other's time")
    parser.add_argument("--out", default="out/evaluate", help="folder of records, tables, sweeps and their results")
    parser.add_argument("--write", metavar="FILE", help="put the tables into this page, or the pages of this folder, in place of those that are there")
    arguments = parser.parse_args()
    parts = arguments.only.split(",")
    if unknown := [p for p in parts if p not in PARTS]:
        parser.error("--only is %s, expected some of %s" % (",".join(unknown), ", ".join(PARTS)))
    out = os.path.abspath(arguments.out)
    os.makedirs(out, exist_ok=True)
    tools = types.SimpleNamespace(ortung=os.path.abspath(arguments.ortung), data=os.path.abspath(arguments.data), out=out,
                                  maps=MAPS, run=run, mean=mean, import_uwb_ro=import_uwb_ro,
                                  sweeps=sweeps.Sweeps(arguments.ortung, out, arguments.jobs))
    for part in parts:
        seeds = 20 if part in ("sim", "bound") else arguments.seeds
        with results_page.written(arguments.write):
            PARTS[part](tools, seeds)


if __name__ == "__main__":
    main()
