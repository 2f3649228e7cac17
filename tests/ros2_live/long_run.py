#!/usr/bin/env python3
"""long_run.py [--minutes 5] BIN  a robot of a simulation as a robot of ROS 2, localized by its map, is driven about for minutes, or an
hour: can a subscriber look up map -> base at the stamp of each message, as tf2 does, without extrapolation? Does the robot step in the map
without a relocalization that is told? BIN is the folder of the programs, those of the tests among them (build/dev/bin). No test runs this,
since it is long; it ends with 1 if a look-up fails, or at a step that was not told."""
import argparse
import collections
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import robots

KINDS = ("odom", "scan", "truth")
AHEAD = 1_000_000_000  # how far transforms are ahead of odometry, as the localizer does by itself [ns]
STEP = 0.10  # [m]
BEFORE, AFTER = 500_000_000, 50_000_000  # a relocalization is told so long before its step, or after it, since topics have no common order [ns]


class Steps:
    """How far the robot moves in the map from one map -> odom to the next, where it does not move in odometry; who told of it, and when."""

    def __init__(self):
        self.last, self.count = None, None
        self.steps, self.told = [], []  # (clock, metres, degrees), (clock, cause)
        self.most = (0.0, 0.0)

    def take_transform(self, clock, odom_in_map, base_in_odom):
        if self.last is not None:
            before, after = robots.times(self.last, base_in_odom), robots.times(odom_in_map, base_in_odom)
            metres = math.hypot(after[0] - before[0], after[1] - before[1])
            turn = math.degrees(abs(math.remainder(after[2] - before[2], math.tau)))
            if metres > STEP:
                self.steps.append((clock, metres, turn))
            else:
                self.most = (max(self.most[0], metres), max(self.most[1], turn))
        self.last = odom_in_map

    def take_diagnostics(self, clock, count, cause):
        if self.count is not None and count != self.count:
            self.told.append((clock, cause))
        self.count = count

    def report(self):
        untold = [step for step in self.steps if not any(-AFTER <= step[0] - told[0] <= BEFORE for told in self.told)]
        print("steps above %.2f m: %d, %d of them without a relocalization that was told; the largest of the others %.3f m, %.2f degrees" % (
            STEP, len(self.steps), len(untold), *self.most))
        for clock, metres, turn in untold:
            print("  %.3f m and %.2f degrees at %.3f s" % (metres, turn, clock / 1e9))
        for cause, count in collections.Counter(cause for _, cause in self.told).most_common():
            print("told %d times: %s" % (count, cause))
        return not untold


class LookUps:
    """Look-ups of map -> base at the stamps of messages, when they come; those that can't be answered yet wait for frames."""

    def __init__(self):
        self.frames = {"odom": robots.Transforms(), "base_link": robots.Transforms()}
        self.waiting, self.off = [], []
        self.at_once, self.later, self.before = ({kind: 0 for kind in KINDS} for _ in range(3))
        self.clock, self.longest = 0, 0
        self.steps = Steps()
        self.newest, self.ages, self.old = None, 0, []  # stamp of odometry; how often a transform's age was looked at; those too old

    def pose(self, stamp):
        poses = [self.frames[name].at(stamp) for name in ("odom", "base_link")]
        return robots.times(*poses) if all(poses) else None

    def found(self, kind, stamp, words):
        pose = self.pose(stamp)
        if pose is None:
            return False
        if kind == "truth":
            true = robots.pose_of(words[3:])
            self.off.append(((pose[0] - true[0])**2 + (pose[1] - true[1])**2)**0.5)
        return True

    def look_at_age(self, stamp):
        """When odometry comes, the transform of the one before has come."""
        told = self.frames["odom"].stamps
        if told and self.newest is not None and stamp > self.newest:
            self.ages += 1
            if told[-1] - AHEAD < self.newest:
                self.old.append(stamp - (told[-1] - AHEAD))
        self.newest = stamp

    def take(self, words):
        kind = words[0]
        if kind == "clock":
            self.clock = int(words[1])
        elif kind == "tf":
            pose, base = robots.pose_of(words[4:]), self.frames["base_link"].poses
            self.frames[words[3]].add(int(words[1]), pose)
            if words[3] == "odom" and base:
                self.steps.take_transform(self.clock, pose, base[-1])
            for entry in [entry for entry in self.waiting if self.found(*entry[:3])]:
                self.waiting.remove(entry)
                self.later[entry[0]] += 1
                self.longest = max(self.longest, self.clock - entry[3])
        elif kind == "diagnostics" and words[2] == "amcl":
            self.steps.take_diagnostics(self.clock, int(words[4]), " ".join(words[5:]))
        elif kind in KINDS:
            if kind == "odom":
                self.look_at_age(int(words[1]))
            stamp, in_map = int(words[1]), self.frames["odom"].stamps
            if not in_map or stamp < in_map[0]:
                self.before[kind] += 1  # nothing is told before the robot is found
            elif self.found(kind, stamp, words):
                self.at_once[kind] += 1
            else:
                self.waiting.append((kind, stamp, words, self.clock))

    def report(self):
        end = self.frames["base_link"].stamps[-1]
        never = [entry for entry in self.waiting if entry[1] < end]
        for kind in KINDS:
            print("%-5s  before it was found %d, at once %d, once frames had come %d, never %d" % (
                kind, self.before[kind], self.at_once[kind], self.later[kind], sum(entry[0] == kind for entry in never)))
        self.off.sort()
        print("the longest wait for frames: %.3f s of the robot's time" % (self.longest / 1e9))
        print("transforms older than odometry's period: %d of %d, the oldest by %.3f s" % (
            len(self.old), self.ages, max(self.old, default=0) / 1e9))
        told = self.steps.report()
        if self.off:
            print("map -> base beside the truth: median %.3f m, p95 %.3f m, most %.3f m of %d" % (
                self.off[len(self.off) // 2], self.off[int(0.95 * len(self.off))], self.off[-1], len(self.off)))
        return not never and told and bool(self.off)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=5.0)
    parser.add_argument("bin", type=pathlib.Path)
    a = parser.parse_args()
    programs = {name: a.bin / name for name in ("ortung", "ortung-ros2", "ortung-ros2-robot", "cyclone_driver")}
    domain = 226 + os.getpid() % 7
    looks = LookUps()
    with tempfile.TemporaryDirectory(prefix="ortung-long-run-") as name:
        folder = pathlib.Path(name)
        (folder / "rover.toml").write_text(robots.ROBOT)
        variables = robots.environment(folder, domain)
        with robots.running([programs["ortung"], "sim", robots.ARENA, "--listen", "0", "--seed", "3"], variables) as sim:
            bridge = [programs["ortung-ros2-robot"], "--connect", "127.0.0.1:%d" % robots.port_of(sim), "--robot", folder / "rover.toml",
                      "--start", "-2.3,0.2,0", "--ground-truth", "--distro", "jazzy"]
            with robots.running(bridge, variables), robots.running(
                    [programs["ortung-ros2"], "--base-frame", "base_link", "--folder", folder / "learned", "--distro", "jazzy"], variables) as localizer:
                robots.wait_for_line(localizer, "localizing")
                with subprocess.Popen([programs["cyclone_driver"], str(domain), "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                      env=variables) as driver:
                    driver.stdin.write("wander %g\n" % (60 * a.minutes))
                    driver.stdin.close()
                    for line in driver.stdout:
                        looks.take(line.split())
        print(*localizer.said, sep="", end="")
    sys.exit(0 if looks.report() else 1)


main()
