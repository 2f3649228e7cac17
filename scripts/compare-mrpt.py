#!/usr/bin/env python3
"""MRPT's pf-localization on real laser logs: how often, how soon and how well it localizes.

Every run starts from an unknown pose (uniform over the free cells of the map) or from a known one
(the reference's first pose, within about 0.2 m and 6 degrees), with a fixed number of samples, the
likelihood field (Thrun) and the rule of `ortung eval`: converged once the error stays below 0.5 m
and 15 degrees for 5 s; errors are those after that; lost where they exceed 1 m.
"""
import argparse
import concurrent.futures
import dataclasses
import gzip
import json
import lzma
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

from evaluate import LASER

CONVERGED_M, CONVERGED_RAD, CONVERGED_S, LOST_M = 0.5, math.radians(15), 5.0, 1.0
SCAN_PERIOD_S = 1.0  # of a log whose stamps do not tell its scans apart
KNOWN_HALF_WIDTH_M, KNOWN_HALF_WIDTH_DEG = 0.35, 10.0  # uniform: sigma 0.2 m, 5.8 degrees
GRACE_S = 60  # that a run may take beyond the budget

CONFIG = """\
[KLD_options]
KLD_binSize_PHI_deg=10
KLD_binSize_XY=0.10
KLD_delta=0.01
KLD_epsilon=0.01
KLD_maxSampleSize={samples}
KLD_minSampleSize={samples}
KLD_minSamplesPerBin=0
[PF_options]
PF_algorithm=0
resamplingMethod=3
adaptiveSampleSize=0
BETA=0.5
sampleSize=1
[DummyOdometryParams]
minStdXY=0.1
minStdPHI=2.0
[LocalizationExperiment]
use_3D_poses=false
map_file={map}
rawlog_file={rawlog}
logOutput_dir={output}
3DSceneFrequency=-1
experimentRepetitions=1
particles_count={samples}
{start}
SHOW_PROGRESS_3D_REAL_TIME=false
[MetricMap]
occupancyGrid_count=1
gasGrid_count=0
landmarksMap_count=0
pointsMap_count=0
beaconMap_count=0
likelihoodMapSelection=-1
[MetricMap_occupancyGrid_00_creationOpts]
resolution=0.05
[MetricMap_occupancyGrid_00_insertOpts]
mapAltitude=0
useMapAltitude=0
maxDistanceInsertion=15
maxOccupancyUpdateCertainty=0.55
considerInvalidRangesAsFreeSpace=1
[MetricMap_occupancyGrid_00_likelihoodOpts]
likelihoodMethod=4
LF_decimation={decimation}
LF_stdHit=0.20
LF_maxCorrsDistance=0.30
LF_zHit=0.95
LF_zRandom=0.05
LF_maxRange=80
LF_alternateAverageMethod=0
"""


@dataclasses.dataclass
class Log:
    name: str
    map: pathlib.Path
    rawlog: pathlib.Path
    steps: list  # of the program: (t [s], x [m], y [m], theta [rad]), None where not known
    beams: int


@dataclasses.dataclass
class Result:
    converged_after: float | None  # [s]; None: never
    median: float = math.nan  # [m]
    rmse: float = math.nan  # [m]
    lost: float = math.nan
    update_ms: float = math.nan


def read_bytes(folder, name):
    """The file `name`, which may lie there compressed."""
    for suffix, unpack in (("", lambda b: b), (".xz", lzma.decompress), (".gz", gzip.decompress)):
        path = folder / (name + suffix)
        if path.exists():
            return unpack(path.read_bytes())
    raise FileNotFoundError(f"{folder}: has no {name}, plain, .xz or .gz")


def rows(text):
    return [[float(w) for w in line.split()] for line in text.decode().splitlines()
            if line and not line.startswith("#")]


def read_truth(folder):
    name = "ref.txt" if (folder / "ref.txt").exists() else "gt.txt"
    truth = [row[:4] for row in rows(read_bytes(folder, name))]
    if len(truth) > 1 and len({row[0] for row in truth}) < len(truth) / 2:
        for i, row in enumerate(truth):
            row[0] = i * SCAN_PERIOD_S
    return truth


