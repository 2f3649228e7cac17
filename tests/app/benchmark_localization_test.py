#!/usr/bin/env python3
"""benchmark_localization_test.py SCRIPT ORTUNG DATA  scripts/benchmark-localization.py makes its tables, and its faults are as
it says."""
import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import tempfile

script, ortung, data = map(pathlib.Path, sys.argv[1:])
if not (data / "mrpt_localization_demo").is_dir():
    print("benchmark_localization_test.py: Skipped\n\"%s\" is not here" % (data / "mrpt_localization_demo"))
    sys.exit(77)

sys.path.insert(0, str(script.parent))  # for evaluate.py
spec = importlib.util.spec_from_file_location("benchmark", script)
benchmark = importlib.util.module_from_spec(spec)
spec.loader.exec_module(benchmark)


def expect(condition, what):
    if not condition:
        sys.exit("failed: " + what)


# Moments of faults: within the log, each elsewhere, and none where the log is too short.
jobs = benchmark.fault_jobs("log", 300.0, ["readings=crowd@{window}"], 4)
times = [tuple(map(float, re.fullmatch(r"readings=crowd@([\d.]+)-([\d.]+)", a[-1]).groups())) for _, a in jobs]
expect(len(times) == 4 and len(set(times)) == 4, "four moments")
expect(all(abs(end - begin - 30) < 0.11 and 10 <= begin and end <= 290 for begin, end in times), "windows of 30 s: %s" % times)
expect([a[a.index("--seed") + 1] for _, a in jobs] == ["1", "2", "3", "4"], "seeds")
expect(benchmark.fault_jobs("log", 40.0, ["readings=crowd@{window}"], 4) == [], "too short")
whole = benchmark.fault_jobs("log", 9.0, ["odometry=none"], 4)
expect(len(whole) == 1 and "--runs" in whole[0][1], "faults of the whole run")

with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    result = subprocess.run([sys.executable, script, ortung, data, "--only", "tracking,kidnaps", "--cases", "1", "--logs",
                             "localization_demo", "--out", folder], capture_output=True, text=True)
    expect(result.returncode == 0, result.stderr)
    expect("| localization_demo | truth | 1 of 1 | 1 of 1 |" in result.stdout, result.stdout)
    expect("not run: localization_demo" in result.stdout, "a log that is too short to be cut is told")
    runs = json.loads((folder / "benchmark.json").read_text())["runs"]
    expect([run["start"] for run in runs] == ["truth", "global"], "the runs are kept")
    compared = subprocess.run([ortung, "compare", folder / "benchmark.json", folder / "benchmark.json"], capture_output=True,
                              text=True)
    expect(compared.stdout.startswith("2 pairs of runs\n"), compared.stdout + compared.stderr)

    base = folder / "localization_demo"
    other = pathlib.Path(benchmark.remove_walls(str(base)))
    before = (folder / "localization_demo.pgm").read_bytes()
    after = other.with_suffix(".pgm").read_bytes()
    expect(len(before) == len(after), "a picture of the same size")
    walls = sum(b < 90 for b in before)
    gone = sum(b < 90 <= a for b, a in zip(before, after))
    expect(0.1 * walls < gone < 0.3 * walls, "a fifth of the walls: %d of %d" % (gone, walls))
    expect(all(a == b or b < 90 for b, a in zip(before, after)), "nothing else changes")
