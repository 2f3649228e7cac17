#!/usr/bin/env python3
"""floors_test.py ORTUNG_ROS2 PEER CLIENT  a robot of ROS 2 on Cyclone DDS in a building: floors are drawn of rectangles, and scans computed from
these in closed form. ortung-ros2, which has the maps itself, says on which floor the robot is, and where on it."""
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

from cdr import Reader, Writer
from listening import Listening

node, peer, client = map(pathlib.Path, sys.argv[1:])
DOMAIN = 171 + os.getpid() % 30  # each test has domains of its own
PACE, CELL, ORIGIN = 5.0, 0.05, -1.0
BEAMS, STEP, FAR, MOUNT = 181, math.radians(1.0), 10.0, 0.1
LONGEST = 60.0  # [s] for whatever comes at last, on a busy machine, too
OCCUPIED, UNKNOWN, FREE = 0, 205, 254

# Each floor: width and depth of its inside [m], and what stands there: x, y, width, depth.
FLOORS = {
    "ground": (8.0, 6.0, [(5.0, 0.0, 0.2, 2.5), (0.0, 4.8, 2.0, 0.6), (6.5, 4.0, 0.5, 0.5)]),
    "first": (9.0, 5.0, [(4.8, 1.0, 1.2, 0.2), (6.0, 3.0, 0.2, 2.0), (0.0, 0.0, 1.0, 1.0)]),
    "attic": (7.0, 7.0, [(5.2, 5.2, 0.4, 0.4), (0.0, 5.0, 3.0, 0.2), (5.0, 0.4, 0.2, 1.6)]),
}


def expect(condition, what):
    if not condition:
        sys.exit("failed: %s" % (what,))


def solids(name):
    width, depth, inside = FLOORS[name]
    wall = 0.2
    return inside + [(-wall, -wall, width + 2 * wall, wall), (-wall, depth, width + 2 * wall, wall), (-wall, 0.0, wall, depth), (width, 0.0, wall, depth)]


def draw(name, folder):
    """A map_server map; all lies on the lines between cells. Returns its cells as they are told, the bottom row first."""
    width, depth, _ = FLOORS[name]
    columns, rows = (round((side - 2 * ORIGIN) / CELL) for side in (width, depth))
    cells = [bytearray([UNKNOWN]) * columns for _ in range(rows)]

    def fill(x, y, w, d, value):
        x0, y0, x1, y1 = (round((edge - ORIGIN) / CELL) for edge in (x, y, x + w, y + d))
        for row in range(y0, y1):
            cells[row][x0:x1] = bytes([value]) * (x1 - x0)
    fill(0.0, 0.0, width, depth, FREE)
    for one in solids(name):
        fill(*one, OCCUPIED)
    (folder / (name + ".pgm")).write_bytes(b"P5\n%d %d\n255\n" % (columns, rows) + b"".join(reversed(cells)))
    (folder / (name + ".yaml")).write_text("image: %s.pgm\nresolution: %g\norigin: [%g, %g, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
                                           % (name, CELL, ORIGIN, ORIGIN))
    told = {OCCUPIED: 100, UNKNOWN: 255, FREE: 0}
    return {"size": (columns, rows), "data": [told[cell] for row in cells for cell in row]}


def distance(x, y, dx, dy, box):
    """From a place in a direction to a rectangle, infinity if it is not met."""
    near, far = 0.0, math.inf
    for at, way, low, size in ((x, dx, box[0], box[2]), (y, dy, box[1], box[3])):
        if abs(way) < 1e-12:
            if not low <= at <= low + size:
                return math.inf
            continue
        a, b = (low - at) / way, (low + size - at) / way
        near, far = max(near, min(a, b)), min(far, max(a, b))
    return near if near <= far else math.inf


CABIN = [(1.8, 1.0, 0.1, 3.0), (4.1, 1.0, 0.1, 3.0), (1.8, 1.0, 2.4, 0.1), (1.8, 3.9, 2.4, 0.1)]  # a lift whose door is closed


