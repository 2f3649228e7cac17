#!/bin/sh
# installed.sh BUILD CMAKE COMPILER  what is installed works by itself, far from the build tree: the program finds
# its plugins, and so do robot programs of somebody else, the examples, on what that program wrote.
set -e
build=$1
cmake=$2
compiler=$3
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
unset ORTUNG_PLUGIN_PATH LD_LIBRARY_PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
  echo "$*"
  exit 1
}

"$here/install.sh" "$build" "$cmake" "$work/prefix" container mcl sim plugins app > "$work/install.log"
"$cmake" -S "$here/../consumer/localize" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DEXAMPLES="$source/examples" -DCMAKE_CXX_COMPILER="$compiler" > "$work/configure.log"
"$cmake" --build "$work/build" > "$work/build.log" || { cat "$work/build.log"; exit 1; }
for file in "$work/build/localize" "$work"/prefix/bin/ortung "$work"/prefix/lib*/ortung/plugins/*.so; do
  ! ldd "$file" | grep -e "$build" -e 'not found' || fail "$file needs the above"
done

# Files in a folder that knows nothing of where they were made.
mkdir "$work/robot"
cd "$work/robot"
cp "$source/maps/robots/pioneer.toml" robot.toml
cp "$source/maps/fields/arena.toml" world.toml
ortung=$work/prefix/bin/ortung
"$ortung" learn --world world.toml --robot robot.toml --out tables.ortung
"$ortung" import sim world.toml --with-robot robot.toml --option duration=10 --option seed=3 --out run.rec
"$ortung" localize --source record:run.rec --robot robot.toml --tables tables.ortung |
  awk '!/^#/ { printf "%.3f s: x %.3f m, y %.3f m\n", $1 / 1e6, $2, $3 }' > expected.txt
[ "$(wc -l < expected.txt)" -gt 30 ] || fail "ortung localize gave too few poses"

"$work/build/localize" robot.toml tables.ortung record:run.rec | sed 's/, heading.*//' > poses.txt
# The text of ortung localize is rounded already, so its last digit may be rounded once more.
paste -d ' ' expected.txt poses.txt | awk '
  NF != 16 || $1 != $9 || ($4 - $12) ^ 2 > 2e-6 || ($7 - $15) ^ 2 > 2e-6 { print; bad = 1 } END { exit bad }' ||
  fail "localize and ortung localize do not agree"

# The run's odometry and scans as a record, and as the lines that own_readings reads.
awk '$2 ~ /^odometry/ { at[$1] = $4 " " $5 " " $6 }
     $2 ~ /LRF/ && $1 in at {
       split(at[$1], p, " ")
       printf "%s odometry/odometry/pose 5 %s 2147483648 2147483648\n%s\n", $1, at[$1], $0 > "bare"
       printf "%s %.3f %.3f %.6f", $1, (p[1] - 2147483648) / 1e3, (p[2] - 2147483648) / 1e3,
              (p[3] - 18000) / 18000 * 3.14159265
       for (i = 4; i <= NF; ++i) printf " %.3f", $i / 1e3
       print ""
     }' run.rec > readings.txt
{ head -2 run.rec; cat bare; } > bare.rec
"$work/build/localize" robot.toml tables.ortung record:bare.rec | awk '{ print $4, $7, $10 }' > expected.txt
"$work/build/own_readings" robot.toml tables.ortung < readings.txt > poses.txt
[ "$(wc -l < poses.txt)" -gt 30 ] || fail "own_readings gave too few poses"
cmp expected.txt poses.txt || fail "own readings and their record do not give the same poses"

# What is wrong is said in one line.
"$work/build/localize" robot.toml nowhere.ortung record:run.rec 2> told && fail "no tables, but no error"
grep -q '^localize: nowhere.ortung: ' told || fail "$(cat told)"
