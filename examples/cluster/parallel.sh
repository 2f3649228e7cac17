#!/bin/sh
# The shards of a sweep by GNU parallel: on this machine, or with -S on others that share the folder.
#   parallel.sh particles.toml results 12 [-S host1,host2 --workdir .]
# Tasks that die are run again, and what was interrupted goes on where it was.
set -eu
sweep=$1 dir=$2 shards=$3
shift 3
seq "$shards" | parallel --will-cite --retries 3 --joblog "$dir.log" --resume-failed "$@" \
  "${ORTUNG:-ortung}" sweep run "$sweep" --dir "$dir" --shard "{}/$shards"
