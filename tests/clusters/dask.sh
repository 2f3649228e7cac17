#!/usr/bin/env bash
# dask.sh PROGRAM PROJECT PYTHONPATH  a sweep by Dask, one of whose workers is killed, ends with what one process makes.
set -euo pipefail
program=$1 project=$2
export PYTHONPATH=$3 ORTUNG_PROGRAM=$1 PYTHONDONTWRITEBYTECODE=1
/usr/bin/python3 -c "import distributed" 2> /dev/null || { echo "skipped: python3-distributed is not installed"; exit 77; }
source "$project/tests/clusters/lib.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
make_sweep "$folder" 20
# Dask's own dashboard would want a port that may be taken.
export DASK_DISTRIBUTED__SCHEDULER__DASHBOARD__STATUS__TASK_STREAM_LENGTH=0 DASK_TEMPORARY_DIRECTORY=$folder/dask
/usr/bin/python3 "$project/examples/cluster/dask_sweep.py" sweep.toml many 6 > table.md 2> dask.log &
launcher=$!
victim=
for _ in $(seq 2400); do
  victim=$(pgrep -f "^$program sweep run .*--dir $folder/many " | head -1 || true)
  # It may be over by now.
  [[ -n $victim ]] && worker=$(ps -o ppid= -p "$victim" | tr -d ' ') && [[ -n $worker ]] && kill -9 "$worker" "$victim" && break
  victim=
  sleep 0.05
done
[[ -n $victim ]]
echo "killed the worker $worker"
wait "$launcher" || { tail -20 dask.log; exit 1; }
check_sweep many
grep -q "^| 5000 | 6 of 6 |" table.md
echo "the same bits"
