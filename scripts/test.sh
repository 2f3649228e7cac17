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
status=0
ctest --preset "$preset" -j "$(nproc)" --output-junit tests.xml "$@" || status=$?
if ((status == 8)) && again=$(scripts/again.py "build/$preset/tests.xml"); then # 8: tests have failed
  echo "again, alone: what failed beside other tests, and has threads or other programs"
  ctest --preset "$preset" --output-junit again.xml -R "$again" && status=0
  echo "UNSTEADY: $again failed; alone it has $( ((status == 0)) && echo passed || echo "failed, too")"
fi
scripts/skipped.py "build/$preset/tests.xml"
exit $status
