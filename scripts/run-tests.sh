#!/usr/bin/env bash
# Runs the tests that are built, says how many were skipped and why, and looks again at what other work may have
# held up: run-tests.sh PRESET [ctest arguments...]
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${1:?"expected a preset, as dev"}
shift
results=build/$preset/tests.xml
status=0
ctest --preset "$preset" -j "$(nproc)" --output-junit tests.xml "$@" || status=$?
if ((status == 8)) && again=$(scripts/again.py "$results"); then # 8: tests have failed
  echo "again, alone: what failed beside other tests, and has threads or other programs"
  if ctest --preset "$preset" --output-junit again.xml -R "$again"; then
    status=0
    echo "UNSTEADY: $again failed, and passed alone"
  else
    echo "$again failed, and failed alone, too"
  fi
fi
scripts/skipped.py "$results"
exit $status
