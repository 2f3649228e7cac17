#!/usr/bin/env python3
"""robot_test.py ORTUNG ORTUNG_ROS2 ORTUNG_ROS2_ROBOT DRIVER  robots of a simulation as robots of ROS 2: a program on Cyclone DDS, which
knows nothing of ours, drives them, and what it hears is what it has commanded, and what Ortung itself records. Localized by the map
alone, the robot is where its frames say."""
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import robots
from robots import expect

ortung, localizer, bridge, driver = map(pathlib.Path, sys.argv[1:])
DOMAIN = 81 + os.getpid() % 20  # each test has domains of its own
OFFSET = 2**31
PERIOD = 20_000_000  # of odometry [ns]


def robot(port, folder, *more):
    return [bridge, "--connect", "127.0.0.1:%d" % port, "--robot", folder / "rover.toml", *more]


def check_commands(heard, v, w):
    """While the robot obeys, odometry's pose goes as far as the velocity does, whose value was commanded."""
    odometry = [(int(stamp), *robots.pose_of(rest)) for stamp, _, _, *rest in heard["odom"]]
    seconds = 0.0
    for (t0, x0, y0, a0, v0, w0), (t1, x1, y1, a1, v1, w1) in zip(odometry, odometry[1:]):
        if t1 - t0 > 2 * PERIOD or max(abs(v0 - v), abs(v1 - v)) > 0.001 or max(abs(w0 - w), abs(w1 - w)) > 0.001:
            continue
        moved, turned, dt = ((x1 - x0)**2 + (y1 - y0)**2)**0.5, abs(robots.math.remainder(a1 - a0, robots.math.tau)), (t1 - t0) / 1e9
        # Odometry has millimetres and hundredths of a degree.
        expect(abs(moved - abs(v) * dt) < 0.003, "%g m in %g s at %g m/s" % (moved, dt, v))
        expect(abs(turned - abs(w) * dt) < 0.0006, "%g rad in %g s at %g rad/s" % (turned, dt, w))
        seconds += dt
    expect(seconds > 0.5, "the robot has obeyed %g m/s, %g rad/s for %g s" % (v, w, seconds))
    return seconds


def check_watchdog(heard):
    """The robot goes on for half a second after the last command, and no longer."""
    newest, last, checked = {}, None, 0
    for words in heard["all"]:
        if words[0] == "told":
            last = (int(words[1]), float(words[2])) if float(words[2]) == newest.get("v") else None
        elif words[0] == "odom":
            newest = {"v": float(words[7])}
            if last and last[1] > 0 and newest["v"] < last[1] - 0.001:
                expect(int(words[1]) - last[0] >= 500_000_000, "it brakes %g s after the last command" % ((int(words[1]) - last[0]) / 1e9))
                checked, last = checked + 1, None
    expect(checked >= 1, "no braking was seen")


def words_of(record, feature):
    return {int(line.split()[0]) * 1000: [int(word) for word in line.split()[3:]] for line in record.splitlines()
            if line.split()[1:2] == [feature]}


def in_words(text, most):
    value = float(text)
    return 0 if value != value else None if value > most else round(value * 1000)


def check_readings(heard, record):
    """Scans and ranges are those that Ortung has recorded."""
    for kind, feature, most, begin in (("scan", "laser/LRF/front", 5.0, 6), ("range", "sonar/ultrasonic/sonar0", 4.0, 5)):
        recorded = words_of(record, feature)
        same = 0
        for words in heard[kind]:
            if int(words[0]) not in recorded:
                continue
            ranges = words[begin:] if kind == "scan" else [words[begin]]
            told = [in_words(text, most) for text in ranges]
            expect(told == [None if word / 1000 >= most else word for word in recorded[int(words[0])]],
                   "%s at %s: %s, recorded %s" % (kind, words[0], told, recorded[int(words[0])]))
            same += 1
        print("%d of %d %ss are those of the record" % (same, len(heard[kind]), kind))
        expect(same > 0.5 * len(recorded), "%d of %d recorded %ss were heard" % (same, len(recorded), kind))
    expect(all(words[1:4] == ["sonar_sonar0", "0", "0.34906584"] and words[4] == "4" and words[6] == "0" for words in heard["range"]),
           "a range is %s" % heard["range"][0])


