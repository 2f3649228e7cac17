#!/usr/bin/env python3
"""How long it takes from the start of `ortung demo` to what is seen first: the page, the field on it, the robot's pose, the map of where
it may be.

  scripts/performance_start.py build/release/bin/ortung [--runs 5]

Prints a table in Markdown, of the fastest run.
"""
import argparse
import re
import signal
import socket
import subprocess
import sys
import time
import urllib.request

HEAD = "| from the start of `ortung demo` to | [s] |\n|---|---|"
LONGEST = 30  # until the map is there [s]


class Client:
    """A viewer at the message board (docs/protocol.md)."""

    def __init__(self, port):
        self.stream = socket.create_connection(("127.0.0.1", port)).makefile("rwb")
        self.ask("HELLO ortung/1 role=viewer")

    def ask(self, line):
        """First line of the reply; what follows it is read, too."""
        self.stream.write(line.encode() + b"\n")
        self.stream.flush()
        head = self.stream.readline().decode()
        if found := re.search(r" lines=(\d+)", head):
            for _ in range(int(found.group(1))):
                self.stream.readline()
        if found := re.search(r" bytes=(\d+)", head):
            self.stream.read(int(found.group(1)))
        return head


def until(client, line, is_done):
    """Asks again and again."""
    begin = time.monotonic()
    while not is_done(client.ask(line)):
        if time.monotonic() - begin > LONGEST:
            sys.exit("performance_start.py: no answer to %s" % line)
        time.sleep(0.02)  # a board drops who sends errors without end


def moments(ortung):
    """Of one run: [(what, seconds)]."""
    begin = time.monotonic()
    found = []
    note = lambda what: found.append((what, time.monotonic() - begin))
    with subprocess.Popen([ortung, "demo", "--no-browser", "--listen", "0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True) as demo:
        try:
            for line in demo.stdout:
                if address := re.search(r"http://[^/]*:(\d+)/", line):
                    break
            urllib.request.urlopen(address.group(0)).read()
            note("the page is there")
            client = Client(int(address.group(1)))
            client.ask("DESCRIBE field")
            note("the field is drawn")
            until(client, "READ robot=0", lambda head: " lines=0" not in head)
            note("the robot moves on it")
            until(client, "HEATMAP robot=1", lambda head: head.startswith("OK") and " readings=0" not in head)
            note("the map of where it may be")
        finally:
            demo.send_signal(signal.SIGTERM)
    return found


def rows(ortung, runs=5):
    """Rows of the table."""
    all_runs = [moments(ortung) for _ in range(runs)]
    for i, (what, _) in enumerate(all_runs[0]):
        yield "| %s | %.2f |" % (what, min(run[i][1] for run in all_runs))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung")
    parser.add_argument("--runs", type=int, default=5)
    arguments = parser.parse_args()
    print(HEAD)
    for line in rows(arguments.ortung, arguments.runs):
        print(line, flush=True)


if __name__ == "__main__":
    main()
