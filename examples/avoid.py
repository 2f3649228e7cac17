#!/usr/bin/env python3
"""A robot that drives about and turns away from obstacles ahead, by the bare protocol.

    avoid.py HOST PORT ROBOT_FILE [SECONDS]
"""
import os
import socket
import sys
import time


class Server:
    """A connection: each request is a line, each reply a line and as many more as it says (docs/protocol.md)."""
    def __init__(self, host, port):
        self.lines = socket.create_connection((host, port), timeout=10).makefile("rw", newline="\n")

    def ask(self, request):
        self.lines.write(request + "\n")
        self.lines.flush()
        reply = self.lines.readline()
        while reply.startswith("* ") and not reply.startswith(("* ERR", "* BYE")):  # events
            reply = self.lines.readline()
        if not reply.startswith("OK"):
            raise RuntimeError(f"{request.split()[0]}: {reply.strip() or 'the connection is closed'}")
        values = dict(word.split("=", 1) for word in reply.split() if "=" in word)
        return [self.lines.readline().strip() for _ in range(int(values.get("lines", 0)))]


def readings(lines):
    """Returns {"LMS200/LRF/180DegreeScan": [words]} from the lines of a record."""
    return {line.split()[1]: [int(word) for word in line.split()[3:]] for line in lines}


def main(host, port, robot_file, seconds="10"):
    server = Server(host, int(port))
    token = os.environ.get("ORTUNG_TOKEN")
    server.ask("HELLO ortung/1 name=avoid-py" + (f" token={token}" if token else ""))
    with open(robot_file) as file:
        server.ask("CREATE avoid-py\n" + file.read() + "\n.")
    end = time.monotonic() + float(seconds)
    while time.monotonic() < end:
        scan = readings(server.ask("READ */LRF/*"))
        for ranges in scan.values():
            third = len(ranges) // 3
            ahead = min(r for r in ranges[third:len(ranges) - third] + [8000] if r > 0)  # [mm]
            server.ask("VELOCITY " + ("v_m_s=0.5 w_rad_s=0" if ahead > 800 else "v_m_s=0 w_rad_s=0.8"))
            print(f"{ahead} mm ahead")
        time.sleep(0.1)
    server.ask("BYE")


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (OSError, RuntimeError) as error:
        sys.exit(f"avoid.py: {error}")
