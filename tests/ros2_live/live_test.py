#!/usr/bin/env python3
"""live_test.py ORTUNG ORTUNG_ROS2 PEER CLIENT DATA  a robot of ROS 2 that knows nothing of ours, a program on Cyclone DDS with types of its own
generator, says what a real log has, and hears from ortung-ros2 where it is: the same poses, bit by bit, as `ortung localize` finds in the log."""
import json
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

from cdr import Writer
from listening import Listening

ortung, node, peer, client, data = map(pathlib.Path, sys.argv[1:])
LOG = data / "mrpt_uwb_ro"
if not LOG.is_dir():
    print('live_test.py: Skipped\n"%s" is not here' % LOG)
    sys.exit(77)
SECONDS, PACE, FIRST_ONES = 40.0, 8.0, 10
HERE = pathlib.Path(__file__).parent
OFFSET = 2**31


def expect(condition, what):
    if not condition:
        sys.exit("failed: " + what)


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    expect(done.returncode == 0, "%s\n%s" % (words, done.stderr))
    return done.stdout


def lines_of(record, robot):
    """What the robot says of a record: its mount, odometry and scans."""
    mount = re.search(r'plugin = "lrf".*?x_m = ([-0-9.e]+), y_m = ([-0-9.e]+), theta_deg = ([-0-9.e]+)', robot, re.S).groups()
    beams = dict(word.split("=") for word in re.search(r"(?m)^# format laser/LRF/scan scan (.*)$", record).group(1).split())
    first, step, most = math.radians(float(beams["first_deg"])), math.radians(float(beams["step_deg"])), float(beams["max_m"])
    lines = ["static base_link laser %s %s %r" % (*mount[:2], math.radians(float(mount[2])))]
    begin = None
    for line in record.splitlines():
        words = line.split()
        if line.startswith("#"):
            continue
        stamp = int(words[0])
        begin = stamp if begin is None else begin
        if stamp - begin > SECONDS * 1e6:
            break
        numbers = [int(word) for word in words[3:]]
        if words[1] == "odometry/odometry/pose":
            x, y, v = ((numbers[i] - OFFSET) / 1e3 for i in (0, 1, 3))
            turn = (numbers[4] - OFFSET) * RATE
            lines.append("odom %d %r %r %r %r %r" % (stamp * 1000, x, y, math.radians((numbers[2] - 18000) / 100), v, turn))
        elif words[1] == "laser/LRF/scan":
            ranges = ["nan" if n == 0 else "inf" if n > 1000 * most else repr(n / 1e3) for n in numbers]
            lines.append("scan %d laser %r %r %r %d %s" % (stamp * 1000, first, step, most, len(ranges), " ".join(ranges)))
    return lines


def in_step(lines, expected):
    """The same lines, which go on once the pose of a scan was heard that has one: however busy the machine is, the localizer is not behind.
    A search for the robot goes on with each reading, so nothing waits for the first pose."""
    stamps, newest, awaited, out = {us * 1000 for us, *_ in expected[1:]}, -1, None, []
    for line in lines:
        out.append(line)
        kind, stamp, *_ = line.split(None, 2)
        if kind == "odom":
            newest = int(stamp)
        if kind == "scan" and int(stamp) in stamps:
            awaited = int(stamp)
        if awaited is not None and newest >= awaited:  # readings wait for odometry of their time
            out.append("await %d" % awaited)
            awaited = None
    return out


RATE = math.radians(0.01)  # of a word of turning


def heading(z, w):
    return 2.0 * math.atan2(float(z), float(w))


