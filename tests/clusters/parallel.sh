#!/usr/bin/env bash
# parallel.sh PROGRAM PROJECT  a sweep by GNU parallel whose tasks are killed ends with what one process makes.
set -euo pipefail
program=$1 project=$2
command -v parallel > /dev/null && parallel --version < /dev/null 2> /dev/null | grep -q "GNU parallel" ||
  { echo "skipped: GNU parallel is not installed"; exit 77; }
source "$project/tests/clusters/lib.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
make_sweep "$folder" 20
export ORTUNG=$program HOME=$folder
"$project/examples/cluster/parallel.sh" sweep.toml many 6 -j 2 &
launcher=$!
kill_a_task many
wait "$launcher"
check_sweep many
# Nothing is run twice.
"$project/examples/cluster/parallel.sh" sweep.toml many 6 -j 2 | grep -v "^0 of" && exit 1
echo "the same bits"
