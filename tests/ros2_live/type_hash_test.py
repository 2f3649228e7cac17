#!/usr/bin/env python3
"""type_hash_test.py ROOT  the type hashes that the node tells (RIHS01: SHA-256 of a type's description, REP 2011 and 2016) are those of the
types in messages.idl, and those that others have published."""
import hashlib
import json
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
NUMBERS = {"int8": 2, "uint8": 3, "octet": 3, "long": 6, "unsigned long": 7, "float": 10, "double": 11, "boolean": 15, "string": 17}
BYTE, ARRAY, SEQUENCE = 16, 48, 144
PUBLISHED = {  # where others have them in public
    "sensor_msgs/msg/Imu": "7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b",
    "diagnostic_msgs/msg/DiagnosticArray": "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e",
    "geometry_msgs/msg/PoseArray": "af0cc36d190e104d546d168d6b39df04fa4b4ccecf59cb4c9ed328d3d5004aa0",
    "geometry_msgs/msg/PoseStamped": "10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8",
    "geometry_msgs/msg/PoseWithCovarianceStamped": "26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e",
    "geometry_msgs/msg/Twist": "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a",
    "geometry_msgs/msg/TwistStamped": "5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64",
    "nav_msgs/msg/OccupancyGrid": "8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7",
    "nav_msgs/msg/Odometry": "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0",
    "rosgraph_msgs/msg/Clock": "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564",
    "sensor_msgs/msg/Image": "d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47",
    "sensor_msgs/msg/LaserScan": "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
    "sensor_msgs/msg/PointCloud2": "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5",
    "sensor_msgs/msg/Range": "b42b62562e93cbfe9d42b82fe5994dfa3d63d7d5c90a317981703f7388adff3a",
    "std_msgs/msg/String": "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
    "std_msgs/msg/UInt32MultiArray": "6c2577c7ad3cbdcc2164a41c12f1d5ad314ea320f3fb1ee47e78019fe16bb5b0",
    "tf2_msgs/msg/TFMessage": "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
}


def ros_name(name):
    package, kind, _, own = name.split("::")
    return "%s/%s/%s" % (package, kind, own.rstrip("_"))


def structs(text):
    """{type: [(field, IDL type, length)]}"""
    text = re.sub(r"//.*", "", text)
    found = {}
    for package, body in re.findall(r"module (\w+) \{ module msg \{ module dds_ \{(.*?)\n\}; \}; \};", text, re.S):
        for name, fields in re.findall(r"struct (\w+) \{(.*?)\};", body, re.S):
            parts = [part.strip() for part in fields.split(";") if part.strip()]
            found["%s::msg::dds_::%s" % (package, name)] = [re.fullmatch(r"(.*?) (\w+)(?:\[(\d+)\])?", part, re.S).groups() for part in parts]
    return found


def description(name, types):
    fields = []
    for kind, field, length in types[name]:
        inner = re.fullmatch(r"sequence<(.*)>", kind)
        plain = inner.group(1) if inner else kind
        number = NUMBERS.get(plain, 1)
        if (name.split("::")[-1], field) == ("DiagnosticStatus_", "level"):
            number = BYTE  # which IDL does not tell from uint8
        number += SEQUENCE if inner else ARRAY if length else 0
        fields.append({"name": field, "type": {"type_id": number, "capacity": int(length or 0), "string_capacity": 0,
                                               "nested_type_name": "" if plain in NUMBERS else ros_name(plain)}})
    return {"type_name": ros_name(name), "fields": fields}


def parts(name, types, found):
    for kind, _, _ in types[name]:
        plain = re.sub(r"sequence<(.*)>", r"\1", kind)
        if plain not in NUMBERS and plain not in found:
            found.add(plain)
            parts(plain, types, found)
    return found


def hash_of(name, types):
    whole = {"type_description": description(name, types),
             "referenced_type_descriptions": sorted((description(part, types) for part in parts(name, types, set())), key=lambda d: d["type_name"])}
    return hashlib.sha256(json.dumps(whole, separators=(", ", ": ")).encode()).hexdigest()


def main():
    types = structs((root / "tests/ros2_live/messages.idl").read_text())
    hashes = {ros_name(name): hash_of(name, types) for name in types}
    if len(sys.argv) > 2:
        for name, digest in sorted(hashes.items()):
            print('    {"%s",\n     "%s"},' % (name, digest))
        return
    told = dict(re.findall(r'\{"(\w+/msg/\w+)",\s*"([0-9a-f]{64})"\}', (root / "realsensors/ros2_live/dds/TypeHashes.cpp").read_text()))
    for name, digest in PUBLISHED.items():
        if hashes[name] != digest:
            sys.exit("failed: %s has %s, published is %s" % (name, hashes[name], digest))
    for name, digest in told.items():
        if hashes.get(name) != digest:
            sys.exit("failed: the node tells %s for %s, expected %s" % (digest, name, hashes.get(name)))
    header = (root / "realsensors/ros2/include/ortung/ros2/Messages.hpp").read_text()
    messages = set(re.findall(r'kType = "(\w+/msg/\w+)"', header))
    if not messages or messages - set(told):
        sys.exit("failed: messages of Messages.hpp have no hash: %s" % sorted(messages - set(told)))
    print("%d hashes are right" % len(told))


main()
