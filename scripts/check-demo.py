#!/usr/bin/env python3
"""check-demo.py [FOLDER]  whether what scripts/demo.sh left there (out/demo) is what it promises: reports, a picture, and
a robot that was found to 5 cm."""
import json
import pathlib
import sys

NEAR = 0.05  # [m], median error of the simulated robot


def problems(folder):
    def bytes_of(name):
        file = folder / name
        return file.read_bytes() if file.is_file() else b""

    for name in ("f2000-scan.png",):
        if not bytes_of(name).startswith(b"\x89PNG\r\n\x1a\n"):
            yield f"{name}: is no PNG file"
    runs = ["f2000"] + (["mrclam"] if (folder / "mrclam.rec").exists() else [])
    for run in runs:
        page = bytes_of(f"{run}.html")
        if b"<svg" not in page or not page.rstrip().endswith(b"</html>"):
            yield f"{run}.html: is no whole page with a map"
        try:
            figures = json.loads(bytes_of(f"{run}.json"))
        except ValueError as error:
            yield f"{run}.json: {error}"
            continue
        error = figures.get("position_median_m")
        if not isinstance(error, (int, float)):
            yield f"{run}.json: has no median error"
        elif run == "f2000" and not 0 < error < NEAR:
            yield f"{run}.json: the median error is {error} m, expected less than {NEAR} m"
        elif not 0 < error < 0.5:
            yield f"{run}.json: the median error is {error} m: the robot is lost"
        else:
            print(f"{run}: median error {100 * error:.1f} cm")


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/demo")
    found = list(problems(folder))
    for problem in found:
        print(f"check-demo: {folder}/{problem}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
