#!/usr/bin/env python3
"""wire_test.py ROOT ORTUNG ORTUNG_ROS2 ORTUNG_ROS2_ROBOT  what our nodes say of their topics on the wire, as Wireshark's dissector of RTPS
reads it: names, types, quality of service, and the hashes of types that Iron and later want, as rmw_fastrtps has them."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

import robots
from robots import expect

root, ortung, localizer, bridge = map(pathlib.Path, sys.argv[1:])
DOMAIN = 201 + os.getpid() % 15  # each test has domains of its own
WRITER, READER = "03", "04"     # kinds of endpoints without a key
RELIABLE, BEST_EFFORT, LATCHED, VOLATILE = 2, 1, 1, 0
# What is offered and read: type, reliability and durability.
ROBOT = {
    ("rt/clock", WRITER): ("rosgraph_msgs/msg/Clock", RELIABLE, VOLATILE),
    ("rt/scan", WRITER): ("sensor_msgs/msg/LaserScan", RELIABLE, VOLATILE),
    ("rt/range/sonar/sonar0", WRITER): ("sensor_msgs/msg/Range", RELIABLE, VOLATILE),
    ("rt/odom", WRITER): ("nav_msgs/msg/Odometry", RELIABLE, VOLATILE),
    ("rt/tf", WRITER): ("tf2_msgs/msg/TFMessage", RELIABLE, VOLATILE),
    ("rt/tf_static", WRITER): ("tf2_msgs/msg/TFMessage", RELIABLE, LATCHED),
    ("rt/map", WRITER): ("nav_msgs/msg/OccupancyGrid", RELIABLE, LATCHED),
    ("rt/cmd_vel", READER): ("geometry_msgs/msg/Twist", RELIABLE, VOLATILE),
    ("ros_discovery_info", WRITER): ("rmw_dds_common/msg/ParticipantEntitiesInfo", RELIABLE, LATCHED),
}
LOCALIZER = {
    ("rt/scan", READER): ("sensor_msgs/msg/LaserScan", BEST_EFFORT, VOLATILE),
    ("rt/odom", READER): ("nav_msgs/msg/Odometry", BEST_EFFORT, VOLATILE),
    ("rt/map", READER): ("nav_msgs/msg/OccupancyGrid", RELIABLE, LATCHED),
    ("rt/tf_static", READER): ("tf2_msgs/msg/TFMessage", RELIABLE, LATCHED),
    ("rt/tf", WRITER): ("tf2_msgs/msg/TFMessage", RELIABLE, VOLATILE),
    ("rt/amcl_pose", WRITER): ("geometry_msgs/msg/PoseWithCovarianceStamped", RELIABLE, LATCHED),
    ("rt/particle_cloud", WRITER): ("nav2_msgs/msg/ParticleCloud", None, VOLATILE),
    ("rt/diagnostics", WRITER): ("diagnostic_msgs/msg/DiagnosticArray", RELIABLE, VOLATILE),
    ("rt/initialpose", READER): ("geometry_msgs/msg/PoseWithCovarianceStamped", RELIABLE, VOLATILE),
    ("ros_discovery_info", WRITER): ("rmw_dds_common/msg/ParticipantEntitiesInfo", RELIABLE, LATCHED),
}


def skip(why):
    print("wire_test.py: Skipped\n" + why)
    sys.exit(77)


def capture(file):
    """tshark, once it has begun. It hears the ports of the domain (RTPS 2.3, 9.6.1.1) alone."""
    if shutil.which("tshark") is None:
        skip("tshark is not installed (scripts/install-deps.sh)")
    first = 7400 + 250 * DOMAIN
    process = subprocess.Popen(["tshark", "-i", "lo", "-f", "udp portrange %d-%d" % (first, first + 249), "-w", str(file)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    told = []
    for line in process.stderr:
        told.append(line)
        if "Capture started" in line:
            return process
    process.wait()
    skip("tshark can't capture here: " + "".join(told))


def dds_type(name):
    return "::".join(name.split("/")[:-1]) + "::dds_::" + name.split("/")[-1] + "_"


def endpoints(file):
    """{(participant, topic, kind): (type, reliability, durability, user data)} of a capture."""
    # While the capture goes on, its last packet may be cut off, which is an error for tshark.
    told = subprocess.run(["tshark", "-r", str(file), "-Y", "rtps.param.topicName", "-T", "pdml"], capture_output=True, text=True, check=False)
    found = {}
    for data in xml.etree.ElementTree.fromstring(told.stdout or "<none/>").iter("field"):
        if not any(part.get("name") == "rtps.param.topicName" for parameter in data for part in parameter):
            continue
        values = {part.get("name"): part.get("show") for parameter in data for part in parameter.iter("field")}
        if "rtps.param.endpoint_guid" not in values:
            continue  # the dissector's own note of whose data it is
        guid = values["rtps.param.endpoint_guid"].split(":")
        user = bytes.fromhex((values.get("rtps.param.userData") or "").replace(":", "")).decode()
        found["".join(guid[:12]), values["rtps.param.topicName"], guid[15]] = (
            values["rtps.param.typeName"], int(values["rtps.reliability_kind"], 16), int(values["rtps.durability"], 16), user)
    return found


def check(found, participant, expected, hashes):
    own = {key[1:]: value for key, value in found.items() if key[0] == participant}
    for key, (kind, reliability, durability) in expected.items():
        hashed = "typehash=RIHS01_%s;" % hashes[kind]
        expect(key in own, "no endpoint %s among %s" % (key, sorted(own)))
        expect(own[key][0] == dds_type(kind) and reliability in (None, own[key][1]) and durability == own[key][2] and own[key][3] == hashed,
               "%s is %s, expected %s" % (key, own[key], (kind, reliability, durability, hashed)))


def wait_for(file, topics):
    """Goes on once the capture has these topics, or after a time that nobody needs."""
    for _ in range(120):
        if topics <= {key[1] for key in endpoints(file)}:
            return
        time.sleep(0.5)


def main():
    hashes = dict(re.findall(r'\{"(\w+/msg/\w+)",\s*"([0-9a-f]{64})"\}', (root / "realsensors/ros2_live/dds/TypeHashes.cpp").read_text()))
    with tempfile.TemporaryDirectory(prefix="ortung-wire-") as name:
        folder = pathlib.Path(name)
        (folder / "rover.toml").write_text(robots.ROBOT)
        variables = robots.environment(folder, DOMAIN)
        tshark = capture(folder / "wire.pcapng")
        try:
            with robots.running([ortung, "sim", robots.ARENA, "--listen", "0"], variables) as sim:
                with robots.running([bridge, "--connect", "127.0.0.1:%d" % robots.port_of(sim), "--robot", folder / "rover.toml", "--distro",
                                     "jazzy"], variables) as robot:
                    robots.wait_for_line(robot, "obeys")
                    with robots.running([localizer, "--base-frame", "base_link", "--folder", folder / "learned", "--distro", "jazzy"],
                                        variables) as amcl:
                        robots.wait_for_line(amcl, "localizing")
                        wait_for(folder / "wire.pcapng", {topic for topic, _ in [*ROBOT, *LOCALIZER]})
        finally:
            tshark.terminate()
            tshark.communicate(timeout=60)
        found = endpoints(folder / "wire.pcapng")
    # Both are there: that with a clock is the robot.
    [robot] = {key[0] for key in found if key[1] == "rt/clock"}
    [amcl] = {key[0] for key in found} - {robot}
    check(found, robot, ROBOT, hashes)
    check(found, amcl, LOCALIZER, hashes)
    types = {dds_type(name): digest for name, digest in hashes.items()}
    for (_, topic, _), (kind, _, _, user) in sorted(found.items()):
        expect(re.fullmatch(r"r[tqr]/[A-Za-z0-9_/]+|ros_discovery_info", topic) and re.fullmatch(r"\w+::(msg|srv)::dds_::\w+_", kind),
               "%s is of %s" % (topic, kind))
        expect(kind not in types or user == "typehash=RIHS01_%s;" % types[kind], "%s of %s says %s" % (topic, kind, user))
    print("%d endpoints are as ROS has them" % len(found))


main()
