#!/usr/bin/env python3
"""localize_memory.py PROGRAM MAPS DATA  `ortung localize` of a robot with a laser in a building stays within 64 MB: in the building that
ships, by rays and by end points, and, where recordings are, in a real one of 1,200 m^2 by end points. What counts are all pages in
memory, those of the table file among them."""
import os
import re
import subprocess
import sys
import tempfile

MOST = 64  # [MB]
REAL = "carmen/belgioioso"


def run(*words):
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def peak(words):
    """The greatest resident memory of a program [MB], which must end well."""
    process = os.posix_spawn(words[0], words, os.environ)
    _, status, usage = os.wait4(process, 0)
    assert status == 0, (words, status)
    return usage.ru_maxrss * 1024 / 1e6


def main(program, maps, data):
    with tempfile.TemporaryDirectory() as folder:
        path = lambda name: os.path.join(folder, name)
        world = os.path.join(maps, "fields/offices.toml")
        robot = os.path.join(maps, "robots/pioneer_lrf.toml")
        run(program, "import", "sim", world, "--with-robot", robot, "--option", "duration=30", "--out", path("offices.rec"))
        cases = [(world, robot, path("offices.rec"), "rays"), (world, robot, path("offices.rec"), "endpoints")]
        if os.path.exists(os.path.join(data, REAL)):
            cases.append((path("real.toml"), path("robot.toml"), path("real.rec"), "endpoints"))
            run(program, "import", "scanlog", os.path.join(data, REAL), "--world", path("real.toml"), "--robot-file",
                path("robot.toml"), "--out", path("real.rec"))
        else:
            print("%s is not here; it belongs to no repository" % os.path.join(data, REAL))
        largest = 0.0
        for world, robot, record, perception in cases:
            with open(robot) as file:
                text = re.sub(r'^perception = "[a-z]+"', 'perception = "%s"' % perception, file.read(), flags=re.MULTILINE)
            assert 'perception = "%s"' % perception in text, robot
            with open(path("this.toml"), "w") as file:
                file.write(text)
            run(program, "learn", "--world", world, "--robot", path("this.toml"), "--out", path("this.ortung"), "--force")
            found = peak([program, "localize", "--source", "record:" + record, "--robot", path("this.toml"), "--tables",
                          path("this.ortung"), "--out", path("poses.txt"), "--force"])
            print("%s by %s: %.1f MB, of which the tables are up to %.1f MB"
                  % (os.path.basename(record), perception, found, os.path.getsize(path("this.ortung")) / 1e6))
            largest = max(largest, found)
        assert largest <= MOST, "at most %d MB are expected" % MOST


if __name__ == "__main__":
    main(*sys.argv[1:])
