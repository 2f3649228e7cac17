#!/usr/bin/python3
"""picture-of-scene.py SCENE --out NAME [--ortung PROGRAM] [--from S] [--duration S] [--seed N] [--width PIXELS]

Plays a scene with `ortung sim` and draws what it did, from a time to the end: NAME.png, all ways in one picture,
and NAME.gif, the play itself at twice its speed. Needs python3-pil (Pillow)."""
import argparse
import csv
import gzip
import io
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib

try:
    from PIL import Image, ImageChops, ImageDraw, ImageFont
except ImportError:
    sys.exit("picture-of-scene.py: needs Pillow: apt-get install python3-pil")

# Colours of M. Okabe and K. Ito, told apart with any colour vision.
ROBOTS = ["#56b4e9", "#f0e442", "#cc79a7", "#d55e00", "#0072b2", "#e69f00", "#009e73", "#f5f5f5"]
TEAMS = {"blue": "#56b4e9", "yellow": "#f0e442"}
BALL = "#ff8c00"
GRASS = "#2f6b3c"  # where lines are painted
FLOOR = "#e4e7eb"
PAPER, INK = "#ffffff", "#1d2733"
COLOURS = 64  # of a GIF; the next one is none
LEFT, RIGHT, TOP, BELOW, LINE = 62, 16, 34, 50, 26  # room around the field, height of a line of the legend
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"


def font(size):
    try:
        return ImageFont.truetype(FONT, size)
    except OSError:
        return ImageFont.load_default()