def prepare_scans(name, folder, world, work, converter):
    """A log of scans.txt and gt.txt on the map `world`."""
    work.mkdir()
    scans = read_bytes(folder, "scans.txt")
    rawlog = work / "log.rawlog"
    subprocess.run([converter, rawlog], input=scans, check=True)
    settings = world.read_text()
    image = re.search(r"^image: *(\S+)", settings, re.M)[1]
    (work / image).write_bytes(read_bytes(world.parent, image))
    (work / "map.yaml").write_text(settings)
    subprocess.run(["ros-map-yaml2mrpt", "-w", "-i", work / "map.yaml"], check=True, cwd=work,
                   stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
    # A step of the program is a scan of the log. (Stamps would not do: some logs lost theirs.)
    first = next(line for line in scans.decode().splitlines() if not line.startswith("#"))
    return Log(name, next(work.glob("*.gridmap.gz")), rawlog, read_truth(folder), int(first.split()[4]))


def prepare_mrpt(name, folder, converter):
    raw = folder / "raw"
    maps = sorted(raw.glob("*.simplemap.gz")) + sorted(raw.glob("*.gridmap.gz"))
    rawlogs = sorted(raw.glob("*.rawlog"))
    if not maps or not rawlogs:
        raise FileNotFoundError(f"{raw}: has no map (.simplemap.gz, .gridmap.gz) or no .rawlog")
    stamps = subprocess.run([converter, "--stamps", rawlogs[0]], check=True,
                            stdout=subprocess.PIPE).stdout.decode().split()
    truth = {f"{row[0]:.6f}": row for row in read_truth(folder)}
    return Log(name, maps[0], rawlogs[0], [truth.get(stamp) for stamp in stamps], 361)


def prepare(name, data, work, converter):
    """The log of that name among those of evaluate.py."""
    folder, options = LASER[name]
    folder = (data / folder).resolve()
    if not folder.is_dir():
        raise FileNotFoundError(f"{folder}: is not there")
    if (folder / "raw").is_dir():
        return prepare_mrpt(name, folder, converter)
    world = next((o.removeprefix("map=") for o in options if o.startswith("map=")), None)
    world = pathlib.Path(world.format(data=data)).resolve() if world else folder / "map.yaml"
    return prepare_scans(name, folder, world, work / name, converter)


def start_of(log, known):
    if not known:
        return "init_PDF_mode=0\n" + "\n".join(
            f"init_PDF_{end}_{axis}={sign}1000" for end, sign in (("min", "-"), ("max", ""))
            for axis in "xy")
    _, x, y, theta = next(step for step in log.steps if step is not None)
    yaw = math.degrees(theta)
    return (f"init_PDF_mode=1\n"
            f"init_PDF_min_x={x - KNOWN_HALF_WIDTH_M}\ninit_PDF_max_x={x + KNOWN_HALF_WIDTH_M}\n"
            f"init_PDF_min_y={y - KNOWN_HALF_WIDTH_M}\ninit_PDF_max_y={y + KNOWN_HALF_WIDTH_M}\n"
            f"init_PDF_min_yaw_deg={yaw - KNOWN_HALF_WIDTH_DEG}\n"
            f"init_PDF_max_yaw_deg={yaw + KNOWN_HALF_WIDTH_DEG}")


ESTIMATE = re.compile(r"PDF estimation: \(([-\d.e+]+),([-\d.e+]+),([-\d.e+]+)deg\)")
DONE = re.compile(r"Done in ([\d.]+)(ms|us|s)?, ESS")
MILLISECONDS = {"s": 1000.0, "ms": 1.0, "us": 0.001, "": 1.0}


def localize(log, known, samples, beams, timeout):
    """Runs the program once; returns its poses, one a step, and its times [ms]."""
    with tempfile.TemporaryDirectory() as folder:
        config = pathlib.Path(folder) / "run.ini"
        config.write_text(CONFIG.format(
            samples=samples, map=log.map, rawlog=log.rawlog, output=pathlib.Path(folder) / "out",
            start=start_of(log, known), decimation=max(1, log.beams // beams)))
        run = subprocess.run(["pf-localization", config], stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=folder,
                             timeout=timeout)
    text = run.stdout.decode(errors="replace")
    poses = [(float(x), float(y), math.radians(float(d))) for x, y, d in ESTIMATE.findall(text)]
    if run.returncode != 0 or not poses:
        raise RuntimeError(f"{log.name}: pf-localization failed:\n{text[-2000:]}")
    return poses, [float(value) * MILLISECONDS[unit] for value, unit in DONE.findall(text)]


def errors_of(log, poses):
    if len(poses) != len(log.steps):
        raise RuntimeError(f"{log.name}: found {len(poses)} steps, expected {len(log.steps)}")
    first = next(step for step in log.steps if step is not None)[0]
    for step, (px, py, ptheta) in zip(log.steps, poses):
        if step is None:
            continue
        t, x, y, theta = step
        turn = math.remainder(ptheta - theta, 2 * math.pi)
        yield t - first, math.hypot(px - x, py - y), abs(turn)


def evaluate(log, poses, update_ms):
    errors = list(errors_of(log, poses))
    since = None
    for i, (t, position, heading) in enumerate(errors):
        if position >= CONVERGED_M or heading >= CONVERGED_RAD:
            since = None
        elif since is None:
            since = i
        if since is not None and t - errors[since][0] >= CONVERGED_S:
            break
    else:
        since = None
    ms = statistics.median(update_ms)
    if since is None:
        return Result(None, update_ms=ms)
    after = [position for _, position, _ in errors[since:]]
    return Result(errors[since][0], statistics.median(after),
                  math.sqrt(sum(e * e for e in after) / len(after)),
                  sum(e > LOST_M for e in after) / len(after), ms)


KINDS = ((False, "unknown"), (True, "known"))


def print_table(names, runs_of, reasons, sample_counts):
    """One row for each log, start and number of samples; what could not be done is a dash, with the reason below."""
    def cell(values, form):
        return form.format(statistics.median(values)) if values else "-"
    print("| log | start | samples | converged | after [s] | median [m] | RMSE [m] | lost | ms/update |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for key in ((n, k, s) for n in names for k, _ in KINDS for s in sample_counts):
        runs = runs_of.get(key, [])
        good = [r for r in runs if r.converged_after is not None]
        lost = f"{statistics.mean(r.lost for r in good):.1%}" if good else "-"
        print(f"| {key[0]} | {dict(KINDS)[key[1]]} | {key[2]} | {f'{len(good)}/{len(runs)}' if runs else '-'} "
              f"| {cell([r.converged_after for r in good], '{:.1f}')} | {cell([r.median for r in good], '{:.3f}')} "
              f"| {cell([r.rmse for r in good], '{:.3f}')} | {lost} | {cell([r.update_ms for r in runs], '{:.1f}')} |")
    print()
    for (name, known, samples), texts in reasons.items():
        for text in dict.fromkeys(texts):
            print(f"- {name}, {dict(KINDS)[known]} start, {samples} samples: {text} ({texts.count(text)} times)")


def write_json(file, runs_of, reasons):
    """All runs, for scripts/benchmark-localization.py."""
    rows = [{"log": name, "start": "truth" if known else "global", "samples": samples,
             "runs": [dataclasses.asdict(run) for run in runs_of.get((name, known, samples), [])],
             "not_run": reasons.get((name, known, samples), [])}
            for name, known, samples in dict.fromkeys([*runs_of, *reasons])]
    file.write_text(json.dumps([{**row, "runs": [{k: None if v != v else v for k, v in run.items()} for run in row["runs"]]}
                                for row in rows], indent=1) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", type=pathlib.Path, help="folder that holds mrpt_*, carmen/* and crob_lab_jarvis")
    parser.add_argument("--converter", required=True, help="path of scanlog2rawlog")
    parser.add_argument("--seeds", type=int, default=5, help="runs of each kind; the program seeds itself by the clock")
    parser.add_argument("--budget", type=float, default=780, help="no run starts after this time [s]")
    parser.add_argument("--longest", type=float, default=240, help="a run is stopped after this time [s]")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time")
    parser.add_argument("--samples", type=int, nargs="+", default=[10000, 2000])
    parser.add_argument("--beams", type=int, default=36,
                        help="of a scan that are used; MRPT's own default is every 5th of 180")
    parser.add_argument("--logs", default=",".join(LASER), help="of " + ", ".join(LASER))
    parser.add_argument("--json", type=pathlib.Path, help="write all runs into this file, too")
    options = parser.parse_args()
    names = options.logs.split(",")
    if unknown := [name for name in names if name not in LASER]:
        parser.error(f"--logs is {','.join(unknown)}, expected some of {', '.join(LASER)}")
    for program in ("pf-localization", "ros-map-yaml2mrpt"):
        if shutil.which(program) is None:
            sys.exit(f"compare-mrpt: {program} is not installed (Debian: mrpt-apps)")
    began = time.monotonic()
    runs_of = {}
    reasons = {}

    with tempfile.TemporaryDirectory() as work:
        logs = {}
        for name in names:
            try:
                logs[name] = prepare(name, options.data, pathlib.Path(work), options.converter)
            except (OSError, subprocess.CalledProcessError, StopIteration) as error:
                for key in ((name, k, s) for k, _ in KINDS for s in options.samples):
                    reasons[key] = [f"can't be brought to MRPT's format: {error}"]

        def run(job):
            """A result, or text that says why there is none."""
            name, known, samples = job
            spent = time.monotonic() - began
            if spent > options.budget:
                return f"not begun within {options.budget:g} s (--budget)"
            timeout = min(options.longest, options.budget + GRACE_S - spent)
            try:
                poses, update_ms = localize(logs[name], known, samples, options.beams, timeout)
                return evaluate(logs[name], poses, update_ms)
            except subprocess.TimeoutExpired:
                return f"stopped after {timeout:.0f} s"
            except RuntimeError as error:
                return " ".join(str(error).splitlines()[-1:])

        jobs = [(name, known, samples) for _ in range(options.seeds) for name in logs
                for known, _ in KINDS for samples in options.samples]
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for job, result in zip(jobs, pool.map(run, jobs)):
                (reasons if isinstance(result, str) else runs_of).setdefault(job, []).append(result)
                if options.json:  # what is there already, should somebody stop this
                    write_json(options.json, runs_of, reasons)
    done = sum(len(r) for r in runs_of.values())
    print(f"{done} of {len(jobs)} runs in {time.monotonic() - began:.0f} s", file=sys.stderr)
    print_table(names, runs_of, reasons, options.samples)


if __name__ == "__main__":
    main()
