#!/usr/bin/env python3
"""launch_test.py LAUNCH_FILE ORTUNG_ROS2  the launch file, with stand-ins for the packages of ROS 2, starts what the program understands, in the
place that the lifecycle manager and the parameters name."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import types

launch_file, node = sys.argv[1:]
HERE = pathlib.Path(__file__).parent
VALUES = {"params_file": str(HERE / "nav2_params.yaml"), "map": "hall.yaml"}
actions = []


def stand_in(name):
    class Action:
        def __init__(self, *words, **keys):
            self.kind, self.words, self.keys = name, words, keys
            actions.append(self)
    return Action


def module(name, **members):
    made = types.ModuleType(name)
    made.__dict__.update(members)
    sys.modules[name] = made


module("launch", LaunchDescription=stand_in("LaunchDescription"))
module("launch.actions", DeclareLaunchArgument=stand_in("argument"), ExecuteProcess=stand_in("process"))
module("launch.substitutions", LaunchConfiguration=lambda name: ("value", name))
module("launch_ros")
module("launch_ros.actions", Node=stand_in("node"))
scope = {}
exec(compile(pathlib.Path(launch_file).read_text(), launch_file, "exec"), scope)
scope["generate_launch_description"]()
arguments = {action.words[0]: action.keys.get("default_value") for action in actions if action.kind == "argument"}
[process] = [action for action in actions if action.kind == "process"]
[manager] = [action for action in actions if action.kind == "node" and action.keys["executable"] == "lifecycle_manager"]
with tempfile.TemporaryDirectory() as folder:
    world = pathlib.Path(folder) / "building.toml"
    world.write_text('[[floor]]\nname = "ground"\nmap = "ground.yaml"\n')
    values = {**arguments, **VALUES, "belief": folder + "/belief", "world": str(world)}
    command = [values[word[1]] if isinstance(word, tuple) else word for word in process.keys["cmd"]]
    assert command[0] == "ortung-ros2", command
    has_map_server = any(action.kind == "node" and action.keys["executable"] == "map_server" for action in actions)
    assert has_map_server == ("map_server" in manager.keys["parameters"][0]["node_names"]) == ("--world" not in command), (command, manager.keys)
    names = [word.split(":=")[1] for word in command if word.startswith("__node:=")]
    assert names == ["amcl"] and "amcl" in manager.keys["parameters"][0]["node_names"], (names, manager.keys)
    environment = {**os.environ, "ROS_DOMAIN_ID": str(216 + os.getpid() % 10), "ROS_LOCALHOST_ONLY": "1", "HOME": folder, "ROS_DISTRO": "jazzy"}
    running = subprocess.Popen([node, *command[1:]], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    said = ""
    for line in running.stdout:
        said += line
        if "listening" in line:
            break
    running.send_signal(signal.SIGTERM)
    said += running.communicate(timeout=30)[0]
    assert running.returncode == 0 and "listening" in said, said
