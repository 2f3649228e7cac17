#!/usr/bin/python3
"""picture-of-scene.py SCENE --out NAME [--ortung PROGRAM] [--duration S] [--width PIXELS]

Plays a scene with `ortung sim` and draws what it did: NAME.png, all ways in one picture, and NAME.gif,
the play itself at twice its speed. Needs python3-pil (Pillow)."""
import argparse
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib

try:
    from PIL import Image, ImageDraw
except ImportError:
    sys.exit("picture-of-scene.py: needs Pillow: apt-get install python3-pil")

COLOURS = {"striker": "#d62728", "keeper": "#1f77b4", "defender": "#9467bd"}
SPARE = ["#8c564b", "#17becf", "#bcbd22", "#e377c2", "#7f7f7f"]


class Canvas:
    """Draws in metres on a field, twice as fine as the picture that comes out."""

    def __init__(self, bounds, width):
        self.x0, self.x1, self.y0, self.y1 = bounds
        self.scale = 2 * width / (self.x1 - self.x0)
        size = (2 * width, int(round((self.y1 - self.y0) * self.scale)))
        self.image = Image.new("RGB", size, "#2e7d32")
        self.draw = ImageDraw.Draw(self.image)

    def copy(self):
        other = object.__new__(Canvas)
        other.__dict__.update(self.__dict__)
        other.image = self.image.copy()
        other.draw = ImageDraw.Draw(other.image)
        return other

    def at(self, p):
        return ((p[0] - self.x0) * self.scale, (self.y1 - p[1]) * self.scale)

    def polygon(self, points, colour, outline=None):
        self.draw.polygon([self.at(p) for p in points], fill=colour, outline=outline)

    def way(self, points, colour, width_m=0.05):
        if len(points) > 1:
            self.draw.line([self.at(p) for p in points], fill=colour,
                           width=max(1, int(width_m * self.scale)))

    def finished(self):
        return self.image.resize((self.image.width // 2, self.image.height // 2), Image.LANCZOS)


def placed(points, pose):
    x, y, theta = pose
    c, s = math.cos(theta), math.sin(theta)
    return [(x + c * px - s * py, y + s * px + c * py) for px, py in points]


def outline(shape, piece):
    """Corners of a primitive of a world or robot file, in its frame."""
    if shape == "triangle":
        c = piece["corners_m"]
        return [(c[0], c[1]), (c[2], c[3]), (c[4], c[5])]
    hx, hy = piece["size_m"][0] / 2, piece["size_m"][1] / 2
    pose = (*piece["center_m"], math.radians(piece.get("angle_deg", 0)))
    if shape == "rectangle":
        return placed([(-hx, -hy), (hx, -hy), (hx, hy), (-hx, hy)], pose)
    first, last = (math.radians(a) for a in piece.get("arc_deg", [0, 360]))
    steps = 48
    angles = [first + (last - first) * i / steps for i in range(steps + 1)]
    return placed([(hx * math.cos(a), hy * math.sin(a)) for a in angles], pose)


def draw_world(canvas, world):
    for shape in ("rectangle", "ellipse", "triangle"):
        for piece in world.get(shape, []):
            kind = piece.get("kind", "obstacle")
            if kind == "ball" or piece.get("movable"):
                continue
            points = outline(shape, piece)
            if kind == "line" and piece.get("stroke_m"):
                canvas.way(points, "white", piece["stroke_m"])
            else:
                colour = "white" if kind == "line" else piece.get("colour", "gray")
                canvas.polygon(points, colour, None if kind == "line" else "black")


def shape_of(robot, states):
    """Outlines of a robot's pieces with its manipulators in these states."""
    pieces = [outline(p.get("shape", "rectangle"), p) for p in robot.get("body", [])]
    if not pieces:
        r = robot.get("robot", {}).get("radius_m", 0.25)
        pieces = [outline("ellipse", {"center_m": [0, 0], "size_m": [2 * r, 2 * r]})]
    for manipulator in robot.get("manipulator", []):
        for state in manipulator["state"]:
            if states.get(manipulator["name"]) == state["name"]:
                pieces += [outline(p.get("shape", "rectangle"), p) for p in state.get("body", [])]
    return pieces


def draw_robot(canvas, pieces, pose, colour):
    for piece in pieces:
        canvas.polygon(placed(piece, pose), colour, "black")
    canvas.way(placed([(0, 0), (0.3, 0)], pose), "white", 0.04)


def draw_ball(canvas, pose):
    canvas.polygon(placed(outline("ellipse", {"center_m": [0, 0], "size_m": [0.22, 0.22]}), pose),
                   "#ff8c00", "black")


def read_trace(file):
    moments = {}
    with open(file, newline="") as text:
        for row in csv.DictReader(text):
            pose = (float(row["x_m"]), float(row["y_m"]), math.radians(float(row["theta_deg"])))
            states = dict(s.split("=") for s in row["manipulators"].split(";") if s)
            moments.setdefault(float(row["time_s"]), []).append(
                (row["kind"], row["name"], pose, states))
    return moments


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[1])
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--out", required=True, help="name of the pictures, without .png and .gif")
    parser.add_argument("--ortung", default="ortung")
    parser.add_argument("--duration", type=float)
    parser.add_argument("--width", type=int, default=900)
    args = parser.parse_args()

    scene = tomllib.loads(args.scene.read_text())
    world_file = args.scene.parent / scene["scene"]["world"]
    world = tomllib.loads(world_file.read_text())
    robots = {r["name"]: tomllib.loads((args.scene.parent / r["file"]).read_text())
              for r in scene["robot"]}
    spare = iter(SPARE * 100)
    colours = {name: COLOURS.get(name) or next(spare) for name in robots}

    with tempfile.TemporaryDirectory() as folder:
        trace = f"{folder}/trace.csv"
        command = [args.ortung, "sim", str(args.scene), "--free-run", "--trace", trace]
        if args.duration:
            command += ["--duration", str(args.duration)]
        subprocess.run(command, check=True)
        moments = read_trace(trace)

    bounds = (*world["world"]["x_m"], *world["world"]["y_m"])
    field = Canvas(bounds, args.width)
    draw_world(field, world)

    picture = field.copy()
    ways, last = {}, {}
    for bodies in moments.values():
        for kind, name, pose, states in bodies:
            ways.setdefault((kind, name), []).append(pose[:2])
            last[(kind, name)] = (pose, states)
    for (kind, name), points in ways.items():
        picture.way(points, "#ff8c00" if kind != "robot" else colours[name])
    for at in [t for i, t in enumerate(moments) if i % 40 == 0]:  # every 2 s, and the end
        for kind, name, pose, states in moments[at]:
            if kind == "robot":
                draw_robot(picture, shape_of(robots[name], states), pose, colours[name])
            else:
                draw_ball(picture, pose)
    picture.finished().save(f"{args.out}.png")

    frames = []
    for i, bodies in enumerate(moments.values()):
        if i % 4:  # five frames for a second of play, shown at twice its speed
            continue
        frame = field.copy()
        for kind, name, pose, states in bodies:
            if kind == "robot":
                draw_robot(frame, shape_of(robots[name], states), pose, colours[name])
            else:
                draw_ball(frame, pose)
        small = frame.finished()
        frames.append(small.resize((small.width * 2 // 3, small.height * 2 // 3)).quantize(128, method=Image.Quantize.FASTOCTREE))
    frames[0].save(f"{args.out}.gif", save_all=True, append_images=frames[1:], duration=100, loop=0)
    print(f"{args.out}.png, {args.out}.gif: {len(frames)} frames")


if __name__ == "__main__":
    main()
