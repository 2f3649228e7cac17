"""Sweeps of `ortung sweep` from Python: run here, or by anything that has futures, such as Dask's Client.

The program does the work; this module calls it. Results lie in a folder that all workers share; they do not depend on the worker.
"""
from __future__ import annotations

import csv
import io
import json
import os
import shutil
import subprocess
import tempfile
from typing import Any, Dict, List, Optional, Sequence

from ._needs import needs

__all__ = ["SweepError", "figures", "plan", "run", "run_shard", "table", "table_text"]


class SweepError(RuntimeError):
    """The program ended with an error; the text is what it said."""


def _program() -> str:
    program = os.environ.get("ORTUNG_PROGRAM") or shutil.which("ortung")
    if program is None:
        raise SweepError(needs("sweeps", "the program ortung", ["ortung-sim"],
                               "it is not in the PATH, and ORTUNG_PROGRAM does not name it"))
    return program


def _ortung(*words: str, allowed: Sequence[int] = (0,)) -> str:
    result = subprocess.run([_program(), *words], capture_output=True, text=True)
    if result.returncode not in allowed:
        raise SweepError(result.stderr.strip())
    return result.stdout


def plan(file: str) -> List[str]:
    """Returns the names of a sweep's tasks."""
    return [line.split(" ", 1)[1] for line in _ortung("sweep", "plan", file).splitlines()[:-1]]


def run_shard(file: str, folder: str, shard: int, shards: int) -> str:
    """Runs those tasks of a shard that are not done. Returns what the program said. Raises SweepError if a task failed."""
    return _ortung("sweep", "run", file, "--dir", folder, "--shard", "%d/%d" % (shard, shards))


def run(file: str, folder: str, shards: int = 1, client: Optional[Any] = None) -> List[str]:
    """Runs all shards of a sweep: one after another, or with a `client` that has Dask's submit() and gather().

    Paths are made absolute, since workers may be elsewhere.
    """
    arguments = [(os.path.abspath(file), os.path.abspath(folder), i, shards) for i in range(1, shards + 1)]
    if client is None:
        return [run_shard(*one) for one in arguments]
    return list(client.gather([client.submit(run_shard, *one, pure=False) for one in arguments]))


def table_text(folder: str, by: Sequence[str] = (), figures: Sequence[str] = ()) -> str:
    """Returns the table of what is there as Markdown."""
    return _ortung("sweep", "table", folder, *_options(by, figures))


def table(folder: str, by: Sequence[str] = (), figures: Sequence[str] = ()) -> List[Dict[str, str]]:
    """Returns the rows of the table of what is there, as csv.DictReader does.

    folder: that of the sweep. by: keys of the sweep's file whose values get rows of their own, the means over all others;
    () for all but "seed". figures: names of numbers in what the tasks' command writes as JSON, as figures() returns
    it, with a dot for each step inside, e.g. "position_rmse_m", "at_corrections.nees_mean" (`ortung eval`) or
    "cells.0.scoring.value" (the benchmark); () for the usual ones of the command. Raises SweepError for a name that no
    finished task has.
    """
    with tempfile.TemporaryDirectory(prefix="ortung-sweep-") as scratch:
        name = os.path.join(scratch, "table.csv")
        _ortung("sweep", "table", folder, "--csv", name, *_options(by, figures))
        with open(name, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(io.StringIO(file.read())))


def figures(folder: str) -> List[Dict[str, Any]]:
    """Returns what there is of each task, in the order of the sweep: its name ("task"), the names of its "values" by key, and all
    "figures" that its command has written, None if it is not done."""
    with tempfile.TemporaryDirectory(prefix="ortung-sweep-") as scratch:
        name = os.path.join(scratch, "figures.json")
        _ortung("sweep", "table", folder, "--json", name)
        with open(name, encoding="utf-8") as file:
            tasks: List[Dict[str, Any]] = json.load(file)["tasks"]
            return tasks


def _options(by: Sequence[str], figures: Sequence[str]) -> List[str]:
    words: List[str] = []
    for option, values in (("--by", by), ("--figures", figures)):
        if values:
            words += [option, ",".join(values)]
    return words