def check_frames(heard, base="base_link"):
    odometry = {words[0]: robots.pose_of(words[3:6]) for words in heard["odom"]}
    frames = [words for words in heard["tf"] if words[1:3] == ["odom", base]]
    expect(len(frames) == len(heard["tf"]) and frames, "frames %s" % heard["tf"][:1])
    for stamp, _, _, *pose in frames:
        told = odometry.get(stamp, robots.pose_of(pose))
        off = max(abs(a - b) for a, b in zip(told, robots.pose_of(pose)))
        expect(off < 1e-12, "odom -> base at %s is %s, odometry %s" % (stamp, pose, told))
    mounts = {words[2]: words[3:] for words in heard["static"]}
    expect([words[1] for words in heard["static"]] == [base] * 3 and robots.pose_of(mounts["laser_front"])[0] == 0.1, "mounts %s" % mounts)
    [[frame, cell, width, height, x, y, occupied]] = heard["map"]
    # The arena is 6 m x 4 m, with half a metre around it.
    expect((frame, cell, width, height, x, y) == ("map", "0.0500000007", "140", "100", "-3.5", "-2.5") and int(occupied) > 400,
           "a map %s" % heard["map"])
    clock = [int(words[0]) for words in heard["clock"]]
    expect(clock == sorted(set(clock)) and len(clock) > 100, "a clock that goes on")


def check_truth(heard):
    """Without noise odometry is right: the robot has moved as far in the field."""
    truth = {words[0]: robots.pose_of(words[2:]) for words in heard["truth"]}
    both = [(robots.pose_of(words[3:6]), truth[words[0]]) for words in heard["odom"] if words[0] in truth]
    (odom0, true0), off = both[0], []
    for odom, true in both[1:]:
        far = [((a[0] - b[0])**2 + (a[1] - b[1])**2)**0.5 for a, b in ((odom, odom0), (true, true0))]
        off.append(abs(far[0] - far[1]))
    expect(len(off) > 50 and max(off) < 0.01, "odometry is %g m beside the truth" % max(off))


def test_driving(folder):
    variables = robots.environment(folder, DOMAIN)
    simulation = [ortung, "sim", robots.ARENA, "--listen", "0", "--no-noise", "--idle", "600", "--allow-control", "all",
                  "--record-into", folder / "records"]
    (folder / "records").mkdir()
    with robots.running(simulation, variables) as sim:
        port = robots.port_of(sim)
        first = robot(port, folder, "--start", "-2.3,0.2,0", "--ground-truth", "--distro", "jazzy")
        with robots.running(first, variables) as one:
            robots.wait_for_line(one, "obeys /cmd_vel")
            board = robots.Board(port)
            board.ask("RECORD robot=1 on")
            heard = robots.drive(driver, DOMAIN, "-", ["drive 0.4 0 1.5", "rest", "drive 0 -0.5 1.0", "rest", "once nan 0", "hear 0.7",
                                                       "once 50 0", "hear 0.4", "rest"], variables)
            board.ask("RECORD robot=1 off")
            second = robot(port, folder, "--name", "two", "--start", "1,0.6,90", "--namespace", "/two", "--frame-prefix", "two/", "--stamped",
                           "--no-clock", "--max-linear", "0.2")
            with robots.running(second, variables) as two:
                robots.wait_for_line(two, "obeys /two/cmd_vel")
                other = robots.drive(driver, DOMAIN, "/two", ["drive 0.3 0 0.3", "rest"], variables, "stamped")
        said = one.said[1]
    print("obeyed for %.1f s and %.1f s" % (check_commands(heard, 0.4, 0.0), check_commands(heard, 0.0, -0.5)))
    check_watchdog(heard)
    record = folder / "records" / "robot-1.rec"
    check_readings(heard, subprocess.run(["zstdcat", "-f", record], check=True, capture_output=True, text=True).stdout)
    check_frames(heard)
    check_truth(heard)
    expect(max(float(words[6]) for words in heard["odom"]) <= 0.5, "it is no faster than its drive")
    expect("a velocity that is no number: 1 times" in said and "more than the robot can do, which is cut: 1 times" in said, said)
    expect({words[1] + ">" + words[2] for words in other["odom"]} == {"two/odom>two/base_link"}, "frames of the second robot")
    check_commands(other, 0.2, 0.0)


