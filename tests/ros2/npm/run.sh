#!/bin/sh
# run.sh FOLDER  fetches the packages of this folder into FOLDER and runs the tests there; 77: skipped.
set -u
here=$(cd "$(dirname "$0")" && pwd)
skip() {
  echo "run.sh: Skipped"  # as GoogleTest says it, for scripts/skipped.py
  echo "$1"
  exit 77
}
command -v node > /dev/null 2>&1 && command -v npm > /dev/null 2>&1 || skip "node and npm are not here"
mkdir -p "$1" && cp "$here"/package.json "$here"/package-lock.json "$here"/.npmrc "$here"/*.mjs "$1" && cd "$1" || exit 1
if ! cmp -s package-lock.json node_modules/.from; then
  npm ci --ignore-scripts > npm.log 2>&1 || skip "npm does not give the packages of tests/ros2/npm"
  cp package-lock.json node_modules/.from
fi
exec node --test-reporter=spec --test mcap.mjs foxglove.mjs
