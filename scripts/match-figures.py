#!/usr/bin/python3
"""match-figures.py TRACE EVENTS

Figures of a match that `ortung sim SCENE --trace TRACE > EVENTS` has played: goals, restarts and how they ended, how
much of the time the ball was in play, who had it, how long the ball and robots stood still while it was. Robots are
of the team that their name begins with. Needs nothing but Python."""
import argparse
import collections
import csv
import math
import re

RESTARTS = ("kick-off", "throw-in", "goal-kick", "corner", "free-kick", "penalty", "dropped-ball")
EVENT = re.compile(r"^ *(\d+\.\d+) s  ([a-z-]+)(?: ([A-Za-z0-9_-]+))?: ")
HAS = 0.5  # whose middle is so near to the ball's has it [m]
STILL = 0.15  # whoever stays in such a circle stands still [m]


def read_events(file):
    """[(time, what, team)]"""
    with open(file) as text:
        found = (EVENT.match(line) for line in text)
        return [(float(m[1]), m[2], m[3] or "") for m in found if m]


def spans_in_play(events, end):
    """[(from, to)] while the ball was in play; a dropped ball is at once after a second."""
    spans, begin = [], None
    for at, what, _ in events:
        if what in ("play", "set-piece-over"):
            begin = at
        elif what in RESTARTS + ("half-time", "end", "stop"):
            if begin is not None and begin < at:
                spans.append((begin, at))
            begin = at + 1.0 if what == "dropped-ball" else None
    if begin is not None and begin < end:
        spans.append((begin, end))
    return spans


def read_trace(file):
    """[(time, {name: (x, y)})], the ball as `ball`"""
    moments = {}
    with open(file, newline="") as text:
        for row in csv.DictReader(text):
            name = row["name"] if row["kind"] == "robot" else row["kind"]
            moments.setdefault(float(row["time_s"]), {})[name] = (float(row["x_m"]), float(row["y_m"]))
    return sorted(moments.items())


class Standing:
    """The longest time for which somebody stood still, and when."""

    def __init__(self):
        self.anchor, self.since, self.longest, self.when = None, 0.0, 0.0, 0.0

    def look(self, at, place):
        if self.anchor is None or math.dist(place, self.anchor) > STILL:
            self.anchor, self.since = place, at
        if at - self.since > self.longest:
            self.longest, self.when = at - self.since, self.since


def figures(events, moments):
    end = moments[-1][0]
    spans = spans_in_play(events, end)
    had = collections.Counter()
    standing = collections.defaultdict(Standing)
    farthest = [0.0, 0.0]
    for begin, until in spans:
        for one in standing.values():
            one.anchor = None
        for at, places in moments:
            if not begin <= at <= until:
                continue
            ball = places["ball"]
            farthest = [max(farthest[i], abs(ball[i])) for i in (0, 1)]
            name = min((n for n in places if n != "ball"), key=lambda n: math.dist(places[n], ball))
            had[name.rstrip("0123456789") if math.dist(places[name], ball) < HAS else "nobody"] += 1
            for n, place in places.items():
                standing[n].look(at, place)
    return end, spans, had, standing, farthest


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[1])
    parser.add_argument("trace")
    parser.add_argument("events")
    args = parser.parse_args()
    events, moments = read_events(args.events), read_trace(args.trace)
    end, spans, had, standing, farthest = figures(events, moments)
    count = collections.Counter(what for _, what, _ in events)
    goals = collections.Counter(team for _, what, team in events if what == "goal")
    print(f"{end:.0f} s; goals: " + (", ".join(f"{t} {n}" for t, n in sorted(goals.items())) or "none"))
    print("restarts: " + ", ".join(f"{k} {count[k]}" for k in RESTARTS if count[k]) +
          f"; taken {count['play']}, not in time {count['set-piece-over']}")
    print("other: " + ", ".join(f"{k} {n}" for k, n in sorted(count.items())
                                if k not in RESTARTS + ("play", "set-piece-over", "goal")))
    in_play = sum(b - a for a, b in spans)
    print(f"ball in play: {100 * in_play / end:.0f} % of the time, at most {farthest[0]:.2f} m, {farthest[1]:.2f} m off")
    total = sum(had.values()) or 1
    print("had by: " + ", ".join(f"{k} {100 * n / total:.0f} %" for k, n in sorted(had.items())))
    worst = sorted(((s.longest, n, s.when) for n, s in standing.items()), reverse=True)
    print("longest stand in play: " + ", ".join(f"{n} {t:.1f} s (from {w:.1f})" for t, n, w in worst[:6]))


if __name__ == "__main__":
    main()
