#!/usr/bin/python3
"""Runs a server among clients that come and go, and a simulation by itself, and looks whether they grow.

soak.py [ORTUNG] [--minutes 30] [--clients 20] [--viewers 0] [--hours 10]

The server simulates maps/fields/f2000.toml in real time for --minutes. Each client has a robot that wanders, reads all of
its readings ten times a second, talks now and then, and goes after a while, without a word every other time; then it
comes again. --viewers of Chromium look at the page, and are opened anew every other minute. Beside, ten robots are simulated for --hours of their time as fast as possible, with record and trace.
Prints memory, threads and open files of both. Fails if one of them ends early, or if there are more of these in the last
quarter than in the second one, beyond 5 % and 4 MiB. Cycles that begin late are counted, too: on a busy machine there are some.
"""

import argparse
import os
import random
import selectors
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


class Client:
    """A connection that is made again whenever it ends."""

    def __init__(self, port, number, selector, chance):
        self.port, self.number, self.selector, self.chance = port, number, selector, chance
        self.lives = self.bytes = 0
        self.socket = None
        self.begin()

    def begin(self):
        self.lives += 1
        self.socket = socket.create_connection(("127.0.0.1", self.port))
        self.selector.register(self.socket, selectors.EVENT_READ, self)
        self.ends = time.monotonic() + self.chance.uniform(2, 60)
        self.talks = time.monotonic() + self.chance.uniform(0, 10)
        text = ROBOT.read_text()
        self.socket.sendall((f"HELLO ortung/1 name=soak{self.number}\nCREATE robot{self.number} drive=wander\n{text}.\n"
                             "SUBSCRIBE period_s=0.1\n").encode())

    def read(self):
        data = self.socket.recv(1 << 16)
        self.bytes += len(data)
        if not data:
            sys.exit(f"soak: the server has closed the connection of client {self.number}")

    def live(self, now):
        if now > self.talks:
            self.talks = now + 10
            self.socket.sendall(b"SAY I am still here\nSTATUS\n")
        if now > self.ends:
            if self.lives % 2:
                self.socket.sendall(b"BYE\n")
            self.selector.unregister(self.socket)
            self.socket.close()
            self.begin()


class Viewer:
    """Chromium without a window, which looks at the page and is opened anew now and then."""

    def __init__(self, url):
        self.url, self.lives, self.process, self.folder = url, 0, None, None
        self.begin()

    def begin(self):
        self.end()
        self.lives += 1
        self.folder = tempfile.TemporaryDirectory(prefix="ortung_viewer.", ignore_cleanup_errors=True)
        self.process = subprocess.Popen(
            [os.environ.get("CHROMIUM", "/usr/bin/chromium"), "--headless=new", "--no-sandbox", "--use-gl=angle",
             "--use-angle=swiftshader", f"--user-data-dir={self.folder.name}", "--remote-debugging-port=0", self.url],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        self.ends = time.monotonic() + 120

    def live(self, now):
        if self.process.poll() is not None:
            sys.exit(f"soak: Chromium ended by itself with {self.process.returncode}")
        if now > self.ends:
            self.begin()

    def end(self):
        if self.process is None:
            return
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.folder.cleanup()


def sizes(process):
    """Resident memory [MiB], threads, open files."""
    status = Path(f"/proc/{process.pid}/status").read_text()
    number = {line.split(":")[0]: line.split()[1] for line in status.splitlines() if len(line.split()) > 1}
    return int(number["VmRSS"]) / 1024, int(number["Threads"]), len(os.listdir(f"/proc/{process.pid}/fd"))


def judge(name, samples):
    """Whether the last quarter is larger than the second one."""
    quarter = len(samples) // 4
    if quarter == 0:
        sys.exit(f"soak: too short: the {name} was looked at {len(samples)} times, expected at least 4")
    fine = True
    for which, what, slack in ((0, "MiB", 4), (1, "threads", 0), (2, "open files", 0)):
        early = max(s[which] for s in samples[quarter:2 * quarter])
        late = max(s[which] for s in samples[-quarter:])
        grows = late > 1.05 * early + slack
        fine = fine and not grows
        print(f"| {name} | {what} | {samples[0][which]:.1f} | {early:.1f} | {late:.1f} | {'GROWS' if grows else 'stays'} |")
    return fine


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung", nargs="?", default=ROOT / "build/release/bin/ortung")
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--clients", type=int, default=20)
    parser.add_argument("--viewers", type=int, default=0, help="windows of Chromium that show the page")
    parser.add_argument("--hours", type=float, default=10)
    options = parser.parse_args()

    server = subprocess.Popen([options.ortung, "sim", FIELD, "--listen", "0"] + ["--view"] * (options.viewers > 0), stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)
    port = int(server.stdout.readline().split()[-1])
    alone = subprocess.Popen([options.ortung, "sim", FIELD, "--free-run", "--duration", str(3600 * options.hours),
                              "--record", "/dev/null", "--trace", "/dev/null"] + ["--robot", ROBOT] * 10,
                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    selector = selectors.DefaultSelector()
    chance = random.Random(1)
    clients = [Client(port, n, selector, chance) for n in range(options.clients)]
    viewers = [Viewer(f"http://127.0.0.1:{port}/") for _ in range(options.viewers)]
    samples = {"server": [], "simulation": []}
    start = time.monotonic()
    period = options.minutes * 60 / 120
    due = start + 2  # once all have robots
    while time.monotonic() < start + 60 * options.minutes:
        for key, _ in selector.select(timeout=0.05):
            key.data.read()
        now = time.monotonic()
        for visitor in clients + viewers:
            visitor.live(now)
        if server.poll() is not None:
            sys.exit(f"soak: the server ended: {server.stderr.read()}")
        if now > due:
            due = now + period
            samples["server"].append(sizes(server))
            if alone.poll() is None:
                samples["simulation"].append(sizes(alone))
            if sys.stderr.isatty():
                print(f"\r{(now - start) / 60:.1f} min, server {samples['server'][-1]}", end="", file=sys.stderr)
    print(f"{sum(c.lives for c in clients)} lives of {options.clients} clients read {sum(c.bytes for c in clients) / 1e6:.0f} MB, "
          f"the page was opened {sum(v.lives for v in viewers)} times")
    for viewer in viewers:
        viewer.end()
    while alone.poll() is None:
        samples["simulation"].append(sizes(alone))
        time.sleep(1)
    print(alone.stdout.read().strip())
    server.terminate()
    told = server.communicate()[1].strip().splitlines()[-1]
    print(told)  # "ortung sim: N cycles, M missed"
    print("\n| what | | at first | second quarter | last quarter | |\n| --- | --- | --- | --- | --- | --- |")
    fine = [judge(name, seen) for name, seen in samples.items()]
    if alone.returncode != 0 or server.returncode != 0 or not all(fine):
        sys.exit("soak: failed")


if __name__ == "__main__":
    main()
