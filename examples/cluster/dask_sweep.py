#!/usr/bin/env python3
"""The shards of a sweep by Dask: dask_sweep.py SWEEP.toml DIR SHARDS [SCHEDULER]

Without a scheduler's address, this machine's cores are the cluster. A worker that dies is replaced, and its shard run again.
"""
import sys

from distributed import Client

from ortung import sweep

if __name__ == "__main__":
    file, folder, shards, *address = sys.argv[1:]
    with Client(*address) if address else Client(n_workers=2, threads_per_worker=1) as client:
        sweep.run(file, folder, int(shards), client=client)
    print(sweep.table_text(folder), end="")