def test_localization(folder):
    """The localizer in the same domain, which knows no more than what the robot tells."""
    variables = robots.environment(folder, DOMAIN)
    with robots.running([ortung, "sim", robots.ARENA, "--listen", "0", "--seed", "3"], variables) as sim:
        with robots.running(robot(robots.port_of(sim), folder, "--start", "-2.3,0.2,0", "--ground-truth", "--distro", "jazzy"), variables) as one:
            robots.wait_for_line(one, "obeys /cmd_vel")
            with robots.running([localizer, "--base-frame", "base_link", "--folder", folder / "learned", "--distro", "jazzy"], variables) as mcl:
                robots.wait_for_line(mcl, "localizing")
                heard = robots.drive(driver, DOMAIN, "-", ["wander 30"], variables)
    frames = {"odom": robots.Transforms(), "base_link": robots.Transforms()}
    for stamp, _, child, *pose in heard["tf"]:
        frames[child].add(int(stamp), robots.pose_of(pose))
    off = []
    for stamp, _, *true in heard["truth"]:
        inMap, inOdometry = (frames[name].at(int(stamp)) for name in ("odom", "base_link"))
        if inMap and inOdometry:
            x, y, _ = robots.times(inMap, inOdometry)
            off.append(((x - float(true[0]))**2 + (y - float(true[1]))**2)**0.5)
    expect(len(off) > 0.5 * len(heard["truth"]), "%d of %d poses can be looked up" % (len(off), len(heard["truth"])))
    off.sort()
    print("map -> base beside the truth: median %.3f m, p95 %.3f m of %d" % (statistics.median(off), off[int(0.95 * len(off))], len(off)))
    expect(statistics.median(off) < 0.1, "the median is %g m" % statistics.median(off))


def test_running_robot(folder):
    """A robot with devices, which a program emulates: its time is that of the day, it has no world, and it permits its client to drive it.
    Whether wheels turn is for the tests of devices: emulated ones follow no commands."""
    variables = robots.environment(folder, DOMAIN)
    device = 'device = { plugin = "base", port = "/dev/base" }\n'
    head, odometry, _, sonar = robots.ROBOT.split("[[sensor]]")
    (folder / "base.toml").write_text("[[sensor]]".join([head, odometry + device, sonar + device]))
    devices = ["--robot", folder / "base.toml", "--world", robots.ARENA, "--dev", folder / "dev"]
    running = [ortung, "robot", folder / "base.toml", "--dev", folder / "dev", "--listen", "0", "--allow-control", "ros", "--duration", "600"]
    with robots.running([ortung, "emulate", *devices], variables), robots.running(running, variables) as served:
        port = robots.port_of(served)
        with robots.running([bridge, "--connect", "127.0.0.1:%d" % port, "--name", "ros", "--distro", "jazzy"], variables) as one:
            robots.wait_for_line(one, "obeys /cmd_vel")
            begin = time.time()
            heard = robots.drive(driver, DOMAIN, "-", ["once 0.1 0", "hear 4", "once 0 0", "hear 0.2"], variables, "real")
    expect(one.said[1] == "", "it complains: %s" % one.said[1])
    expect(not heard["clock"] and not heard["map"], "a clock and a map of nobody")
    stamps = [int(words[0]) for words in heard["odom"]]
    expect(len(stamps) > 10 and stamps == sorted(stamps) and abs(stamps[0] / 1e9 - begin) < 3600, "stamps of the day: %s" % stamps[:3])
    expect(heard["range"] and len({words[0] for words in heard["tf"]} & {words[0] for words in heard["odom"]}) > 10, "frames and ranges")
    print("a running robot tells %d odometries, %d ranges" % (len(stamps), len(heard["range"])))


def main():
    with tempfile.TemporaryDirectory(prefix="ortung-ros2-robot-") as name:
        folder = pathlib.Path(name)
        (folder / "rover.toml").write_text(robots.ROBOT)
        test_driving(folder)
        test_localization(folder)
        test_running_robot(folder)


main()
