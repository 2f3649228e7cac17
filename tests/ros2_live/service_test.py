#!/usr/bin/env python3
"""service_test.py ORTUNG_ROS2 CLIENT  ortung-ros2 beside a client that does what Nav2's lifecycle manager and `ros2 param` do: services by
rmw_fastrtps's rules. The client's DDS is the same as ours, so this is no independent proof; its bytes are (cdr.py)."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile

from cdr import Reader, Writer

node, client = map(pathlib.Path, sys.argv[1:])
HERE = pathlib.Path(__file__).parent
EMPTY = Writer().number("B", 0).hex()


def expect(condition, what):
    if not condition:
        sys.exit("failed: %s" % (what,))


class Robot:
    """A running ortung-ros2, and a client of its services."""

    def __init__(self, folder, *arguments):
        self.domain = 101 + os.getpid() % 70  # each test has domains of its own
        environment = {**os.environ, "ROS_DOMAIN_ID": str(self.domain), "ROS_LOCALHOST_ONLY": "1", "HOME": str(folder)}
        self.running = subprocess.Popen([node, *arguments], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.client = subprocess.Popen([client, str(self.domain)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.heard = []

    def tell(self, *words):
        self.client.stdin.write(" ".join(words) + "\n")
        self.client.stdin.flush()

    def call(self, name, kind, request=EMPTY):
        self.tell("call", name, kind, request)
        for line in self.client.stdout:
            words = line.split()
            if words[0] == "heard":
                self.heard.append((words[1], Reader(words[2])))
                continue
            expect(words[0] == "answer", "%s has no answer" % name)
            return Reader(words[1])
        sys.exit("failed: the client ended")

    def end(self):
        self.client.stdin.close()
        for line in self.client.stdout:
            words = line.split()
            self.heard.append((words[1], Reader(words[2])))
        expect(self.client.wait(timeout=30) == 0, "the client")
        self.running.send_signal(signal.SIGTERM)
        said = self.running.communicate(timeout=30)[0]
        expect(self.running.returncode == 0, said)
        return said


def state(reader):
    return reader.number("B"), reader.text()


def change(robot, node_name, transition):
    answer = robot.call(node_name + "/change_state", "lifecycle_msgs/srv/ChangeState", Writer().number("B", transition).text("").hex())
    done = answer.number("?")
    answer.done()
    return done


def state_of(robot, node_name):
    answer = robot.call(node_name + "/get_state", "lifecycle_msgs/srv/GetState")
    found = state(answer)
    answer.done()
    return found


def names(*all_of):
    writer = Writer().number("I", len(all_of))
    for name in all_of:
        writer.text(name)
    return writer


def value(reader):
    """A parameter's value by its type."""
    kind = reader.number("B")
    parts = [None, reader.number("?"), reader.number("q"), reader.number("d"), reader.text()]
    for one in ("B", "B", "q", "d"):
        reader.list(lambda one=one: reader.number(one))
    reader.list(reader.text)
    return parts[kind]


def set_number(name, number):
    writer = names(name).number("B", 3).number("?", False).number("q", 0).number("d", number).text("")
    for _ in range(5):
        writer.number("I", 0)
    return writer.hex()


def lead(robot, node_name):
    """As nav2_lifecycle_manager leads a node."""
    robot.tell("listen", "/bond", "bond/msg/Status")
    robot.tell("listen", node_name + "/transition_event", "lifecycle_msgs/msg/TransitionEvent")
    expect(state_of(robot, node_name) == (3, "active"), "it works without a manager")
    expect(change(robot, node_name, 1) and state_of(robot, node_name) == (2, "inactive"), "configure")
    expect(not change(robot, node_name, 4), "deactivate, though it is inactive")
    expect(change(robot, node_name, 3) and state_of(robot, node_name) == (3, "active"), "activate")
    robot.tell("wait", "3")  # hearts beat ten times a second
    answer = robot.call(node_name + "/get_available_states", "lifecycle_msgs/srv/GetAvailableStates")
    expect(len(answer.list(lambda: state(answer))) == 11, "states")
    for service, count in (("get_available_transitions", 2), ("get_transition_graph", 28)):
        answer = robot.call("%s/%s" % (node_name, service), "lifecycle_msgs/srv/GetAvailableTransitions")
        found = answer.list(lambda: (state(answer), state(answer), state(answer)))
        expect(len(found) == count, "%s: %s" % (service, found))
        answer.done()
    expect(change(robot, node_name, 4) and change(robot, node_name, 3), "deactivate, activate")


