#!/usr/bin/env bash
# The main job, from an empty machine to pictures: installs, builds, learns what the sensors of a
# simulated robot read everywhere on a soccer field, drives it, localizes it from an unknown start,
# and writes a report. Where ../shared/data exists, does the same on a recording of a real robot.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-deps.sh demo
cmake --preset demo >/dev/null
# What is called below and the plugins of its robot (cmake/OrtungDemo.cmake); `cmake --build --preset demo` builds all else.
cmake --build --preset demo --target demo

ortung=build/demo/bin/ortung
out=out/demo
mkdir -p "$out"

step() { printf '\n== %s\n' "$1"; }

step "Learn: what would each sensor read at every pose of the field?"
"$ortung" learn --world maps/fields/f2000.toml --robot maps/robots/pioneer.toml --out "$out/f2000.ortung"

step "Localize: drive for 120 s, start unknown"
"$ortung" eval --source 'sim:maps/fields/f2000.toml?duration=120&seed=1' --robot maps/robots/pioneer.toml \
  --tables "$out/f2000.ortung" --start global --record "$out/f2000.rec" \
  --json "$out/f2000.json" --report "$out/f2000.html"

step "Look: where on the field would this scan be probable?"
"$ortung" show "$out/f2000.ortung" --robot maps/robots/pioneer.toml --feature 'LMS200/LRF/*' \
  --record "$out/f2000.rec" --at 20 --out "$out/f2000-scan.png"

run=../shared/data/utias_mrclam/ds6
if [[ -d $run ]]; then
  step "A real robot: import a recording with its landmarks, learn, localize"
  "$ortung" import mrclam "$run" --robot 2 --out "$out/mrclam.rec" \
    --world "$out/mrclam.toml" --robot-file "$out/mrclam-robot.toml" --force
  "$ortung" learn --world "$out/mrclam.toml" --robot "$out/mrclam-robot.toml" --out "$out/mrclam.ortung" --cell 0.05
  "$ortung" eval --source "record:$out/mrclam.rec" --robot "$out/mrclam-robot.toml" \
    --tables "$out/mrclam.ortung" --start global --json "$out/mrclam.json" --report "$out/mrclam.html"
else
  step "No ../shared/data here, so no recording of a real robot"
fi

step "Done. Reports and pictures:"
ls -1 "$out"/*.html "$out"/*.png
echo
echo "In a web browser, live: cmake --build --preset demo && $ortung demo"
