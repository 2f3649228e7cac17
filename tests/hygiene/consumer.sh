#!/bin/sh
# consumer.sh BUILD CMAKE COMPILER WORK  installs container and mcl and builds and runs a foreign program
# on them, where no other library can be found; then asks the package for components.
set -e
build=$1
cmake=$2
compiler=$3
work=$4
export CMAKE_GENERATOR=Ninja
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
"$here/install.sh" "$build" "$cmake" "$work/prefix" container mcl > "$work/install.log"
for project in . components; do
  "$cmake" -S "$here/../consumer/$project" -B "$work/build/$project" -DCMAKE_PREFIX_PATH="$work/prefix" \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Debug > "$work/configure.log"
done
"$cmake" --build "$work/build" > "$work/build.log" || { cat "$work/build.log"; exit 1; }
LD_LIBRARY_PATH=$(dirname "$(find "$work/prefix" -name libortung_container.so)")
export LD_LIBRARY_PATH
"$work/build/robot"
"$work/build/foreign" "$work/build/plugins"
