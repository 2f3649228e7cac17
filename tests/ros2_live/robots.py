"""Robots of a simulation as robots of ROS 2, who drives them, and what that one hears: for tests."""
import collections
import contextlib
import math
import os
import pathlib
import re
import socket
import subprocess

ROBOT = """
[robot]
name = "rover"
radius_m = 0.2
[drive]
max_speed_m_s = 0.5
max_turn_deg_s = 90
acceleration_m_s2 = 1.0
turn_acceleration_deg_s2 = 360
odometry_distance_sigma_m = 0.02
odometry_heading_sigma_deg = 1.0
odometry_turn_sigma_deg = 4.0
[[sensor]]
plugin = "odometry"
period_s = 0.02
[[sensor]]
plugin = "lrf"
model = "laser"
type = "LRF"
feature = "front"
pose = { x_m = 0.1, y_m = 0.0, z_m = 0.3, theta_deg = 0 }
period_s = 0.1
beams = 181
fov_deg = 180
max_range_m = 5.0
noise_sigma_m = 0.02
sigma_m = 0.05
[[sensor]]
plugin = "sonar"
model = "sonar"
type = "ultrasonic"
feature = "sonar"
pose = { z_m = 0.25 }
ring_radius_m = 0.2
angles_deg = [0, 90]
opening_deg = 20
max_range_m = 4.0
period_s = 0.2
"""
ROOT = pathlib.Path(__file__).resolve().parents[2]
ARENA = ROOT / "maps/fields/arena.toml"


def expect(condition, what):
    if not condition:
        raise SystemExit("failed: " + what)


def environment(folder, domain):
    return {**os.environ, "ROS_DOMAIN_ID": str(domain), "ROS_LOCALHOST_ONLY": "1", "HOME": str(folder),
            "CYCLONEDDS_URI": '<General><Interfaces><NetworkInterface name="lo" multicast="true"/></Interfaces>'
                              "<AllowMulticast>true</AllowMulticast></General>"}


@contextlib.contextmanager
def running(words, variables, ends_with=(0,)):
    """A program that is told to end, and what it says in `said`, once it has ended."""
    process = subprocess.Popen([str(word) for word in words], env=variables, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    process.said = None
    try:
        yield process
    finally:
        if process.poll() is None:
            process.terminate()
        try:
            process.said = process.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
    expect(process.returncode in ends_with, "%s ends with %s: %s" % (words[0], process.returncode, process.said))


def port_of(simulation):
    line = simulation.stdout.readline()
    found = re.search(r"listening on \S+ port (\d+)", line)
    expect(found, "the simulation says '%s', expected its port" % line)
    return int(found.group(1))


def wait_for_line(process, text):
    """Reads what a program says until it says a line with a text."""
    for line in process.stdout:
        if text in line:
            return line
    raise SystemExit("failed: a program has ended without '%s': %s" % (text, process.stderr.read()))


class Board:
    """A client of the simulation's own protocol."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=60)
        self.lines = self.socket.makefile("r", newline="\n")
        self.ask("HELLO ortung/1 name=desk role=operator")

    def ask(self, request):
        self.socket.sendall((request + "\n").encode())
        reply = self.lines.readline().strip()
        expect(reply.startswith("OK"), "%s: %s" % (request, reply))
        return reply


def drive(driver, domain, space, lines, variables, *kind):
    """What the driver hears: {what: [words]}, in the order in which it came as "all"."""
    done = subprocess.run([str(driver), str(domain), space, *kind], input="\n".join(lines) + "\n",
                          env=variables, capture_output=True, text=True)
    expect(done.returncode == 0, "the driver: %s\n%s" % (done.stderr, done.stdout[-2000:]))
    heard = collections.defaultdict(list)
    for line in done.stdout.splitlines():
        words = line.split()
        heard[words[0]].append(words[1:])
        heard["all"].append(words)
    return heard


def pose_of(words):
    return tuple(float(word) for word in words)


def times(outer, inner):
    """The pose `inner`, which is in the frame `outer`, beside that frame."""
    x, y, theta = outer
    return (x + math.cos(theta) * inner[0] - math.sin(theta) * inner[1],
            y + math.sin(theta) * inner[0] + math.cos(theta) * inner[1], math.remainder(theta + inner[2], math.tau))


class Transforms:
    """Poses of a frame in its parent, by time [ns], between which it interpolates, as tf2 does."""

    def __init__(self):
        self.stamps, self.poses = [], []

    def add(self, stamp, pose):
        if not self.stamps or stamp > self.stamps[-1]:
            self.stamps.append(stamp)
            self.poses.append(pose)

    def at(self, stamp):
        """The pose, or None where it would have to extrapolate."""
        import bisect
        after = bisect.bisect_left(self.stamps, stamp)
        if after < len(self.stamps) and self.stamps[after] == stamp:
            return self.poses[after]
        if after in (0, len(self.stamps)):
            return None
        a, b = self.poses[after - 1], self.poses[after]
        share = (stamp - self.stamps[after - 1]) / (self.stamps[after] - self.stamps[after - 1])
        return (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * math.remainder(b[2] - a[2], math.tau))
