#!/bin/sh
# installed.sh BUILD CMAKE COMPILER C_COMPILER VERSION  what is installed works by itself, moved to where nobody planned
# it: the program and its helper find libraries and plugins, and so do programs of somebody else, the examples.
set -e
build=$1
cmake=$2
compiler=$3
c_compiler=$4
version=$5
export CMAKE_GENERATOR=Ninja
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
unset ORTUNG_PLUGIN_PATH ORTUNG_LIBEXEC LD_LIBRARY_PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
  echo "$*"
  exit 1
}

"$cmake" --install "$build" --prefix "$work/first" > "$work/install.log" 2>&1 || fail "$(cat "$work/install.log")"
prefix="$work/moved to here"
mv "$work/first" "$prefix"
lib=$(dirname "$(find "$prefix" -name libortung_container.so)")

# Nothing knows where it was made or meant to be.
! grep -rlFe "$build" -e "$source" -e "$work/first" "$lib/cmake" "$lib/pkgconfig" || fail "the files above know the build"
for file in "$prefix"/bin/* "$prefix"/libexec/ortung/* "$lib"/libortung_*.so "$lib"/ortung/plugins/*.so; do
  [ -e "$file" ] || fail "$file is not installed"
  ! readelf -d "$file" | grep RUNPATH | grep -v '\[\$ORIGIN[^:]*\]' || fail "$file has the RUNPATH above"
  ! ldd "$file" | grep -Fe "$build" -e "$work/first" -e 'not found' || fail "$file needs the above"
done
grep -q 'BSD 3-Clause' "$prefix"/share/doc/ortung/LICENSE || fail "there is no LICENSE"
# The name that programs note promises what the package promises: the same minor version.
minor=${version%.*}
readelf -d "$lib/libortung_container.so" | grep -q "SONAME.*\[libortung_container\.so\.${minor}\]" || fail "SONAME is not $minor"
[ -e "$lib/libortung_container.so.$version" ] || fail "there is no libortung_container.so.$version"

# Programs of somebody else, with the package and with pkg-config.
cp -r "$source/examples" "$work/examples"
"$cmake" -S "$work/examples" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  > "$work/configure.log" 2>&1 || fail "$(cat "$work/configure.log")"
"$cmake" --build "$work/build" -j 2 > "$work/build.log" 2>&1 || fail "$(cat "$work/build.log")"
export PKG_CONFIG_PATH="$lib/pkgconfig"
for pc in "$lib"/pkgconfig/*.pc; do
  pkg-config --exists --print-errors "$(basename "$pc" .pc)" || fail "$pc is no good"
done
eval "'$c_compiler' '$work/examples/avoid.c' -o '$work/avoid' $(pkg-config --cflags --libs ortung-client)" \
  "'-Wl,-rpath,$lib'" || fail "avoid.c was not built with pkg-config"
"$work/avoid" 2> "$work/told" && fail "avoid without arguments succeeds"
grep -q '^avoid_c HOST PORT' "$work/told" || fail "$(cat "$work/told")"
"$cmake" -DNEWER="${minor%.*}.$((${minor#*.} + 1))" -Dortung_DIR="$lib/cmake/ortung" -P "$here/newer.cmake" ||
  fail "the package passes for the next minor version"

# Files in a folder that knows nothing of where they were made; the program by a link.
mkdir "$work/robot"
cd "$work/robot"
cp "$prefix"/share/ortung/maps/robots/pioneer.toml robot.toml
cp "$prefix"/share/ortung/maps/fields/arena.toml world.toml
ln -s "$prefix/bin/ortung" ortung
ortung=./ortung
"$ortung" plugins > plugins.txt || fail "$(cat plugins.txt)"
[ "$(grep -c "^$prefix.*\.so$" plugins.txt)" = "$(ls "$lib"/ortung/plugins | wc -l)" ] || fail "$(cat plugins.txt)"

# The player of docs/players.md as a project of its own, which plays with what is installed.
mkdir "$work/shy"
awk -v folder="$work/shy/" '/^`ShyPlayer.cpp`/ { file = "ShyPlayer.cpp" } /^Outside the tree/ { file = "CMakeLists.txt" }
  /^```$/ { if (writes) file = ""; writes = 0 } writes { print > (folder file) } /^```(cpp|cmake)$/ && file != "" { writes = 1 }' "$source/docs/players.md"
"$cmake" -S "$work/shy" -B "$work/shy/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  > "$work/configure.log" 2>&1 || fail "$(cat "$work/configure.log")"
"$cmake" --build "$work/shy/build" > "$work/build.log" 2>&1 || fail "$(cat "$work/build.log")"
ORTUNG_PLUGIN_PATH="$work/shy/build" "$ortung" sim world.toml --player 'shy:near_m=0.5@blue' --duration 5 --free-run > played.txt ||
  fail "the player of docs/players.md does not play"
grep -q '1 robots' played.txt || fail "$(cat played.txt)"

"$ortung" learn --world world.toml --robot robot.toml --out tables.ortung
"$ortung" import sim world.toml --with-robot robot.toml --option duration=10 --option seed=3 --out run.rec
zstdcat run.rec > run.txt
"$ortung" localize --source record:run.rec --robot robot.toml --tables tables.ortung |
  awk '!/^#/ { printf "%.3f s: x %.3f m, y %.3f m\n", $1 / 1e6, $2, $3 }' > expected.txt
[ "$(wc -l < expected.txt)" -gt 30 ] || fail "ortung localize gave too few poses"

# The helper that reads MRPT's files says itself what is wrong with one: it was found, and found its libraries.
if [ -e "$prefix/libexec/ortung/ortung-mrpt-reader" ]; then
  echo 'no rawlog' > bad.rawlog
  "$ortung" import rawlog bad.rawlog --out bad.rec 2> told && fail "a bad rawlog is imported"
  grep -q 'ortung-mrpt-reader ended with status 1: ' told || fail "$(cat told)"
fi

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
     }' run.txt > readings.txt
{ head -2 run.txt; cat bare; } > bare.rec
"$work/build/localize" robot.toml tables.ortung record:bare.rec | awk '{ print $4, $7, $10 }' > expected.txt
"$work/build/own_readings" robot.toml tables.ortung < readings.txt > poses.txt
[ "$(wc -l < poses.txt)" -gt 30 ] || fail "own_readings gave too few poses"
cmp expected.txt poses.txt || fail "own readings and their record do not give the same poses"

# What is wrong is said in one line.
"$work/build/localize" robot.toml nowhere.ortung record:run.rec 2> told && fail "no tables, but no error"
grep -q '^localize: nowhere.ortung: ' told || fail "$(cat told)"
