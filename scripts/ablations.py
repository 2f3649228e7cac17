"""What each sensor, learned models and more samples are worth: the ablations of docs/results/simulated.md, a part of evaluate.py.

The same recorded drives for all rows of a table; models are learned from other drives, or another part of the log.
"""
import os
import re

import sweeps

DRIVES = 10  # simulated, of 60 s
TRAINING = (101, 102)  # seeds of drives of 120 s from which models are learned
SAMPLES = (500, 2000, 10000)
MODEL_KEYS = "sigma_m|sigma_per_m|range_sigma_m|range_sigma_per_m|bearing_sigma_deg|outliers|exponent"
HEAD = ("| sensors | models | samples | converged | never lost | after [s] | median [m] | RMSE [m] | heading RMSE [deg] | "
        "lost | NEES | ms |\n" + "|" + "---|" * 12)


def with_defaults(text):
    """A robot file without its sensor models and motion: what plugins take then."""
    text = re.sub(r"(?m)^(%s) *=.*\n" % MODEL_KEYS, "", text)
    return re.sub(r"(?ms)^\[motion\]\n.*?(?=^\[|\Z)", "", text)


def sensors_of(text, plugins):
    """A robot file with odometry and these sensors alone."""
    parts = re.split(r"(?m)^(?=\[)", text)
    kept = tuple('\nplugin = "%s"' % p for p in (*plugins, "odometry"))
    return "".join(p for p in parts if not p.startswith("[[sensor]]") or any(k in p for k in kept))


def row(tools, name, models, samples, runs):
    """Means over the runs that converged; those that did not are counted."""
    good = [r for r in runs if r["converged_after_s"] is not None]
    m = lambda key: tools.mean([r[key] for r in good])
    nees = m("nees_mean")  # millions of a pose that is sure of the wrong half
    return "| %s | %s | %s | %d of %d | %d | %.1f | %.3f | %.3f | %.2f | %.3f | %s | %.2f |" % (
        name, models, samples, len(good), len(runs), sum(r["lost_share"] == 0 for r in good), m("converged_after_s"),
        m("position_median_m"), m("position_rmse_m"), m("heading_rmse_deg"), m("lost_share"), ("%.1f" if nees < 1e3 else "%.0e") % nees, m("update_ms_p50"))


def table(tools, title, base, robots, tables, source, seeds):
    """A row for each (sensors, models, text of the robot file) and number of samples. @param source with {seed}, if drives differ"""
    files = []
    for name, models, text in robots:
        files.append({"name": "%s | %s" % (name, models), "file": "%s-%s-%s.toml" % (base, re.sub(r"\W", "_", name), re.sub(r"\W", "_", models))})
        with open(files[-1]["file"], "w") as out:
            out.write(re.sub(r"(?ms)^\[mcl\]\n.*?(?=^\[|\Z)", "", text))
    command = ["eval", "--source", source, "--robot", "{robot.file}", "--tables", tables, "--set", "mcl.particles={samples}", "--set",
               "mcl.min_particles={samples}", "--seed", "{seed}"]
    found = tools.sweeps.groups(os.path.basename(base), command, {"robot": files, "samples": SAMPLES, "seed": sweeps.seeds(seeds)})
    rows = [row(tools, *robot.split(" | "), samples, runs) for (robot, samples), runs in found.items()]
    print("\n## %s\n\n%s\n%s" % (title, HEAD, "\n".join(rows)), flush=True)


def learned(tools, robot, tables, logs, base):
    """The robot file with noise and motion learned from logs with ground truth."""
    tools.run([tools.ortung, "calibrate", "noise", *logs, "--robot", robot, "--tables", tables, "--fixed", "mount,latency",
               "--out", base + "-noise.toml", "--force"])
    tools.run([tools.ortung, "learn-motion", *logs, "--robot", robot, "--out", base + "-motion.toml", "--force"])
    text = re.sub(r"(?ms)^\[motion\]\n.*?(?=^\[|\Z)", "", open(base + "-noise.toml").read())
    return text + "\n" + open(base + "-motion.toml").read()


def simulated(tools):
    """Laser, landmarks and both on the bare F2000 field, whose halves look alike to a laser."""
    base = os.path.join(tools.out, "ablation")
    robot = os.path.join(tools.maps, "robots", "pioneer.toml")
    world = os.path.join(tools.maps, "fields", "f2000.toml")
    tools.run([tools.ortung, "learn", "--world", world, "--robot", robot, "--out", base + ".ortung", "--force"])
    for seed, seconds in [(s, 60) for s in range(1, DRIVES + 1)] + [(s, 120) for s in TRAINING]:
        tools.run([tools.ortung, "import", "sim", world, "--with-robot", robot, "--option", "duration=%d" % seconds, "--option",
                   "seed=%d" % seed, "--out", "%s-%d.rec" % (base, seed), "--force"])
    defaults = with_defaults(open(robot).read())
    with open(base + "-default.toml", "w") as out:
        out.write(defaults)
    models = (("default", defaults), ("learned", learned(tools, base + "-default.toml", base + ".ortung",
                                                         ["%s-%d.rec" % (base, s) for s in TRAINING], base)))
    robots = [(name, which, sensors_of(text, plugins)) for name, plugins in
              (("laser", ["lrf"]), ("landmarks", ["landmarks"]), ("both", ["lrf", "landmarks"])) for which, text in models]
    table(tools, "Ablations: simulated robot", base, robots, base + ".ortung", "record:%s-{seed}.rec" % base, DRIVES)


def logged(tools):
    """Laser, ranges of beacons and both in uwb_ro: learned from its first half, shown on the second."""
    base = tools.import_uwb_ro(tools.ortung, tools.data, tools.out)
    robot = open(base + "-both.toml").read()
    defaults = with_defaults(robot)
    with open(base + "-default.toml", "w") as out:
        out.write(defaults)
    models = (("default", defaults), ("learned", learned(tools, base + "-default.toml", base + ".ortung",
                                                         ["record:%s.rec?to_s=180" % base], base)))
    robots = [(name, which, sensors_of(text, plugins)) for name, plugins in
              (("laser", ["lrf"]), ("ranges", ["landmarks"]), ("both", ["lrf", "landmarks"])) for which, text in models]
    table(tools, "Ablations: uwb_ro", base + "-ablation", robots, base + ".ortung", "record:%s.rec?from_s=180" % base, 3)
