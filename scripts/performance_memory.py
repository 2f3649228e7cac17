#!/usr/bin/env python3
"""Peak memory of learning, localizing and serving on shipped fields and a building, beside the size of the field and of its tables.

  scripts/performance_memory.py build/release/bin/ortung ../shared/data [--out DIR]

Prints a table in Markdown. Peak memory is the greatest resident set of the process, which includes libraries and the pages of mapped
tables that were touched. The building is a log of the data folder; without that folder its row is left out.
"""
import argparse
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import zipfile

import evaluate

FIELDS = (("f2000", "pioneer"), ("boxes18x12", "pioneer_lrf"), ("msl", "msl_omni"), ("offices", "pioneer_lrf"))  # world, robot
BUILDING = "intel"
SECONDS = 60  # of readings that are localized
SERVED = 20  # for which a simulation is served [s]
HEAD = ("| field, robot | size [m] | open cells | tables [MB] | `learn` [MB] | `localize` [MB] | `eval` [MB] | serving, localized [MB] |\n"
        "|" + "---|" * 8)


def peak(command, seconds=None):
    """Greatest resident set of a command [MB]. One that does not end by itself is told to end after some seconds."""
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen([str(word) for word in command], stdout=output, stderr=subprocess.STDOUT)
        if seconds is not None:
            time.sleep(seconds)
            process.send_signal(signal.SIGTERM)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            output.seek(0)
            sys.exit("%s\n%s" % (" ".join(map(str, command)), output.read().decode()))
    return usage.ru_maxrss * 1024 / 1e6


def grid_of(tables):
    """Width and height [m] and the number of open cells of a table file."""
    with zipfile.ZipFile(tables) as file:
        cell = float(re.search(r'"cell_m": ([^,\s]+)', file.read("meta.json").decode()).group(1))
        array = file.read("open.npy")
    header = 10 + int.from_bytes(array[8:10], "little")
    rows, columns = map(int, re.search(rb"\((\d+), (\d+)\)", array[:header]).groups())
    return columns * cell, rows * cell, sum(array[header:])


def row(ortung, name, base, robot, record):
    """One row. @param base what the names of world (.toml) and tables (.ortung) begin with"""
    world, tables = base + ".toml", base + ".ortung"
    learning = peak([ortung, "learn", "--world", world, "--robot", robot, "--out", tables, "--force"])
    source = ["--source", "record:%s?to_s=%d" % (record, SECONDS), "--robot", robot, "--tables", tables]
    localizing = peak([ortung, "localize", *source])
    evaluating = peak([ortung, "eval", *source])
    serving = peak([ortung, "sim", world, "--robot", robot, "--tables", tables, "--localize", "all", "--listen", "0"], SERVED)
    width, height, cells = grid_of(tables)
    return "| %s | %.0f x %.0f | %d | %.1f | %.0f | %.0f | %.0f | %.0f |" % (
        name, width, height, cells, os.path.getsize(tables) / 1e6, learning, localizing, evaluating, serving)


def rows(ortung, data, out):
    """Rows of the table, one by one. @param data folder of the logs @param out folder for what is made"""
    os.makedirs(out, exist_ok=True)
    for field, robot in FIELDS:
        base = os.path.join(out, field)
        world = os.path.join(evaluate.MAPS, "fields", field + ".toml")
        with open(world) as source, open(base + ".toml", "w") as copy:
            copy.write(source.read())
        robot_file = os.path.join(evaluate.MAPS, "robots", robot + ".toml")
        evaluate.run([ortung, "sim", world, "--robot", robot_file, "--duration", SECONDS, "--free-run", "--record", base + ".rec", "--force"])
        yield row(ortung, "%s, %s" % (field, robot), base, robot_file, base + ".rec")
    if os.path.isdir(os.path.join(data, evaluate.LASER[BUILDING][0])):
        base = evaluate.import_laser(ortung, data, out, BUILDING)
        yield row(ortung, BUILDING, base, base + "-robot.toml", base + ".rec")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung")
    parser.add_argument("data")
    parser.add_argument("--out", help="folder for what is made; default: a temporary one")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        print(HEAD)
        for line in rows(arguments.ortung, arguments.data, arguments.out or scratch):
            print(line, flush=True)


if __name__ == "__main__":
    main()
