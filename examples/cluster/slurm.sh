#!/bin/bash
#SBATCH --job-name=ortung
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=ortung-%A_%a.log
# Shards of work as the tasks of a Slurm array (--array=1-N; numbers from 1). {i} stands for the task's number.
#   sbatch --array=1-12 slurm.sh sweep run particles.toml --dir results
#   sbatch --array=1-12 slurm.sh learn --world hall.toml --robot robot.toml --out parts/{i}.part
# What has {i} in its name is written on the node's own disk, and put in its place once it is whole.
set -euo pipefail
i=$SLURM_ARRAY_TASK_ID n=$SLURM_ARRAY_TASK_COUNT
scratch=$(mktemp -d "${TMPDIR:-/tmp}/ortung.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
words=() place=
for word in "$@"; do
  if [[ $word == *"{i}"* ]]; then
    place=${word//"{i}"/$i}
    word=$scratch/part
  fi
  words+=("$word")
done
"${ORTUNG:-ortung}" "${words[@]}" --shard "$i/$n"
if [[ $place ]]; then
  cp "$scratch/part" "$place.$SLURM_JOB_ID" && sync "$place.$SLURM_JOB_ID"
  mv "$place.$SLURM_JOB_ID" "$place"
fi
