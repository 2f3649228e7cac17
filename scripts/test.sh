#!/usr/bin/env bash
# Installs, builds and runs the tests: test.sh [--preset dev|asan|tsan|release] [ctest arguments...]
# Tests on real recordings use ../shared/data and are skipped where it is absent; the last lines say how many tests
# were skipped and why.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=dev
if [[ ${1:-} == --preset ]]; then
  preset=${2:?"--preset needs a name"}
  shift 2
fi
scripts/install-deps.sh
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" -- -k 0
scripts/run-tests.sh "$preset" "$@"