class Canvas:
    """Draws in metres on a field, twice as fine as the picture that comes out."""

    def __init__(self, bounds, width, ground):
        self.x0, self.x1, self.y0, self.y1 = bounds
        self.scale = 2 * width / (self.x1 - self.x0)
        size = (2 * width, int(round((self.y1 - self.y0) * self.scale)))
        self.image = Image.new("RGB", size, ground)
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
                           width=max(3, int(width_m * self.scale)), joint="curve")

    def name(self, place, text):
        """A name beside a place, readable on any ground."""
        x, y = self.at(place)
        letters = font(26)
        left, top, right, bottom = self.draw.textbbox((0, 0), text, font=letters)
        x = min(max(x - (right - left) / 2, 4), self.image.width - (right - left) - 4)
        y = y - 62 if y > 80 else y + 34
        self.draw.text((x, y), text, font=letters, fill=PAPER, stroke_width=4, stroke_fill=INK)

    def finished(self):
        return self.image.resize((self.image.width // 2, self.image.height // 2), Image.LANCZOS)


def round_length(length):
    """The largest of 1, 2 and 5 times a power of ten that is not above."""
    ten = 10 ** math.floor(math.log10(length))
    return max(m * ten for m in (1, 2, 5) if m * ten <= length)


def symbol(draw, x, y, kind, colour):
    """What a body looks like in the legend, with its middle there."""
    if kind == "ball":
        draw.ellipse([x - 6, y - 6, x + 6, y + 6], fill=colour, outline="black")
    else:
        draw.rectangle([x - 9, y - 6, x + 9, y + 6], fill=colour, outline="black")


def legend_rows(entries, width):
    """Where the entries of a legend go: (x, row, entry), and how many rows there are."""
    x, row, placed_entries = 0, 0, []
    for entry in entries:
        taken = 34 + int(font(14).getlength(entry[0])) + 18
        if x and x + taken > width:
            x, row = 0, row + 1
        placed_entries.append((x, row, entry))
        x += taken
    return placed_entries, row + 1


def page(field, bounds, title, entries):
    """The field with axes in metres, a bar of a round length, a clock and a legend."""
    x0, x1, y0, y1 = bounds
    width, height = field.size
    places, rows = legend_rows(entries, width)
    image = Image.new("RGB", (LEFT + width + RIGHT, TOP + height + BELOW + rows * LINE + 8), PAPER)
    image.paste(field, (LEFT, TOP))
    draw = ImageDraw.Draw(image)
    draw.rectangle([LEFT - 1, TOP - 1, LEFT + width, TOP + height], outline=INK)
    small = font(13)
    draw.text((LEFT, 8), title, font=font(15), fill=INK)
    draw.text((8, 12), "y [m]", font=small, fill=INK)
    step = round_length((x1 - x0) / 6)
    scale = width / (x1 - x0)
    for i in range(math.ceil(x0 / step), math.floor(x1 / step) + 1):
        x = LEFT + (i * step - x0) * scale
        draw.line([x, TOP + height, x, TOP + height + 5], fill=INK)
        draw.text((x, TOP + height + 7), f"{i * step:g}", font=small, fill=INK, anchor="ma")
    for i in range(math.ceil(y0 / step), math.floor(y1 / step) + 1):
        y = TOP + (y1 - i * step) * scale
        draw.line([LEFT - 5, y, LEFT, y], fill=INK)
        draw.text((LEFT - 8, y), f"{i * step:g}", font=small, fill=INK, anchor="rm")
    below = TOP + height + 26
    draw.text((LEFT + width / 2, below), "x [m]", font=small, fill=INK, anchor="ma")
    bar = round_length((x1 - x0) / 6)
    draw.line([LEFT, below + 4, LEFT, below + 10, LEFT + bar * scale, below + 10, LEFT + bar * scale, below + 4],
              fill=INK, width=2)
    draw.text((LEFT + bar * scale + 8, below), f"{bar:g} m", font=small, fill=INK)
    for x, row, (text, kind, colour) in places:
        middle = TOP + height + BELOW + row * LINE + LINE // 2
        symbol(draw, LEFT + x + 12, middle, kind, colour)
        draw.text((LEFT + x + 30, middle), text, font=font(14), fill=INK, anchor="lm")
    return image


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


def is_movable(piece):
    return piece.get("movable", piece.get("kind") == "ball")


def pieces_of(world):
    """(shape, piece) of all primitives, in the order in which the simulator has them."""
    return [(shape, piece) for shape in ("rectangle", "ellipse", "triangle") for piece in world.get(shape, [])]


class Thing:
    """Something movable: its outline in its own frame, as the world file says it."""

    def __init__(self, shape, piece):
        points = outline(shape, piece)
        if shape == "triangle":
            middle = [sum(p[i] for p in points) / 3 for i in (0, 1)]
            back = (0, 0, 0)
            points = [(x - middle[0], y - middle[1]) for x, y in points]
        else:
            back = (0, 0, -math.radians(piece.get("angle_deg", 0)))
            points = [(x - piece["center_m"][0], y - piece["center_m"][1]) for x, y in points]
        self.points = placed(points, back)
        self.kind = piece.get("kind", "obstacle")
        self.name = piece.get("name", "") or self.kind
        self.colour = colour_of(piece, BALL if self.kind == "ball" else "#a0785a")


def colour_of(piece, default):
    """The colour that a file gives to something, if it is one that pictures know."""
    try:
        Image.new("RGB", (1, 1), piece.get("colour") or default)
        return piece.get("colour") or default
    except ValueError:
        return default


def draw_map(canvas, file):
    """A map_server map below everything else."""
    keys = dict(line.split(":", 1) for line in file.read_text().splitlines() if ":" in line)
    keys = {k.strip(): v.split("#")[0].strip().strip("\"'") for k, v in keys.items()}
    picture = file.parent / keys["image"]
    if not picture.exists():
        picture = picture.with_name(picture.name + ".gz")
    data = picture.read_bytes()
    image = Image.open(io.BytesIO(gzip.decompress(data) if picture.suffix == ".gz" else data))
    if image.mode.startswith("I"):  # 16 bits
        image = image.convert("I").point(lambda value: value * (1 / 257))
    image = image.convert("L").convert("RGB")
    x, y, yaw = (float(n) for n in keys["origin"].strip("[]").split(","))
    cell = float(keys["resolution"]) * canvas.scale
    left, bottom = canvas.at((x, y))
    if yaw == 0:
        size = (max(1, round(image.width * cell)), max(1, round(image.height * cell)))
        canvas.image.paste(image.resize(size), (round(left), round(bottom) - size[1]))
        return
    # Of each pixel of the canvas, that of the map: turned back about the map's lower left corner.
    c, s = math.cos(yaw) / cell, math.sin(yaw) / cell
    back = (c, -s, s * bottom - c * left, s, c, image.height - s * left - c * bottom)
    mask = Image.new("L", image.size, 255).transform(canvas.image.size, Image.Transform.AFFINE, back)
    canvas.image.paste(image.transform(canvas.image.size, Image.Transform.AFFINE, back), (0, 0), mask)


def draw_world(canvas, world, folder):
    for grid in world.get("grid", []):
        file = folder / grid["map"]
        if file.suffix in (".yaml", ".yml"):
            draw_map(canvas, file)
        else:
            print(f"picture-of-scene.py: {file} is left out: only map_server maps are drawn", file=sys.stderr)
    for shape, piece in pieces_of(world):
        kind = piece.get("kind", "obstacle")
        if is_movable(piece):
            continue
        points = outline(shape, piece)
        if kind == "line" and piece.get("stroke_m"):
            canvas.way(points, colour_of(piece, "white"), piece["stroke_m"])
        elif kind == "line":
            canvas.polygon(points, colour_of(piece, "white"))
        else:
            canvas.polygon(points, colour_of(piece, "gray"), "black")


def bounds_of(world, folder):
    """The world's bounds, or the box around everything in it."""
    sizes = world.get("world", {})
    if "x_m" in sizes and "y_m" in sizes:
        return (*sizes["x_m"], *sizes["y_m"])
    points = [p for shape, piece in pieces_of(world) for p in outline(shape, piece)]
    points += [mark["position_m"][:2] for mark in world.get("landmark", [])]
    if not points or world.get("grid"):
        sys.exit("picture-of-scene.py: the world file has no bounds, expected x_m and y_m in [world]")
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return (min(xs), max(xs), min(ys), max(ys))


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
    reach = max(math.hypot(*p) for piece in pieces for p in piece)
    canvas.way(placed([(0, 0), (reach, 0)], pose), "black", 0.04)


def read_trace(file):
    """What was where: {time: [(kind, name, pose, manipulators, number within its kind)]}."""
    moments = {}
    with open(file, newline="") as text:
        for row in csv.DictReader(text):
            pose = (float(row["x_m"]), float(row["y_m"]), math.radians(float(row["theta_deg"])))
            states = dict(s.split("=") for s in row["manipulators"].split(";") if s)
            bodies = moments.setdefault(float(row["time_s"]), [])
            number = sum((b[0] == "robot") == (row["kind"] == "robot") for b in bodies)
            bodies.append((row["kind"], row["name"], pose, states, number))
    return moments


def palette_of(frame, entries):
    """A frame in few colours, those of the legend among them however small their bodies are."""
    large = frame.copy()
    draw = ImageDraw.Draw(large)
    for i, (_, _, colour) in enumerate(entries):
        draw.rectangle([0, 12 * i, large.width // 3, 12 * i + 11], fill=colour)
    return frame.quantize(palette=large.quantize(COLOURS, method=Image.Quantize.MEDIANCUT), dither=Image.Dither.NONE)


def changes(before, after):
    """What of a frame differs from the one before, and nothing elsewhere: that is packed to a third."""
    mask = ImageChops.difference(before, after).point(lambda step: 255 if step else 0, "L")
    frame = Image.new("P", after.size, COLOURS)
    frame.putpalette(after.getpalette())
    frame.paste(after, mask=mask)
    return frame


def robots_of(scene, folder):
    """Robot files by the robots' names, those of players among them; the colour of each; what a legend says."""
    entries = [(r["name"], r["file"], None) for r in scene.get("robot", [])]
    for player in scene.get("player", []):
        if "name" not in player or "robot" not in player:
            sys.exit("picture-of-scene.py: a [[player]] without name or robot can't be drawn")
        entries.append((player["name"], player["robot"], player.get("team")))
    files = {name: tomllib.loads((folder / file).read_text()) for name, file, _ in entries}
    free = iter(ROBOTS * (1 + len(entries)))
    colours = {name: TEAMS.get(team) or next(free) for name, _, team in entries}
    legend = {team if team in TEAMS else name: colours[name] for name, _, team in entries}
    return files, colours, [(text, "robot", colour) for text, colour in legend.items()]


def play(ortung, scene, duration, seed):
    with tempfile.TemporaryDirectory() as folder:
        trace = f"{folder}/trace.csv"
        command = [ortung, "sim", str(scene), "--free-run", "--trace", trace]
        if duration:
            command += ["--duration", str(duration)]
        if seed is not None:
            command += ["--seed", str(seed)]
        if subprocess.run(command).returncode != 0:
            sys.exit("picture-of-scene.py: %s could not play %s" % (ortung, scene))
        return read_trace(trace)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[1])
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--out", required=True, help="name of the pictures, without .png and .gif")
    parser.add_argument("--ortung", default="ortung")
    parser.add_argument("--from", dest="begin", type=float, default=0.0)
    parser.add_argument("--duration", type=float)
    parser.add_argument("--seed", type=int)
    parser.add_argument("--width", type=int, default=900)
    args = parser.parse_args()

    scene = tomllib.loads(args.scene.read_text())
    world_file = args.scene.parent / scene["scene"]["world"]
    world = tomllib.loads(world_file.read_text())
    robots, colours, entries = robots_of(scene, args.scene.parent)
    things = [Thing(shape, piece) for shape, piece in pieces_of(world) if is_movable(piece)]
    moments = play(args.ortung, args.scene, args.duration, args.seed)
    moments = {at: bodies for at, bodies in moments.items() if at >= args.begin}
    if not moments:
        sys.exit(f"picture-of-scene.py: the play is over before {args.begin:g} s")

    bounds = bounds_of(world, world_file.parent)
    has_lines = any(piece.get("kind") == "line" for _, piece in pieces_of(world))
    field = Canvas(bounds, args.width, GRASS if has_lines else FLOOR)
    draw_world(field, world, world_file.parent)
    for thing in things:
        if (thing.name, thing.kind, thing.colour) not in entries:
            entries.append((thing.name, thing.kind, thing.colour))

    def draw(canvas, body):
        kind, name, pose, states, number = body
        if kind == "robot":
            draw_robot(canvas, shape_of(robots[name], states), pose, colours[name])
        else:
            canvas.polygon(placed(things[number].points, pose), things[number].colour, "black")

    title = scene["scene"].get("name") or args.scene.stem
    times = list(moments)
    picture = field.copy()
    ways = {}
    for bodies in moments.values():
        for kind, name, pose, _, number in bodies:
            ways.setdefault((kind == "robot", number, name), []).append(pose[:2])
    for (is_robot, number, name), points in ways.items():
        picture.way(points, colours[name] if is_robot else things[number].colour)
    for at in times[::40] + [times[-1]]:  # every 2 s, and the end
        for body in moments[at]:
            draw(picture, body)
    for kind, name, pose, _, _ in moments[times[-1]]:
        if kind == "robot":
            picture.name(pose[:2], name)
    page(picture.finished(), bounds, f"{title}: {times[0]:g} to {times[-1]:g} s, all bodies every 2 s, names at the end",
         entries).save(f"{args.out}.png")

    frames = []
    for at in times[::4]:  # five frames for a second of play, shown at twice its speed
        frame = field.copy()
        for body in moments[at]:
            draw(frame, body)
        small = page(frame.finished(), bounds, f"{title}: {at:5.1f} s", entries)
        small = small.resize((small.width * 3 // 5, small.height * 3 // 5), Image.LANCZOS)
        # One palette for all: then frames can be compared.
        palette = frames[0] if frames else palette_of(small, entries)
        frames.append(small.quantize(palette=palette, dither=Image.Dither.NONE))
    others = [changes(*pair) for pair in zip(frames, frames[1:])]
    frames[0].save(f"{args.out}.gif", save_all=True, append_images=others, duration=100, loop=0, optimize=False,
                   transparency=COLOURS, disposal=1)
    print(f"{args.out}.png, {args.out}.gif: {len(frames)} frames")


if __name__ == "__main__":
    main()
