#!/bin/sh
# localize_loads.sh PROGRAM MAPS  what a robot's computer runs, with a scanner and its plugins, opens none of the large libraries.
set -e
program=$1
maps=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat > robot.toml <<'END'
[robot]
name = "scanner"
radius_m = 0.25
[[sensor]]
plugin = "odometry"
period_s = 0.05
[[sensor]]
plugin = "lrf"
model = "LMS200"
type = "LRF"
feature = "scan"
period_s = 0.1
beams = 60
fov_deg = 180
max_range_m = 8.0
sigma_m = 0.05
END
"$program" learn --world "$maps/fields/arena.toml" --robot robot.toml --out tables.ortung --cell 0.25
"$program" import sim "$maps/fields/arena.toml" --with-robot robot.toml --option duration=3 --out run.rec
LD_DEBUG=files LD_DEBUG_OUTPUT=loaded "$program" localize --source record:run.rec --robot robot.toml --tables tables.ortung \
  > poses.txt
[ "$(grep -vc '^#' poses.txt)" -gt 5 ] || { echo "too few poses:"; cat poses.txt; exit 1; }
sed -n 's/.*calling init: //p' loaded.* | sort -u > libraries.txt
grep -q ortung_lrf_data libraries.txt || { echo "the scanner's plugin is not among:"; cat libraries.txt; exit 1; }
! grep -E 'opencv|boost|libGL|libOSMesa|libEGL|Qt5|gdal|embree|box2d|mrpt|libX' libraries.txt || {
  echo "ortung localize must not load the above"
  exit 1
}
"$program" --version > /dev/null
LD_DEBUG=files LD_DEBUG_OUTPUT=version "$program" --version > /dev/null
count=$(sed -n 's/.*calling init: //p' version.* | sort -u | wc -l)
[ "$count" -le 10 ] || { echo "ortung --version loads $count libraries"; exit 1; }
