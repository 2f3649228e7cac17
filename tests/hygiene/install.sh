#!/bin/sh
# install.sh BUILD CMAKE PREFIX FOLDER...  installs these folders and the package. An install of everything would
# need everything to be built.
set -e
build=$1
cmake=$2
prefix=$3
shift 3
for folder in "$@"; do
  "$cmake" --install "$build/$folder" --prefix "$prefix"
done
for file in ortungConfig.cmake ortungConfigVersion.cmake; do
  cp "$build/$file" "$(dirname "$(find "$prefix" -name ortung_container.cmake)")/"
done
