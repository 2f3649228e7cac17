#!/usr/bin/env python3
"""One robot, three ways: the same robot file and MCL on the simulator, on emulated devices through the real drivers,
and on the record of these.

  scripts/three-ways.py ORTUNG [--seeds 5] [--seconds 60] [--check]

Prints a table as docs/results/three-ways.md has it. --check: ends with 1 if the poses of device and record differ at all, or the
errors on the devices are not those of the simulator within the noise.
"""
import argparse
import json
import pathlib
import signal
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TRACKER = """
[[sensor]]
plugin = "ground_truth"
device = { plugin = "lines", port = "/dev/tracker" }
"""


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    return done


def figures(ortung, source, common, folder):
    out = folder / "figures.json"
    run(ortung, "eval", "--source", source, *common, "--json", out, "--force")
    return json.loads(out.read_text())


def on_devices(ortung, args, robot, world, tables, seed, folder):
    """Poses and record of a run on emulated devices."""
    record, poses = folder / f"devices{seed}.rec", folder / f"poses{seed}.txt"
    emulator = subprocess.Popen(
        [ortung, "emulate", "--robot", robot, "--world", world, "--dev", folder / "dev", "--seed", str(seed), "--wait",
         "--clock-drift-ppm", "50"], stdout=subprocess.PIPE, text=True)
    try:
        for _ in range(3):
            emulator.stdout.readline()  # a device each
        run(ortung, "robot", robot, "--dev", folder / "dev", "--tables", tables, "--record", record, "--out", poses,
            "--duration", args.seconds + 12, "--force")  # a SICK takes seconds to be found and set up
    finally:
        emulator.send_signal(signal.SIGTERM)
        emulator.wait()
    return record, poses


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("ortung")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--cell", default="0.1")
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    bad = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        world = ROOT / "maps" / "fields" / "arena.toml"
        robot = folder / "robot.toml"
        robot.write_text((ROOT / "maps" / "robots" / "laboratory.toml").read_text() + TRACKER)
        tables = folder / "tables.ortung"
        run(args.ortung, "learn", "--world", world, "--robot", robot, "--cell", args.cell, "--out", tables)
        common = ("--robot", robot, "--tables", tables)
        print("| seed | simulator: error p50, p95, most [m] | devices: the same | record: the same | poses of devices and record "
              "that differ |\n|---|---|---|---|---|")
        for seed in range(1, args.seeds + 1):
            simulated = figures(args.ortung, f"sim:{world}?duration={args.seconds}&seed={seed}", common, folder)
            record, poses = on_devices(args.ortung, args, robot, world, tables, seed, folder)
            live = poses.read_text().splitlines()
            again = folder / "again.txt"
            run(args.ortung, "localize", "--source", f"record:{record}", *common, "--out", again, "--force")
            replayed = again.read_text().splitlines()
            differing = abs(len(live) - len(replayed)) + sum(a != b for a, b in zip(live, replayed))
            recorded = figures(args.ortung, f"record:{record}", common, folder)

            def text(one):
                return "{position_median_m:.3f}, {position_p95_m:.3f}, {position_max_m:.3f}".format(**one)

            same = text(recorded) if differing == 0 else "(not the same poses)"
            print(f"| {seed} | {text(simulated)} | {same} | {text(recorded)} | {differing} of {len(live) - 1} |", flush=True)
            # Twice the simulator's, and a cell's share, is what other noise on the same way gives.
            within = recorded["position_p95_m"] <= 2.0 * simulated["position_p95_m"] + 0.02
            bad += differing != 0 or len(live) < 10 or not within
    sys.exit(1 if args.check and bad else 0)


if __name__ == "__main__":
    main()