def main():
    with tempfile.TemporaryDirectory(prefix="ortung-ros2-") as name:
        folder = pathlib.Path(name)
        base = folder / "log"
        run(ortung, "import", "scanlog", LOG, "--out", base.with_suffix(".rec"), "--world", base.with_suffix(".toml"), "--robot-file",
            folder / "robot.toml")
        run(ortung, "learn", "--world", base.with_suffix(".toml"), "--robot", folder / "robot.toml", "--out", folder / "log.ortung")
        record = subprocess.run(["zstdcat", "-f", base.with_suffix(".rec")], check=True, capture_output=True, text=True).stdout
        lines = lines_of(record, (folder / "robot.toml").read_text())
        run(ortung, "localize", "--source", "record:%s?to_s=%g" % (base.with_suffix(".rec"), SECONDS), "--robot", folder / "robot.toml", "--tables",
            folder / "log.ortung", "--format", "json", "--out", folder / "poses.json")
        found = [json.loads(line) for line in (folder / "poses.json").read_text().splitlines()]
        expected = [[pose["stamp_us"], pose["x_m"], pose["y_m"], pose["theta_rad"]] for pose in found]  # all digits
        lines = in_step(lines, expected)

        known = ["--robot", folder / "robot.toml", "--tables", folder / "log.ortung"]
        # Parameters of Nav2 as they are change nothing.
        heard, said = live(folder, [*known, "--params-file", HERE / "nav2_params.yaml"], ["ready", *lines])
        [[seconds]] = [words[1:] for words in heard if words[0] == "matched"]
        print("matched after %s s" % seconds)
        check(heard, expected, lines, said)
        expect(not any(words[0] == "userdata" for words in heard), "Humble has no type hashes")
        told = [words[1:] for words in live(folder, [*known, "--distro", "jazzy"], ["ready"])[0] if words[0] == "userdata"]
        expect(sorted(told) == [["amcl_pose", "typehash=RIHS01_26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e;"],
                                ["tf", "typehash=RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087;"]], "type hashes: %s" % told)
        # The same by a map, a scan and a frame alone.
        yaml = dict(line.split(": ", 1) for line in base.with_suffix(".yaml").read_text().splitlines())
        x, y, _ = yaml["origin"].strip("[]").split(", ")
        first = next(line for line in lines if line.startswith("scan"))
        picture = bytearray(base.with_suffix(".pgm").read_bytes())
        picture[-1] = 0 if picture[-1] else 205
        (folder / "other.pgm").write_bytes(picture)  # one cell is another
        maps = ["map %s %s %s %s 0" % (file, yaml["resolution"], x, y) for file in (base.with_suffix(".pgm"), folder / "other.pgm")]
        third = len(lines) // 3
        learned = lambda times: ("the map is learned", times)  # the robot drives on while it is
        told = [maps[0], lines[0], "sample " + first, "ready", *lines[1:third], maps[1], *lines[third:2 * third], learned(1), maps[0],
                *lines[2 * third:-third // 3], learned(2), *lines[-third // 3:]]
        heard, said = live(folder, ["--folder", folder / "cache"], told, asked=[
            "wait 2.5", "call /amcl/set_parameters rcl_interfaces/srv/SetParameters " + set_count("max_particles", 5000),
            "call /request_nomotion_update std_srvs/srv/Empty " + Writer().number("B", 0).hex()])
        expect("particles = 5000" in (folder / "cache" / "robot.toml").read_text(), "a parameter that was set while it ran")
        expect(said[0].count("localizing") == 1 and said[0].count("another map") == 2, "maps that replace others: %s" % said[0])
        expect(said[0].count(".ortung: 1 features of robot in map") == 2, "the map that comes again is known: %s" % said[0])
        check(heard, expected, lines, said, 0.15, asked=1)  # of other samples
        check_change(heard, expected, said)
        # A map that is turned about its lower left corner: so are the poses.
        x, y, yaw = float(x), float(y), 0.65
        told = ["map %s %s %r %r %r" % (base.with_suffix(".pgm"), yaml["resolution"], x, y, yaw), lines[0], "sample " + first, "ready", *lines[1:]]
        turned = [[us, x + math.cos(yaw) * (px - x) - math.sin(yaw) * (py - y), y + math.sin(yaw) * (px - x) + math.cos(yaw) * (py - y), theta + yaw]
                  for us, px, py, theta in expected]
        heard, said = live(folder, ["--folder", folder / "turned"], told)
        check(heard, turned, lines, said, 0.2)  # cells of tables lie elsewhere in the map
        # And by clouds in the place of scans: ten points above each other, half of them in the band.
        points = [cloud_of(line) if line.startswith("scan") else line for line in lines]
        first = next(line for line in points if line.startswith("cloud"))
        told = [maps[0], lines[0], "sample " + first, "ready", *points[1:]]
        heard, said = live(folder, ["--folder", folder / "points", "--cloud", "points", "--band=-0.2,0.25"], told)
        expect('feature = "scan"' in (folder / "points" / "robot.toml").read_text() and "beams = 360" in (folder / "points" / "robot.toml").read_text(),
               "a robot file made of clouds")
        check(heard, expected, lines, said, 0.15)


def cloud_of(line):
    """A scan as a cloud of points; those that nothing was seen at are none."""
    _, stamp, frame, first, step, most, _, *ranges = line.split()
    places = []
    for i, text in enumerate(ranges):
        angle, distance = float(first) + i * float(step), float(text)
        if not 0 < distance < float(most):
            continue
        x, y = distance * math.cos(angle), distance * math.sin(angle)
        places += ["%.4f %.4f %.1f" % (x, y, 0.1 * k - 0.5) for k in range(10)]
    return "cloud %s %s %d %s" % (stamp, frame, len(places), " ".join(places))


def set_count(name, count):
    writer = Writer().number("I", 1).text(name).number("B", 2).number("?", False).number("q", count).number("d", 0.0).text("")
    for _ in range(5):
        writer.number("I", 0)
    return writer.hex()


def live(folder, arguments, lines, asked=()):
    """What a robot hears from ortung-ros2 that says these lines while others ask for services, and what that says itself."""
    domain = 41 + os.getpid() % 40  # each test has domains of its own
    environment = {**os.environ, "ROS_DOMAIN_ID": str(domain), "ROS_LOCALHOST_ONLY": "1", "HOME": str(folder),
                   "CYCLONEDDS_URI": '<General><Interfaces><NetworkInterface name="lo" multicast="true"/></Interfaces>'
                                     "<AllowMulticast>true</AllowMulticast></General>"}
    with tempfile.TemporaryFile("w+") as complaints:
        running = subprocess.Popen([str(word) for word in [node, "--base-frame", "base_link", *arguments]], env=environment,
                                   stdout=subprocess.PIPE, stderr=complaints, text=True)
        saying = Listening(running.stdout)
        asking = subprocess.Popen([client, str(domain)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) if asked else None
        if asking:
            asking.stdin.write("\n".join(asked) + "\n")
            asking.stdin.close()
        try:
            hearing = subprocess.Popen([peer, str(domain), str(PACE)], env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                       stderr=complaints, text=True)
            heard = Listening(hearing.stdout)
            for line in lines:
                if isinstance(line, tuple):
                    hearing.stdin.flush()
                    expect(saying.waits_for(lambda one, text=line[0]: text in one, line[1]), "%s, %d times: %s" % (*line, saying.lines))
                else:
                    hearing.stdin.write(line + "\n")
            hearing.stdin.close()
            hearing.wait(timeout=120)
        finally:
            hearing.kill()
            running.send_signal(signal.SIGTERM)
            running.wait(timeout=30)
        complaints.seek(0)
        said = "\n".join(saying.all()) + "\n", complaints.read()
    expect(hearing.returncode == 0, "the robot ends with %s: %s" % (hearing.returncode, said))
    if asking:
        answers = asking.stdout.read().split("\n")[:-1]
        expect(asking.wait(timeout=30) == 0 and len(answers) + 1 == len(asked) and "none" not in answers, "answers: %s" % answers)
    expect(running.returncode == 0, "it ends with %s: %s" % (running.returncode, said))
    if log := os.environ.get("LIVE_TEST_HEARD"):
        pathlib.Path(log).write_text("\n".join(heard.all()) + str(said))
    return [line.split() for line in heard.all()], said


def check(heard, expected, lines, said, tolerance=0.0, asked=0):
    """@param tolerance of poses; 0: bit by bit @param asked how many poses were asked for, at any time"""
    of = lambda kind: [words[1:] for words in heard if words[0] == kind]
    expect(any(n[:2] == ["/", "amcl"] and int(n[2]) >= 5 and int(n[3]) >= 4 for n in of("node")), "the graph has the node: %s" % of("node"))
    found = {int(us): pose for us, *pose in expected}
    poses = of("pose")
    others = [pose for pose in poses if int(pose[0]) // 1000 not in found]
    expect(len(others) <= asked, "poses at other times: %s" % others)
    poses = [pose for pose in poses if pose not in others]
    clouds = of("particles")
    print("%d poses, %d particle clouds, %d transforms; `ortung localize` has %d poses" % (len(poses), len(clouds), len(of("tf")), len(found)))
    # Best effort, and of poses the last one only for who is late: some may be lost, none may be another.
    expect(len(poses) > 0.8 * len(found) and len(clouds) > 0.8 * len(found), "too few\n%s" % (said,))
    for stamp, frame, x, y, z, w, *_ in poses:
        expect(int(stamp) % 1000 == 0 and int(stamp) // 1000 in found and frame == "map", "a pose at %s in %s" % (stamp, frame))
        ex, ey, et = found[int(stamp) // 1000]
        if tolerance:
            is_same = max(abs(float(x) - ex), abs(float(y) - ey), abs(math.remainder(heading(z, w) - et, math.tau))) < tolerance
        else:
            is_same = (float(x), float(y), float(z), float(w)) == (ex, ey, math.sin(et / 2), math.cos(et / 2))
        expect(is_same, "the pose at %s is %s, %s, expected %s, %s" % (stamp, x, y, ex, ey))
    for stamp, count, total in clouds:
        expect(int(count) >= 100 and abs(float(total) - 1.0) < 1e-6, "%s particles of weight %s" % (count, total))
    said_at = {int(stamp): float(at) for stamp, at in of("said")}
    after = sorted(float(t[-1]) - said_at[int(t[0]) - 1_000_000_000] for t in of("tf") if int(t[0]) - 1_000_000_000 in said_at)
    print("from odometry to its transform: median %.1f ms, p95 %.1f ms, most %.1f ms" % (
        *[1000 * after[int(share * (len(after) - 1))] for share in (0.5, 0.95, 1.0)],))
    maps = of("likelihood")
    off = []
    for stamp, frame, cells, best, x, y in maps:
        expect(frame == "map" and int(cells) > 1000 and best == "100", "a map of %s cells in %s, at best %s" % (cells, frame, best))
        # Those at the heading of the first poses may be poor ones.
        if int(stamp) // 1000 in found and int(stamp) // 1000 >= expected[FIRST_ONES][0]:
            pose = found[int(stamp) // 1000]
            off.append(math.hypot(float(x) - pose[0], float(y) - pose[1]))
    print("%d maps of likelihoods, best at most %.2f m from the robot" % (len(maps), max(off, default=0)))
    expect(off and max(off) < 0.3, "likelihoods %s" % off)
    # A scan counts once odometry of its time is there, too.
    scanned, took = {int(stamp): float(at) for stamp, at in of("scanned")}, []
    for stamp, *_, at in poses:
        covered = [when for odometry, when in said_at.items() if odometry >= int(stamp)]
        if int(stamp) in scanned and covered:
            took.append(float(at) - max(scanned[int(stamp)], min(covered)))
    if took:
        print("from a scan to its pose: median %.1f ms, p95 %.1f ms, most %.1f ms" % (
            *[1000 * sorted(took)[int(share * (len(took) - 1))] for share in (0.5, 0.95, 1.0)],))
    check_transforms(of("tf"), poses, [line.split() for line in lines if line.startswith("odom")])
    expect(all(name == "amcl" for _, _, name, *_ in of("diagnostics")) and of("diagnostics"), "diagnostics name the node")


def check_change(heard, expected, said):
    """A map that replaces another takes no scan away; the terminal says how long readings have waited for it."""
    waited = re.findall(r"the map is learned, in ([0-9.]+) s; readings have waited for ([0-9.]+) ms", said[0])
    expect(len(waited) == 2, "what changes of maps took: %s" % said[0])
    for times in waited:
        print("another map: learned in %s s, readings have waited for %s ms" % times)
    clouds = {int(words[1]) // 1000 for words in heard if words[0] == "particles"}
    missing = [us for us, *_ in expected[1:] if us not in clouds]  # where the robot is found takes other samples longer, or less
    expect(not missing, "no particles at %s" % missing)
    expect(re.search(r"relocalization \d+ to .*: a pose was given", said[0]), "the filter begins anew, which is told: %s" % said[0])


def check_transforms(transforms, poses, odometry):
    """Odometry in the map, times the robot in odometry, is the robot in the map; no odometry is without a transform of its time."""
    at = {int(stamp): (float(x), float(y), float(theta)) for _, stamp, x, y, theta, *_ in odometry}
    expect(all((parent, child) == ("map", "odom") for _, parent, child, *_ in transforms), "map -> odom, and no other")
    stamps = [int(stamp) for stamp, *_ in transforms]
    expect(stamps == sorted(set(stamps)), "transforms whose time rises")
    first = int(poses[0][0])
    late = [stamp for stamp in at if stamp > first and stamp + 1_000_000_000 not in set(stamps)]
    expect(len(late) < 0.2 * len(at), "%d of %d odometries have no transform" % (len(late), len(at)))
    off = []
    for stamp, _, _, x, y, z, w, _ in transforms:
        # The correction by a scan is told a microsecond after the odometry of its time.
        pose = next((p for p in poses if int(p[0]) == int(stamp) - 1_000_001_000), None)
        if pose is None or int(pose[0]) not in at:
            continue
        ox, oy, _ = at[int(pose[0])]
        turn = heading(z, w)
        off.append(math.hypot(float(x) + math.cos(turn) * ox - math.sin(turn) * oy - float(pose[2]),
                              float(y) + math.sin(turn) * ox + math.cos(turn) * oy - float(pose[3])))
    print("robot by transforms beside poses: median %.4f m, most %.4f m of %d" % (sorted(off)[len(off) // 2], max(off), len(off)))


main()
