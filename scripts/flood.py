#!/usr/bin/env python3
"""Measures what honest clients of a server feel of viewers and operators who ask for what is slow, in a loop.

flood.py [ORTUNG] [map] [why] [seek] [--viewers 50] [--seconds 8]

map   HEATMAP of all features of a robot that is localized, beside 200 clients that READ it ten times a second
why   WHY of the same robot, beside 200 clients
seek  SEEK in a record of half an hour, beside 70 clients

Each kind is measured without viewers, with --viewers that ask one question at a time, and with as many that ask four. The
viewers have the lowest priority, since elsewhere they would have processors of their own. Run it where nothing else runs.
"""

import argparse
import os
import re
import select
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FIELD = ROOT / "maps/fields/f2000.toml"
ROBOT = ROOT / "maps/robots/pioneer.toml"
QUESTIONS = {"map": ["HEATMAP robot=1"], "why": ["WHY robot=1 x_m=0 y_m=0"],
             "seek": [f"SEEK time_s={t}" for t in (1700, 10, 900, 1500)]}
HONEST = {"map": 200, "why": 200, "seek": 70}
HERTZ = 10


class Client:
    """A connection whose replies are told apart."""

    def __init__(self, port, role):
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.input = b""
        self.asked = []  # when, of what was not answered yet
        self.count = 0
        self.socket.sendall(f"HELLO ortung/1 role={role}\n".encode())
        self.reply()

    def ask(self, line):
        self.asked.append(time.perf_counter())
        self.count += 1
        self.socket.sendall(line.encode() + b"\n")

    def read(self):
        piece = self.socket.recv(1 << 18)
        if not piece:
            sys.exit(f"flood: the server has closed a connection: {self.input[:200]}")
        self.input += piece

    def take(self):
        """Returns the head of a reply that has come as a whole, or nothing."""
        end = self.input.find(b"\n") + 1
        if end == 0:
            return None
        head = self.input[:end].decode()
        if announced := re.search(r" bytes=(\d+)", head):
            end += int(announced[1])
            if len(self.input) < end:
                return None
        elif announced := re.search(r" lines=(\d+)", head):
            for _ in range(int(announced[1])):
                end = self.input.find(b"\n", end) + 1
                if end == 0:
                    return None
        self.input = self.input[end:]
        return head

    def reply(self):
        while (head := self.take()) is None:
            self.read()
        return head


def watched(clients):
    poll = select.epoll()
    for client in clients:
        poll.register(client.socket.fileno(), select.EPOLLIN)
    return poll, {client.socket.fileno(): client for client in clients}


def quantile(values, share):
    return 1e3 * sorted(values)[int(share * (len(values) - 1))] if values else float("nan")


def be_honest(port, kind, seconds):
    """Reads at a fixed rate, each client one reply at a time; returns how long each took [s]."""
    poll, clients = watched([Client(port, "viewer") for _ in range(HONEST[kind])])
    turns = list(clients.values())
    begin, gap, turn, taken = time.perf_counter(), 1 / HERTZ / len(turns), 0, []
    while (now := time.perf_counter()) < begin + seconds:
        while begin + turn * gap <= now:
            client = turns[turn % len(turns)]
            if not client.asked:
                client.ask("READ robot=1")
            turn += 1
        for number, _ in poll.poll(max(0, begin + turn * gap - time.perf_counter())):
            client = clients[number]
            client.read()
            while (head := client.take()) is not None:
                if not head.startswith("OK"):
                    sys.exit(f"flood: {head}")
                taken.append(time.perf_counter() - client.asked.pop(0))
    return taken


def view(port, kind, count, depth, seconds):
    """Asks as fast as it is answered; says what came of it."""
    poll, clients = watched([Client(port, "operator" if kind == "seek" else "viewer") for _ in range(count)])
    lines, taken, refused, served = QUESTIONS[kind], [], {}, set()
    for client in clients.values():
        for _ in range(depth):
            client.ask(lines[client.count % len(lines)])
    until = time.perf_counter() + seconds
    while time.perf_counter() < until:
        for number, _ in poll.poll(0.1):
            client = clients[number]
            client.read()
            while (head := client.take()) is not None:
                began = client.asked.pop(0)
                if head.startswith("OK"):
                    taken.append(time.perf_counter() - began)
                    served.add(number)
                else:
                    refused[head.split()[1]] = refused.get(head.split()[1], 0) + 1
                client.ask(lines[client.count % len(lines)])
    print(f"  viewers: {len(taken)} answers in {seconds:.0f} s, p50 {quantile(taken, 0.5):.0f} ms, to {len(served)} of {count}"
          + "".join(f"; {n} {why}" for why, n in refused.items()), flush=True)


def serve(ortung, kind, folder):
    """Starts a server; returns its process and port."""
    if kind == "seek":
        record = Path(folder) / "long.rec"
        subprocess.run([ortung, "sim", FIELD, "--robot", ROBOT, "--duration", "1800", "--free-run", "--record", record],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        command = ["view", record, "--no-browser"]
    else:
        command = ["sim", FIELD, "--robot", ROBOT, "--localize", "all", "--clients", "400", "--clients-per-address", "400"]
    server = subprocess.Popen([ortung, *command, "--listen", "0", "--allow-control", "all"], stdout=subprocess.PIPE, text=True)
    for line in server.stdout:
        if port := re.search(r"port (\d+)|(?:localhost|127\.0\.0\.1):(\d+)", line):
            return server, int(port[1] or port[2])
    sys.exit("flood: the server has ended")


def localize(port):
    """Waits until the robot is localized."""
    operator = Client(port, "operator")
    for _ in range(600):
        operator.ask("LOCALIZE robot=1")
        if "state=running" in operator.reply():
            return
        time.sleep(0.1)
    sys.exit("flood: the robot was not localized within a minute")


def measure(ortung, kind, options):
    with tempfile.TemporaryDirectory() as folder:
        server, port = serve(ortung, kind, folder)
        try:
            if kind != "seek":
                localize(port)
            for count, depth in ((0, 1), (options.viewers, 1), (options.viewers, 4)):
                child = os.fork() if count else None
                if child == 0:
                    os.nice(19)
                    view(port, kind, count, depth, options.seconds + 1)
                    os._exit(0)
                taken = be_honest(port, kind, options.seconds)
                if child:
                    os.waitpid(child, 0)
                print(f"{kind}: beside {count} viewers, {depth} questions each: {len(taken)} replies, p50 {quantile(taken, 0.5):.2f} ms, "
                      f"p99 {quantile(taken, 0.99):.2f} ms, most {quantile(taken, 1):.2f} ms", flush=True)
        finally:
            server.send_signal(signal.SIGTERM)
            server.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung", nargs="?", default=ROOT / "build/release/bin/ortung")
    parser.add_argument("kinds", nargs="*", metavar="KIND", help="of map, why, seek; all by default")
    parser.add_argument("--viewers", type=int, default=50)
    parser.add_argument("--seconds", type=float, default=8)
    options = parser.parse_args()
    if unknown := [k for k in options.kinds if k not in QUESTIONS]:
        parser.error(f"unknown kind {', '.join(unknown)}, expected some of {', '.join(QUESTIONS)}")
    for kind in options.kinds or QUESTIONS:
        measure(options.ortung, kind, options)


if __name__ == "__main__":
    main()
