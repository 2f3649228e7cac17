#!/usr/bin/env bash
# check-options.sh [--configure]  that each option may be left out alone, and that libraries may be static: a robot's part
# is built so, installed, moved, and the examples are built on it and run. --configure: without building.
set -euo pipefail
cd "$(dirname "$0")/.."
export CMAKE_GENERATOR=Ninja
work=$PWD/build/options
mkdir -p "$work"
for option in SIM SERVER CLIENT REALSENSORS MRPT VISION STUDY APP PYTHON TESTS INSTALL; do
  cmake --preset dev -B "$work/$option" "-DORTUNG_$option=OFF" -DORTUNG_BENCH=ON > "$work/$option.log" 2>&1 ||
    { cat "$work/$option.log"; echo "check-options: ORTUNG_$option=OFF alone does not configure" >&2; exit 1; }
done
echo "check-options: each option off alone configures"
[[ ${1:-} != --configure ]] || exit 0

rm -rf "$work/installed" "$work/moved"
cmake --preset robot -B "$work/static" -DBUILD_SHARED_LIBS=OFF -DCMAKE_BUILD_TYPE=Debug > "$work/static.log"
cmake --build "$work/static" > "$work/static.log" || { cat "$work/static.log"; exit 1; }
cmake --install "$work/static" --prefix "$work/installed" > "$work/static.log"
mv "$work/installed" "$work/moved"
if find "$work/moved" -name 'libortung_*.so*' | grep .; then
  echo "check-options: the above are not static" >&2
  exit 1
fi
rm -rf "$work/examples"
cmake -S examples -B "$work/examples" -DCMAKE_PREFIX_PATH="$work/moved" > "$work/examples.log"
cmake --build "$work/examples" > "$work/examples.log" || { cat "$work/examples.log"; exit 1; }
# In bin/ a program finds the plugins that were installed with it, elsewhere it is told where they are.
mkdir -p "$work/moved/bin"
cp "$work/examples/localize" "$work/moved/bin/"
plugins=$(dirname "$(find "$work/moved" -name ortung_lrf_data.so)")
for command in "$work/moved/bin/localize" "env ORTUNG_PLUGIN_PATH=$plugins $work/examples/localize"; do
  # shellcheck disable=SC2086  # words of a command
  told=$($command maps/robots/pioneer.toml nowhere.ortung record:nowhere.rec 2>&1) && exit 1
  [[ $told == "localize: nowhere.ortung: "* ]] || { echo "check-options: $command says $told" >&2; exit 1; }
done
if [[ -x build/dev/bin/ortung && -x build/dev/bin/localize ]]; then  # the same poses as with shared ones
  build/dev/bin/ortung learn --world maps/fields/arena.toml --robot maps/robots/pioneer.toml --out "$work/tables.ortung"
  build/dev/bin/ortung import sim maps/fields/arena.toml --with-robot maps/robots/pioneer.toml --option duration=5 \
    --out "$work/run.rec" --force
  run=(maps/robots/pioneer.toml "$work/tables.ortung" "record:$work/run.rec")
  cmp <("$work/moved/bin/localize" "${run[@]}") <(build/dev/bin/localize "${run[@]}")
fi
echo "check-options: static libraries install, move, link and find plugins"
