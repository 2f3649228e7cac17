#!/usr/bin/env python3
"""Writes one recording as bags of ROS 1 by rosbag, and as MCAP and .db3 of ROS 2 by the formats' specifications.

usage: twins.py FOLDER

The messages are those of ROS 1's own packages; CDR is made of their slots.
"""

import io
import math
import sqlite3
import struct
import sys
from pathlib import Path

import genpy
import rosbag
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import Image, LaserScan, Range
from tf2_msgs.msg import TFMessage

NUMBERS = {"bool": "B", "byte": "b", "char": "B", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
           "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}


class Cdr:
    """Encodes a message of ROS 1 as ROS 2 does: aligned, texts with a zero, headers without seq."""

    def __init__(self):
        self.out = b""

    def number(self, code, value):
        size = struct.calcsize("<" + code)
        self.out += bytes(-len(self.out) % size) + struct.pack("<" + code, value)

    def value(self, kind, value):
        if kind.endswith("]"):
            base, length = kind[:-1].split("[")
            if not length:
                self.number("I", len(value))
            if isinstance(value, bytes):
                self.out += value
                return
            for one in value:
                self.value(base, one)
        elif kind in NUMBERS:
            self.number(NUMBERS[kind], value)
        elif kind == "string":
            text = value.encode() + b"\0"
            self.number("I", len(text))
            self.out += text
        elif kind == "time":
            self.number("i", value.secs)
            self.number("I", value.nsecs)
        else:
            for slot, inner in zip(value.__slots__, value._slot_types):
                if not (kind.endswith("Header") and slot == "seq"):
                    self.value(inner, getattr(value, slot).lstrip("/") if "frame_id" in slot else getattr(value, slot))


def cdr(message):
    writer = Cdr()
    writer.value("message", message)
    return b"\0\1\0\0" + writer.out


def stamped(message, seconds, frame, number):
    message.header.stamp = genpy.Time.from_sec(seconds)
    message.header.frame_id = frame
    message.header.seq = number
    return message


def transform(seconds, parent, child, x, yaw):
    one = stamped(TransformStamped(), seconds, parent, 7)
    one.child_frame_id = child
    one.transform.translation.x = x
    one.transform.rotation.z, one.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return one


def scan(seconds, i):
    message = stamped(LaserScan(), seconds, "/laser", i)
    message.angle_min, message.angle_max, message.angle_increment = -1.5, 1.5, 0.05
    message.range_min, message.range_max, message.scan_time = 0.1, 8.0, 0.1
    message.ranges = [2.0 + math.sin(0.3 * beam + 0.1 * i) for beam in range(61)]
    message.ranges[3], message.ranges[4], message.ranges[5] = math.inf, math.nan, 0.0
    message.intensities = [float(beam) for beam in range(61)]
    return message


def odometry(seconds, i):
    message = stamped(Odometry(), seconds, "odom", i)
    message.child_frame_id = "base_link"
    message.pose.pose.position.x, message.pose.pose.position.y = 0.05 * i, 0.01 * i
    message.pose.pose.orientation.z, message.pose.pose.orientation.w = math.sin(0.01 * i), math.cos(0.01 * i)
    message.twist.twist.linear.x, message.twist.twist.angular.z = 0.5, 0.2
    return message


def others(seconds, i):
    """Messages of the other types that are imported."""
    pose = stamped(PoseStamped(), seconds, "map", i)
    pose.pose.position.x, pose.pose.orientation.w = 1.0 + 0.05 * i, 1.0
    yield "/ground_truth", pose
    estimate = stamped(PoseWithCovarianceStamped(), seconds, "map", i)
    estimate.pose.pose.orientation.w = 1.0
    yield "/amcl_pose", estimate
    echo = stamped(Range(), seconds, "sonar", i)
    echo.field_of_view, echo.max_range, echo.range = 0.5, 4.0, 1.0 + 0.01 * i
    yield "/sonar", echo
    image = stamped(Image(), seconds, "camera", i)
    image.height, image.width, image.step, image.encoding = 2, 3, 9, "bgr8"
    image.data = bytes((i + 11 * k) % 256 for k in range(18))
    yield "/image", image
    yield "/tf", TFMessage([transform(seconds, "odom", "base_link", 0.05 * i, 0.02 * i)])


def recording():
    """Yields topics, messages and times of recording [ns]."""
    start = 1_500_000_000
    grid = stamped(OccupancyGrid(), start, "map", 0)
    grid.info.resolution, grid.info.width, grid.info.height = 0.05, 4, 3
    grid.info.origin.orientation.w = 1.0
    grid.data = [0, 100, -1, 0, 50, 0, 0, 100, 0, 0, 0, 0]
    yield "/map", grid, start * 10**9
    yield "/tf_static", TFMessage([transform(start, "/base_link", "/laser", 0.2, 0.1),
                                   transform(start, "base_link", "sonar", 0.1, 0.0)]), start * 10**9
    for i in range(50):
        seconds = start + 0.1 * i
        time = start * 10**9 + i * 10**8 + 12_345_678
        yield "/scan", scan(seconds, i), time
        yield "/odom", odometry(seconds, i), time + 1
        for topic, message in others(seconds, i):
            yield topic, message, time + 2


def ros2_type(message):
    return message._type.replace("/", "/msg/")


def write_mcap(path, messages):
    out = io.BytesIO()

    def text(value):
        return struct.pack("<I", len(value)) + value.encode()

    def record(kind, content):
        out.write(struct.pack("<BQ", kind, len(content)) + content)

    magic = b"\x89MCAP0\r\n"
    out.write(magic)
    record(1, text("ros2") + text("twins.py"))
    channels = {}
    for topic, message, time in messages:
        if topic not in channels:
            channels[topic] = number = len(channels) + 1
            record(3, struct.pack("<H", number) + text(ros2_type(message)) + text("ros2msg") + text(""))
            record(4, struct.pack("<HH", number, number) + text(topic) + text("cdr") + text(""))
        record(5, struct.pack("<HIQQ", channels[topic], 0, time, time) + cdr(message))
    record(15, struct.pack("<I", 0))
    record(2, struct.pack("<QQI", 0, 0, 0))
    path.write_bytes(out.getvalue() + magic)


def write_db3(path, messages):
    base = sqlite3.connect(path)
    base.executescript("""
        CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
        CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
        CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
                            serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
        CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
                              data BLOB NOT NULL);
        CREATE INDEX timestamp_idx ON messages (timestamp ASC);""")
    topics = {}
    for topic, message, time in messages:
        if topic not in topics:
            topics[topic] = len(topics) + 1
            base.execute("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')", (topics[topic], topic, ros2_type(message)))
        base.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)",
                     (topics[topic], time, cdr(message)))
    base.commit()
    base.close()


def write_bag(path, messages, compression, slash="/"):
    with rosbag.Bag(str(path), "w", compression=compression, chunk_threshold=20_000) as bag:
        for topic, message, time in messages:
            bag.write(slash + topic.lstrip("/"), message, genpy.Time(time // 10**9, time % 10**9))


def main():
    folder = Path(sys.argv[1])
    messages = list(recording())
    write_mcap(folder / "run.mcap", messages)
    write_db3(folder / "run.db3", messages)
    for compression in ("none", "bz2", "lz4"):
        write_bag(folder / f"{compression}.bag", messages, compression)
    write_bag(folder / "bare.bag", messages, "none", slash="")
    whole = (folder / "none.bag").read_bytes()
    # As a recorder leaves it that was killed: without a place of the index, and without the index.
    index = struct.unpack("<Q", whole[whole.index(b"index_pos=") + 10:][:8])[0]
    at = whole.index(b"index_pos=") + 10
    (folder / "killed.bag").write_bytes(whole[:at] + bytes(8) + whole[at + 8:index])


main()
