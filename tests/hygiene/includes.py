#!/usr/bin/env python3
"""Compares what sources include with the picture of the house in docs/architecture.md.

usage: includes.py ROOT

A room is a folder; what it may use stands behind its arrow. Arrows point downwards, every folder with sources is in a
room, no room holds more than a fifth of the code, and libraries of others are included where FOREIGN allows it.
"""

import re
import sys
from collections import Counter, defaultdict
from pathlib import Path

TOPS = ["app", "board", "container", "mcl", "play", "plugins", "python", "realsensors", "sim"]
CONTAINER = ["base", "tables", "core", "formats", "motion"]
BIGGEST_SHARE = 0.2

# Beginnings of headers that are not ours, and the files that may include them. What stands nowhere here is refused.
FOREIGN = {
    r"Eigen/": r"^(?!.*/include/).*\.(cpp|hpp)$",
    r"CLI/": r"^(app/(module|program)/.*|realsensors/(ros2_live/OrtungRos2|ros2_robot/OrtungRos2Robot))\.cpp$",
    r"fast(dds|rtps)/": r"^realsensors/ros2_live/dds/(DdsBytes|Participant(Parts)?|Service)\.(cpp|hpp)$",
    r"fmt/|spdlog/|stb/|dlib/": r"^app/",
    r"pybind11/": r"^python/",
    r"toml\+\+/": r"^(container/robot/src|app/sweep)/",
    r"nlohmann/": r"^(app|container/robot/src|board/refbox/src|play/benchmark/src|realsensors/foxglove/src)/",
    r"zstd\.h": r"^(container/records/src/Zstd|realsensors/ros2/src/Compression)\.cpp$",
    r"xxhash\.h": r"^app/shards/ContentDigest\.cpp$",
    r"lz4frame\.h": r"^realsensors/ros2/src/Compression\.cpp$",
    r"boost/(asio|beast|optional)": r"^board/(server/src/(AddressKey\.|Arrival\.|Entrance\.|Session\.|MessageBoard\.cpp)"
    r"|refbox/src/RefBoxClient\.cpp|web/src/)",
    r"boost/crc": r"^realsensors/(devices|ros2)/src/",
    r"boost/math/": r"^app/report/",
    r"boost/(iostreams|archive)": r"^(app/|realsensors/core/src/|sim/src/world/)",
    r"yaml-cpp/": r"^(app/images|sim/src/world)/"
    r"|^realsensors/(ros2/plugins/BagFolder|ros2_live/node/(AmclParameters|ParamsFile))\.cpp$",
    r"sqlite3\.h": r"^realsensors/ros2/plugins/Db3File\.cpp$",
    r"bzlib\.h": r"^realsensors/ros2/plugins/Bzip2\.cpp$",
    r"png\.h": r"^(app/|sim/src/world/)",
    r"embree3/": r"^sim/src/rays/",
    r"box2d/": r"^sim/src/physics/",
    r"(GL|EGL)/": r"^sim/src/render/",
    r"mrpt/": r"^realsensors/mrpt(_devices)?/",
    # Of OpenCV, robots need core and imgproc; files and chessboards are for calibration, videos for a driver.
    r"opencv2/(core|imgproc)\.hpp": r"^realsensors/(vision/src/BlobFinder\.cpp|calibration/src/|devices/plugins/CameraDevice\.cpp)",
    r"opencv2/(imgcodecs|calib3d)\.hpp": r"^realsensors/calibration/src/",
    r"opencv2/videoio\.hpp": r"^realsensors/devices/plugins/CameraDevice\.cpp$",
    # The main job as a library prints nothing, and has no command line.
    r"iostream$|csignal$": r"^(?!mcl/run/)",
    r"unistd\.h": r"^(?!mcl/run/)",
    # C, POSIX and processors.
    r"(arpa|net|netinet|sys)/|(arm_neon|dlfcn|elf|fcntl|immintrin|link|netdb|poll|sched|spawn|stddef|stdint|stdlib|termios|time)\.h": "",
}


class House:
    """The picture: rooms from top to bottom, and what each may use."""

    def __init__(self, text):
        block = re.search(r"## Folders and rooms.*?```text\n(.*?)```", text, re.S)
        self.uses = {}
        for line in block.group(1).splitlines():
            room, arrow, uses = line.partition("->")
            if arrow:
                self.uses[room.strip()] = uses.split()
        self.order = list(self.uses)
        self.problems = []
        for room, uses in self.uses.items():
            self.uses[room] = self.spelled_out(room, uses)

    def spelled_out(self, room, uses):
        rooms = set()
        for name in uses:
            if name == "all":
                rooms |= {below for below in self.order if not below.startswith("app/")}
            elif name == "container":
                rooms |= {f"container/{part}" for part in CONTAINER} & set(self.order)
            elif f"container/{name}" in self.uses:
                rooms.add(f"container/{name}")
            else:
                rooms.add(name)
        for name in rooms:
            if name not in self.uses:
                self.problems.append(f"{room} uses {name}, which is no room of the picture")
            elif self.order.index(name) < self.order.index(room):
                self.problems.append(f"{room} uses {name}, which stands above it")
        return rooms | {room}

    def room_of(self, path):
        """The room with the longest name that the file lies in."""
        for folder in Path(path).parents:
            if str(folder) in self.uses:
                return str(folder)
        return None


def sources(root):
    for top in TOPS:
        for path in sorted((root / top).rglob("*")):
            if path.suffix in (".hpp", ".cpp", ".h") and "node_modules" not in path.parts:
                yield str(path.relative_to(root)), path.read_text(errors="replace")


def includes(text):
    return re.findall(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', text, re.M)


def check(root):
    house = House((root / "docs/architecture.md").read_text())
    problems = house.problems
    lines = Counter()
    public, private, texts = {}, defaultdict(set), {}
    for path, text in sources(root):
        room = house.room_of(path)
        if room is None:
            problems.append(f"{path} lies in no room of docs/architecture.md")
            continue
        texts[path] = (room, text)
        lines[room] += text.count("\n")
        if "/include/" in path:
            public[path.split("/include/")[1]] = room
        else:
            private[Path(path).name].add(room)
    for path, (room, text) in texts.items():
        for quote, header in includes(text):
            if header in public or header.startswith("ortung/"):
                rooms = {public[header]} if header in public else set()  # others are made by the build
            elif quote == '"':
                rooms = private.get(Path(header).name, set())
            else:
                rooms = set()
                problems += foreign(path, header)
            if rooms and not rooms & house.uses[room]:
                problems.append(f"{path} includes {header} of {', '.join(sorted(rooms))}, which {room} may not use")
    whole = sum(lines.values())
    for room, count in lines.items():
        if count > BIGGEST_SHARE * whole:
            problems.append(f"{room} holds {100 * count / whole:.0f} % of the code, expected at most 20 %")
    return problems


def foreign(path, header):
    for beginning, allowed in FOREIGN.items():
        if re.match(beginning, header):
            return [] if re.match(allowed, path) else [f"{path} must not include <{header}>"]
    if re.fullmatch(r"[a-z_0-9]+", header):
        return []  # the standard library
    return [f"{path} includes <{header}>, which tests/hygiene/includes.py does not know"]


if __name__ == "__main__":
    found = check(Path(sys.argv[1]))
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)
