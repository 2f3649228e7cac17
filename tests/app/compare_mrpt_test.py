#!/usr/bin/env python3
"""compare_mrpt_test.py FOLDER  scripts/compare-mrpt.py of that folder reads what MRPT's programs print, and its figures stand
beside ours in scripts/benchmark-localization.py. MRPT's programs are played by scripts."""
import gzip
import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile

scripts = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(scripts))  # for evaluate.py


def expect(condition, what):
    if not condition:
        sys.exit("failed: %s" % what)


# On a line along x at 0.5 m/s, a scan each 0.5 s; the program is 3 m off for 2 s, then 0.1 m, and at last 2 m for 1 s.
TRUTH = [(0.5 * i, 0.25 * i, 0.0, 0.0) for i in range(40)]
OFF = [3.0] * 4 + [0.1] * 34 + [2.0] * 2
PROGRAM = """#!/usr/bin/env python3
import pathlib, sys
config = pathlib.Path(sys.argv[1]).read_text()
if "particles_count=7\\n" in config:
    sys.exit("no room for so few")
known = "init_PDF_mode=1" in config
for x, off in zip(%r, %r):
    print("Done in 1500us, ESS: 0.5" if known else "Done in 2.5ms, ESS: 0.5")
    print("PDF estimation: (%%f,%%f,%%fdeg)" %% (x + (0 if known else off), 0, 0))
""" % ([x for _, x, _, _ in TRUTH], OFF)

with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    log = folder / "data/carmen/intel"
    log.mkdir(parents=True)
    (log / "gt.txt").write_text("# t x y theta\n" + "".join("%f %f %f %f\n" % row for row in TRUTH))
    (log / "scans.txt").write_text("# k*0.01 rad\n" + "".join("%f %f %f %f 3 1 2 3\n" % row for row in TRUTH))
    (log / "map.pgm.gz").write_bytes(gzip.compress(b"P5\n1 1\n255\n\xfe"))
    (log / "map.yaml").write_text("image: map.pgm\nresolution: 0.05\n")
    programs = folder / "programs"
    programs.mkdir()
    for name, text in (("pf-localization", PROGRAM), ("ros-map-yaml2mrpt", "#!/bin/sh\n: > map.gridmap.gz\n"),
                       ("converter", "#!/bin/sh\ncat > $1\n")):
        (programs / name).write_text(text)
        (programs / name).chmod(0o755)
    environment = {**os.environ, "PATH": "%s:%s" % (programs, os.environ["PATH"])}

    def compare(*arguments):
        return subprocess.run([sys.executable, scripts / "compare-mrpt.py", folder / "data", "--converter", programs / "converter",
                               *arguments], env=environment, capture_output=True, text=True)

    result = compare("--logs", "intel,fhw", "--seeds", "2", "--samples", "100", "7", "--json", str(folder / "mrpt.json"))
    expect(result.returncode == 0, result.stderr)
    lines = result.stdout.splitlines()
    # Of the 36 moments after convergence two are off by 2 m: RMSE is the root of (34 0.1^2 + 2 2^2) / 36.
    expect("| intel | unknown | 100 | 2/2 | 2.0 | 0.100 | 0.481 | 5.6% | 2.5 |" in lines, result.stdout)
    expect("| intel | known | 100 | 2/2 | 0.0 | 0.000 | 0.000 | 0.0% | 1.5 |" in lines, result.stdout)
    expect("| intel | known | 7 | - | - | - | - | - | - |" in lines, result.stdout)
    expect("- intel, known start, 7 samples: no room for so few (2 times)" in lines, result.stdout)
    expect("| fhw | known | 100 | - | - | - | - | - | - |" in lines, "a log that is not there is a dash: " + result.stdout)
    expect(any(line.startswith("- fhw, known start, 100 samples: can't be brought") for line in lines), result.stdout)

    refused = compare("--logs", "nowhere")
    expect(refused.returncode == 2 and "--logs is nowhere, expected some of intel," in refused.stderr, refused.stderr)

    spec = importlib.util.spec_from_file_location("benchmark", scripts / "benchmark-localization.py")
    benchmark = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(benchmark)
    ours = {"source": "record:out/intel.rec", "start": "global", "faults": [], "converged_after_s": 0.5, "update_ms_p50": 0.25,
            "at_corrections": {"lost_share": 0.0, "position_median_m": 0.04, "position_rmse_m": 0.06}}
    others = [{**ours, "faults": ["odometry=zero"]}, {**ours, "case": {}}, {**ours, "start": "truth"}]
    never = {**ours, "converged_after_s": None, "update_ms_p50": 0.75,
             "at_corrections": dict.fromkeys(ours["at_corrections"])}
    rows, reasons = benchmark.beside_rows([ours, never, *others], json.loads((folder / "mrpt.json").read_text()))
    of = {tuple(row[:3]): row[3:] for row in rows}
    expect(of["intel", "global", "100"] ==
           ["1 of 2", "2 of 2", "0.0000", "0.0556", "0.040", "0.100", "0.060", "0.481", "0.50", "2.5"], of)
    expect(of["intel", "truth", "7"] == ["1 of 1", "-", "0.0000", "-", "0.040", "-", "0.060", "-", "0.25", "-"], of)
    expect(of["fhw", "truth", "100"] == ["-"] * 10, of)
    expect("intel, start truth, 7 samples: MRPT not run: no room for so few" in reasons, reasons)
