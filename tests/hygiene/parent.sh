#!/bin/sh
# parent.sh CMAKE COMPILER WORK  Ortung as a part of another project, which is configured without and with a type of
# its own, and installs what is its own.
set -e
cmake=$1
compiler=$2
work=$3
export CMAKE_GENERATOR=Ninja
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
rm -rf "$work"
for type in "" Debug; do
  "$cmake" -S "$here/../consumer/parent" -B "$work/build" -DORTUNG_SOURCE="$source" -DCMAKE_BUILD_TYPE="$type" \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_INSTALL_PREFIX="$work/prefix" > "$work.log" 2>&1 || { cat "$work.log"; exit 1; }
done
"$cmake" --install "$work/build" > "$work.log" 2>&1 || { cat "$work.log"; exit 1; }
[ ! -e "$work/prefix" ] || { echo "installed with the parent:"; find "$work/prefix"; exit 1; }