def scan_of(boxes, pose):
    x, y, theta = pose
    x, y = x + MOUNT * math.cos(theta), y + MOUNT * math.sin(theta)
    ranges = []
    for i in range(BEAMS):
        angle = theta + (i - BEAMS // 2) * STEP
        ranges.append("%.3f" % min(distance(x, y, math.cos(angle), math.sin(angle), box) for box in boxes))
    return ranges


def on_way(moment):
    """Where the robot is in its floor's frame: on a circle that is free on all floors."""
    turn = 0.5 * moment
    return 3.0 + 0.8 * math.sin(turn), 2.5 - 0.8 * math.cos(turn), math.remainder(turn, math.tau)


def beside(pose, first):
    """A pose in the frame of the first one, as odometry tells it."""
    dx, dy = pose[0] - first[0], pose[1] - first[1]
    cosine, sine = math.cos(first[2]), math.sin(first[2])
    return cosine * dx + sine * dy, cosine * dy - sine * dx, math.remainder(pose[2] - first[2], math.tau)


class Robot:
    """A robot that says its odometry and scans, and what it hears."""

    def __init__(self, environment):
        self.process = subprocess.Popen([peer, str(DOMAIN), str(PACE)], env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.listening = Listening(self.process.stdout)
        self.count, self.way, self.truth, self.best = 0, 0, {}, []
        self.looked = 0  # lines that drives have looked at
        self.is_answered = False  # whether the node has answered the last scan

    def say(self, *lines):
        self.process.stdin.write("\n".join(lines) + "\n")
        self.process.stdin.flush()

    def is_heard(self, words, since=0, timeout=LONGEST):
        """Whether a line that begins with these words is among those after the first so many, or comes in time."""
        return self.listening.waits_for(lambda line: line.split()[:len(words)] == list(words), since=since, timeout=timeout)

    def wait_for(self, *words, since=0):
        expect(self.is_heard(words, since), "the robot does not say %s" % (words,))

    def heard(self, since=0):
        return [line.split() for line in self.listening.since(since)]

    def scan(self, floor, stamp, pose):
        boxes = CABIN if floor == "cabin" else solids(floor)
        return "scan %d laser %r %r %g %d %s" % (stamp, -(BEAMS // 2) * STEP, STEP, FAR, BEAMS, " ".join(scan_of(boxes, pose)))

    def drive(self, floor, enough, what, stands=False):
        """Drives or stands on a floor, or in a cabin, until what was heard since the last drive is enough.

        While the node answers scans, the next one is said once it has answered the last one: however busy the machine is, the node is never
        behind. While it searches for the robot it answers none, and the robot keeps its pace."""
        begin = self.looked
        end = time.monotonic() + LONGEST
        while time.monotonic() < end:
            since = self.listening.count()
            self.count += 1
            self.way += not stands
            stamp = round((1000 + 0.1 * self.count) * 1e9)
            pose = on_way(0.1 * self.way)
            self.truth[stamp] = pose
            self.say("odom %d %r %r %r %s" % (stamp, *beside(pose, on_way(0.1)), "0 0" if stands else "0.4 0.5"), self.scan(floor, stamp, pose))
            self.wait_for("scanned", str(stamp), since=since)
            answers = self.is_heard(["diagnostics"], since, 2.0 if self.is_answered else 0.05)  # also one to an earlier scan
            self.is_answered = answers and self.is_heard(["diagnostics", str(stamp)], since, 2.0)
            words = self.heard(begin)
            if enough(words):
                self.looked = begin + len(words)
                return words
        sys.exit("failed: %s; heard last %s" % (what, self.heard()[-40:]))

    def check(self, words, since=0):
        """Poses, transforms and likelihoods are those of the robot in its floor's frame. Returns the number of poses."""
        poses, off = 0, []
        for kind, *rest in words:
            if kind == "pose" and int(rest[0]) >= since:
                expect(rest[1] == "map", rest)
                x, y, theta = self.truth[int(rest[0])]
                turned = math.remainder(2 * math.atan2(float(rest[4]), float(rest[5])) - theta, math.tau)
                off.append(max(math.hypot(float(rest[2]) - x, float(rest[3]) - y), abs(turned)))
                poses += 1
            if kind == "tf" and int(rest[0]) - 1_000_001_000 in self.truth and int(rest[0]) - 1_000_001_000 >= since:
                pose = self.truth[int(rest[0]) - 1_000_001_000]
                ox, oy, _ = beside(pose, on_way(0.1))
                turn = 2 * math.atan2(float(rest[5]), float(rest[6]))
                off.append(math.hypot(float(rest[3]) + math.cos(turn) * ox - math.sin(turn) * oy - pose[0],
                                      float(rest[4]) + math.sin(turn) * ox + math.cos(turn) * oy - pose[1]))
            if kind == "particles":
                expect(int(rest[1]) >= 10 and abs(float(rest[2]) - 1.0) < 1e-6, rest)
            if kind == "likelihood" and int(rest[0]) in self.truth and int(rest[0]) >= since:
                pose = self.truth[int(rest[0])]
                self.best.append(math.hypot(float(rest[4]) - pose[0], float(rest[5]) - pose[1]))
        expect(not off or max(off) < 0.2, "poses and transforms are off by up to %s" % max(off, default=0))
        self.worst = max(off, default=0.0)
        return poses


def count(words, kind):
    return sum(one[0] == kind for one in words)


class Services:
    def __init__(self):
        self.process = subprocess.Popen([client, str(DOMAIN)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def call(self, name, kind, request):
        self.process.stdin.write("call %s %s %s\n" % (name, kind, request.hex()))
        self.process.stdin.flush()
        words = self.process.stdout.readline().split()
        expect(words and words[0] == "answer", "%s has no answer" % name)
        return Reader(words[1])

    def load(self, url):
        """What load_map answers: the result, the map's size and its data."""
        reader = self.call("/map_server/load_map", "nav2_msgs/srv/LoadMap", Writer().text(url))
        reader.number("i"), reader.number("I")
        frame = reader.text()
        reader.number("i"), reader.number("I")
        resolution, width, height = reader.number("f"), reader.number("I"), reader.number("I")
        origin = [reader.number("d") for _ in range(7)]
        size = reader.number("I")
        data = list(reader.bytes[reader.at:reader.at + size])
        reader.at += size
        result = reader.number("B")
        reader.done()
        if result == 0:
            expect(frame == "map" and abs(resolution - CELL) < 1e-6 and origin == [ORIGIN, ORIGIN, 0, 0, 0, 0, 1], (frame, resolution, origin))
        return result, (width, height), data

    def end(self):
        self.process.stdin.close()
        expect(self.process.wait(timeout=30) == 0, "the client")


def told_map(drawn):
    """What the robot prints of a map that is told."""
    return ["map", *map(str, drawn["size"]), "%g" % CELL, "%g" % ORIGIN, "%g" % ORIGIN, str(drawn["data"].count(100)), str(drawn["data"].count(0))]


def is_on(name, poses=15):
    return lambda words: ["floor", name] in words and count(words, "pose") >= poses


def check_likelihoods(robot, floor):
    """Likelihoods, at most one a second, are in the floor's frame. They are those at the heading of the estimate, which has to be a good one."""
    robot.best, since = [], max(robot.truth) + 1
    words = robot.drive(floor, lambda words: sum(one[0] == "likelihood" and int(one[1]) >= since for one in words) >= 2, "likelihoods")
    robot.check(words, since)
    expect(len(robot.best) >= 2 and max(robot.best) < 0.3, "the best likelihoods are %s m beside the robot" % robot.best)
    print("%s: the best likelihoods are at most %.3f m beside the truth" % (floor, max(robot.best)))


def visit(robot, services, maps, folder):
    # It stands on the first floor, and nobody says so.
    words = robot.drive("first", lambda words: is_on("first")(words) and told_map(maps["first"]) in robot.heard(), "found on the first floor")
    expect(robot.check(words) >= 15, "poses")
    heard = robot.heard()
    # At first the ground floor's map is told, which who comes late does not hear.
    of_maps = [one for one in heard if one[0] == "map"]
    expect(of_maps in ([told_map(maps["first"])], [told_map(maps["ground"]), told_map(maps["first"])]), of_maps)
    expect(["diagnosed", "floor", "first"] in heard, "diagnostics name the floor")
    print("found on the first floor, at most %.3f m beside the truth" % robot.worst)
    # A pose that somebody knows is one on this floor.
    robot.say("initial %r %r %r" % on_way(0.1 * (robot.way + 1)))
    words = robot.drive("first", lambda words: count(words, "pose") >= 10, "poses after an initial pose")
    robot.check(words)
    expect(["floor", "ground"] not in words, "an initial pose is one on the present floor")
    check_likelihoods(robot, "first")

    # A floor is named, by its name or by its map.
    for floor, url in (("ground", "ground"), ("first", "file://%s" % (folder / "first.yaml")), ("ground", str(folder / "maps" / ".." / "ground.yaml"))):
        result, size, data = services.load(url)
        expect((result, size) == (0, maps[floor]["size"]) and data == maps[floor]["data"], "%s: %s, %s" % (url, result, size))
        since = max(robot.truth) + 1
        words = robot.drive(floor, lambda words, floor=floor: is_on(floor, 10)(words) and told_map(maps[floor]) in words, "on the floor %s" % floor)
        robot.check(words, since)
        print("%s: at most %.3f m beside the truth" % (url.split("/")[-1], robot.worst))
    check_likelihoods(robot, "ground")

    # What is no map of the building.
    (folder / "none.yaml").write_text("resolution: many\n")
    (folder / "torn.yaml").write_text((folder / "ground.yaml").read_text().replace("ground.pgm", "torn.pgm"))
    (folder / "torn.pgm").write_bytes((folder / "ground.pgm").read_bytes()[:1000])
    for url, expected in ((folder / "nowhere.yaml", 1), ("", 1), ("a\nb", 1), ("m" * 5000, 1), (folder, 1), ("/dev/zero", 1), ("package://maps/first.yaml", 1),
                          (folder / "none.yaml", 3), (folder / "torn.yaml", 2)):
        result, size, data = services.load(str(url))
        expect((result, size, data) == (expected, (0, 0), []), "%s: %s, expected %s" % (url, result, expected))
    words = robot.drive("ground", lambda words: count(words, "pose") >= 5, "as before")
    robot.check(words)

    # A map of another building, and back. Until the new one is in force, the robot is still where it was.
    result, size, data = services.load(str(folder / "attic.yaml"))
    expect((result, size) == (0, maps["attic"]["size"]) and data == maps["attic"]["data"], (result, size))
    robot.drive("ground", lambda words: told_map(maps["attic"]) in words, "the map of the attic")
    words = robot.drive("attic", lambda words: count(words, "pose") >= 10, "poses in the attic")
    robot.check(words)
    check_likelihoods(robot, "attic")
    expect(services.load("first")[0] == 0, "back in the building")
    robot.drive("attic", lambda words: told_map(maps["first"]) in words and ["floor", "first"] in words, "the first floor's map")
    words = robot.drive("first", lambda words: count(words, "pose") >= 10, "poses on the first floor")
    robot.check(words)


def doubt(robot, services, maps, folder):
    # Two floors that look the same: nobody can tell, so no pose is told, and diagnostics say how the belief is shared.
    words = robot.drive("first", lambda words: count(words, "diagnosed") >= 10, "diagnostics")
    expect(not any(one[0] in ("pose", "floor", "tf") for one in words), "a pose, though the floor is open")
    shares = [one[2:] for one in words if one[:2] == ["diagnosed", "floors"]]
    expect(shares and all(one[0] == "second" and one[2] == "third" for one in shares), shares)
    expect(any("which floor is open" in " ".join(one) for one in words if one[0] == "diagnostics"), "the message says it")
    expect(services.load("third")[0] == 0, "somebody knows it")
    words = robot.drive("first", is_on("third", 10), "on the third floor")
    robot.check(words)
    words = robot.drive("first", lambda words: count(words, "pose") >= 10, "on the third floor for good")
    expect(not any(one[:2] in (["diagnosed", "floors"], ["floor", "second"]) for one in words), "it is settled")
    # The same while it is searched for: the floor is taken once there are places.
    services.call("/reinitialize_global_localization", "std_srvs/srv/Empty", Writer().number("B", 0))
    expect(services.load("third")[0] == 0, "somebody knows it at once")
    words = robot.drive("first", lambda words: count(words, "pose") >= 10, "on the third floor anew")
    robot.check(words)
    expect(not any(one[:2] == ["diagnosed", "floors"] for one in words[-20:]), "it is settled again")
    print("between two floors that look the same: %s; then at most %.3f m beside the truth" % (" ".join(shares[-1]), robot.worst))


def ride(robot, services, maps, folder):
    # By lift, and nobody says so.
    words = robot.drive("ground", is_on("ground"), "found on the ground floor")
    robot.check(words)
    begin = robot.count
    words = robot.drive("cabin", lambda words: robot.count == begin + 100, "ten seconds behind the door", stands=True)
    expect(not any(one == ["floor", "first"] for one in words), "a floor that nothing shows")
    expect(any(one[:2] == ["diagnosed", "floors"] for one in words), "behind the door it is open which floor it is")
    opened = max(robot.truth)
    words = robot.drive("first", is_on("first", 0), "the first floor, seen through the open door", stands=True)
    print("a ride in a lift: on the first floor %.1f s after the door has opened" % ((max(robot.truth) - opened) / 1e9))
    since = max(robot.truth) + 1
    words = robot.drive("first", lambda words: count(words, "pose") >= 15 and told_map(maps["first"]) in robot.heard(), "poses on the first floor")
    robot.check(words, since)


def follow_the_page(robot, services, maps, folder):
    words = robot.drive("first", is_on("first", 5), "found on the first floor of the page's building")
    robot.check(words)
    expect(services.load("ground")[0] == 0, "the ground floor")
    words = robot.drive("ground", is_on("ground", 5), "on the ground floor")
    robot.check(words)


def run(folder, maps, words, what):
    """Runs a node in a building, and a robot that does something. Returns what the node says."""
    environment = {**os.environ, "ROS_DOMAIN_ID": str(DOMAIN), "ROS_LOCALHOST_ONLY": "1", "HOME": str(folder), "ROS_DISTRO": "humble",
                   "CYCLONEDDS_URI": '<General><Interfaces><NetworkInterface name="lo" multicast="true"/></Interfaces>'
                                     "<AllowMulticast>true</AllowMulticast></General>"}
    running = subprocess.Popen([node, "--base-frame", "base_link", *words, "--folder", folder / "cache"], env=environment, cwd=folder,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    robot, services = Robot(environment), Services()
    try:
        robot.say("static base_link laser %g 0 0" % MOUNT, "sample " + robot.scan("first", 10**12, on_way(0.0)), "ready")
        robot.wait_for("matched")
        what(robot, services, maps, folder)
        robot.process.stdin.close()
        expect(robot.process.wait(timeout=60) == 0, "the robot")
        services.end()
    finally:
        running.send_signal(signal.SIGTERM)
        said = running.communicate(timeout=30)[0]
        robot.process.kill()
        services.process.kill()
        if log := os.environ.get("FLOORS_TEST_HEARD"):
            pathlib.Path(log).write_text("\n".join(robot.listening.lines) + "\n" + said)
    expect(running.returncode == 0, said)
    return said


def main():
    with tempfile.TemporaryDirectory(prefix="ortung-floors-") as name:
        folder = pathlib.Path(name)
        (folder / "maps").mkdir()
        maps = {floor: draw(floor, folder) for floor in FLOORS}
        run(folder, maps, ["--floor", "second=first.yaml", "--floor", "third=first.yaml"], doubt)
        page = (pathlib.Path(__file__).parents[2] / "docs/ros2.md").read_text()
        [building] = [text for text in re.findall(r"```toml\n(.*?)```", page, re.S) if "[[floor]]" in text]
        (folder / "building.toml").write_text(building)
        run(folder, maps, ["--world", "building.toml"], follow_the_page)
        run(folder, maps, ["--floor", "ground=ground.yaml", "--floor", "first=first.yaml", "--lift", "east=3.0,2.5,1.3"], ride)
        said = run(folder, maps, ["--floor", "ground=ground.yaml", "--floor", "first=first.yaml", "--lift", "east=3.0,2.5,1.5"], visit)
        floors = [line.rsplit(" ", 1)[1] for line in said.splitlines() if "is on floor" in line]
        expect(floors == ["first", "ground", "first", "ground", "first"], said)
        expect(said.count("another map") == 2, said)
        for wrong, words in ((["--floor", "ground"], "expected NAME=MAP"), (["--floor", "a b=x.yaml"], "NAME is of"),
                             (["--floor", "a=x.yaml", "--lift", "l=1"], "expected NAME=X,Y"), (["--floor", "a=x.yaml", "--floor", "a=y.yaml"], "another name"),
                             (["--floor", "a=x.yaml", "--world", "w.toml"], "excludes")):
            bad = subprocess.run([node, *wrong], capture_output=True, text=True)
            expect(bad.returncode == 2 and words in bad.stderr, "%s: %s" % (wrong, bad))


main()