def check_heard(heard, node_name):
    bonds = []
    for topic, reader in heard:
        if topic == "/bond":
            reader.number("i"), reader.number("I"), reader.text()
            bonds.append((reader.text(), reader.text(), reader.number("?"), reader.number("f"), reader.number("f")))
            reader.done()
    print("%d words of the bond" % len(bonds))
    expect(len(bonds) >= 5 and all(one[0] == node_name.split("/")[-1] for one in bonds), bonds)
    expect({one[2] for one in bonds} == {True, False} and len({one[1] for one in bonds}) == 2, "two bonds, of which one ends: %s" % bonds)
    events = []
    for topic, reader in heard:
        if topic.endswith("transition_event"):
            reader.number("Q")
            events.append((state(reader), state(reader), state(reader)))
            reader.done()
    expect([(a[1], b[1], c[1]) for a, b, c in events][-2:] == [("activate", "inactive", "activating"), ("transition_success", "activating", "active")],
           events)
    changed = []
    for topic, reader in heard:
        if topic == "/parameter_events":
            reader.number("i"), reader.number("I")
            of = reader.text()
            one = lambda: (reader.text(), value(reader))
            changed.append((of, reader.list(one), reader.list(one), reader.list(one)))
    expect((node_name, [], [("transform_tolerance", 0.5)], []) in changed, changed)


def parameters(robot, node_name):
    robot.tell("listen", "/parameter_events", "rcl_interfaces/msg/ParameterEvent")
    call = lambda name, kind, request: robot.call("%s/%s" % (node_name, name), "rcl_interfaces/srv/" + kind, request)
    answer = call("list_parameters", "ListParameters", names().number("Q", 0).hex())
    found = answer.list(answer.text)
    expect(answer.list(answer.text) == ["initial_pose"] and {"alpha1", "initial_pose.yaw", "use_sim_time"} < set(found), found)
    answer.done()
    wanted = names("max_particles", "base_frame_id", "initial_pose.x", "tf_broadcast", "alpha1").hex()
    answer = call("get_parameters", "GetParameters", wanted)
    expect(answer.list(lambda: value(answer)) == [3000, "base_link", 0.0, True, 0.3], "values")
    answer = call("get_parameter_types", "GetParameterTypes", wanted)
    expect(answer.list(lambda: answer.number("B")) == [2, 4, 3, 1, 3], "types")
    answer = call("describe_parameters", "DescribeParameters", names("base_frame_id").hex())
    described = answer.list(lambda: (answer.text(), answer.number("B"), answer.text(), answer.text(), answer.number("?"), answer.number("?"),
                                     answer.number("I"), answer.number("I")))
    answer.done()
    expect(described[0][:2] == ("base_frame_id", 4) and described[0][4], described)
    for service, kind in (("set_parameters", "SetParameters"), ("set_parameters_atomically", "SetParametersAtomically")):
        for name, number, is_done in (("transform_tolerance", 0.5, True), ("transform_tolerance", 11.0, False), ("nothing", 1.0, False)):
            answer = call(service, kind, set_number(name, number))
            one = lambda: (answer.number("?"), answer.text())
            [(done, why)] = answer.list(one) if kind == "SetParameters" else [one()]
            expect(done == is_done and (why == "") == is_done, "%s %s: %s" % (service, name, why))
            answer.done()


def ask(robot, space):
    """What behaviour trees and simple commanders ask of amcl."""
    pose = Writer().number("i", 0).number("I", 0).text("map")
    for number in [0.0] * 6 + [1.0] + [0.0] * 36:
        pose.number("d", number)
    for name, kind, request in (("set_initial_pose", "nav2_msgs/srv/SetInitialPose", pose.hex()),
                                ("reinitialize_global_localization", "std_srvs/srv/Empty", EMPTY),
                                ("request_nomotion_update", "std_srvs/srv/Empty", EMPTY)):
        answer = robot.call(space + "/" + name, kind, request)
        expect(answer.number("B") == 0, name)
        answer.done()


def main():
    with tempfile.TemporaryDirectory(prefix="ortung-ros2-") as folder:
        # As nav2_bringup writes files for robots with a namespace.
        text = (HERE / "nav2_params.yaml").read_text()
        nested = pathlib.Path(folder) / "params.yaml"
        nested.write_text("robot1:\n" + "".join("  " + line for line in text.splitlines(True)))
        for space, file, arguments in (("", HERE / "nav2_params.yaml", []),
                                       ("/robot1", nested, ["-r", "__ns:=/robot1", "-r", "/tf:=tf"])):
            robot = Robot(folder, "--ros-args", "--params-file", file, "-p", "max_particles:=3000", "-p", "alpha1:=0.3", *arguments)
            parameters(robot, space + "/amcl")
            lead(robot, space + "/amcl")
            ask(robot, space)
            said = robot.end()
            check_heard(robot.heard, space + "/amcl")
            expect("without effect: " in said and "sigma_hit" in said, said)
        bad = subprocess.run([node, "--params-file", HERE / "nav2_params.yaml", "--ros-args", "-p", "max_partikels:=3"], capture_output=True, text=True)
        expect(bad.returncode == 2 and "max_partikels" in bad.stderr and "max_particles" in bad.stderr, bad.stderr)


main()
