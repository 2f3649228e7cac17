#!/bin/sh
# consumer.sh BUILD CMAKE COMPILER WORK  installs container and mcl and builds and runs a foreign program
# on them, where no other library can be found.
set -e
build=$1
cmake=$2
compiler=$3
work=$4
rm -rf "$work"
mkdir -p "$work/build"
# Only these two folders: an install of everything would need everything to be built.
"$cmake" --install "$build/container" --prefix "$work/prefix" > "$work/install.log"
"$cmake" --install "$build/mcl" --prefix "$work/prefix" >> "$work/install.log"
for file in ortungConfig.cmake ortungConfigVersion.cmake; do
  cp "$build/$file" "$(dirname "$(find "$work/prefix" -name ortung_container.cmake)")/"
done
"$cmake" -S "$(dirname "$0")/../consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Debug > "$work/configure.log"
"$cmake" --build "$work/build" > "$work/build.log" || { cat "$work/build.log"; exit 1; }
LD_LIBRARY_PATH=$(dirname "$(find "$work/prefix" -name libortung_container.so)") "$work/build/robot"
