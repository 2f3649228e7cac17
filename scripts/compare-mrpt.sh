#!/bin/sh
# compare-mrpt.sh DATA [further options of compare-mrpt.py]
# Runs MRPT's pf-localization (Debian: mrpt-apps) on the logs in the folder DATA and prints a table
# of what it reaches. Builds the converter of logs that it needs in build/release.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(dirname "$here")
if [ $# -lt 1 ]; then
  echo "usage: $0 DATA [--seeds N] [--samples N...] [--budget SECONDS] [--logs NAME,...] [--json FILE]" >&2
  exit 2
fi
if [ ! -x "$root/build/release/bin/scanlog2rawlog" ]; then
  (cd "$root" && cmake --preset release >&2 && ninja -C build/release scanlog2rawlog >&2)
fi
exec python3 "$here/compare-mrpt.py" --converter "$root/build/release/bin/scanlog2rawlog" "$@"
