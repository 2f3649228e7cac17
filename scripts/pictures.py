#!/usr/bin/python3
"""pictures.py robot|sensors|kidnap --out FILE  draws pictures of the pages by the Python package `ortung`, from simulations.

  robot    a robot file: its body, and where its sensors sit and look (PNG)
  sensors  p(s given l) of one reading of each kind of sensor that localizes (PNG)
  kidnap   the samples of a filter whose robot is carried away (GIF)

Needs python3-matplotlib and python3-pil, and the folder of the package in PYTHONPATH, e.g. build/dev/lib/python.
"""
import argparse
import io
import math
import pathlib
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import ortung  # noqa: E402
from PIL import Image  # noqa: E402

MAPS = pathlib.Path(__file__).resolve().parent.parent / "maps"
FIELD = MAPS / "fields/f2000.toml"
COLOURS = {"tracking": "tab:green", "uncertain": "tab:orange", "lost": "tab:red"}


def learned(world, robot, folder):
    """Returns the file of tables of a robot in a world."""
    out = pathlib.Path(folder) / "tables.ortung"
    ortung.learn(world, robot, out, cell=0.1, heading_step_deg=4.0)
    return out


def advance(simulation, body, here, seconds):
    """Simulates for so long, and passes the robot's readings on."""
    for _ in range(round(seconds / simulation.cycle)):
        simulation.step()
        for reading in body.readings:
            here.container.set(*reading)


def draw_robot(out):
    axes = ortung.draw.robot(ortung.Robot(MAPS / "robots/laboratory.toml"))
    axes.figure.set_size_inches(5.6, 4.0)
    axes.figure.savefig(out, dpi=100)


# Title, world, robot, the features whose readings are weighed, the robot's pose, and the least ln p that is drawn, below that
# of the best place; None: p itself.
PANELS = [
    ("lrf: one scan", "f2000", "pioneer_lrf", ["LMS200/LRF/*"], (2.3, -1.2, 0.5), -12),
    ("sonar: a ring of them", "arena", "sonar_ring", ["polaroid/ultrasonic/*"], (1.0, -0.8, 0.5), -12),
    ("landmarks: one distance", "f2000", "pioneer_posts", ["omnivision/camera/post1Distance"], (2.3, -1.2, 0.5), None),
    ("landmarks: one bearing", "f2000", "pioneer_posts", ["omnivision/camera/post1Bearing"], (2.3, -1.2, 0.5), None),
    ("iconic_omnivision: lines", "msl", "msl_omni", ["omnivision/camera/lines"], (4.0, -2.0, 0.5), -12),
    ("iconic_omnivision: goals", "msl", "msl_omni", ["omnivision/camera/goals"], (4.0, -2.0, 0.5), None),
]


def draw_sensors(out):
    figure, all_axes = plt.subplots(2, 3, figsize=(10.5, 5.2), layout="constrained")
    for axes, (title, world, robot, features, place, least) in zip(all_axes.flat, PANELS):
        world, robot = MAPS / f"fields/{world}.toml", MAPS / f"robots/{robot}.toml"
        with tempfile.TemporaryDirectory() as folder:
            here = ortung.Localization(robot, learned(world, robot, folder))
        simulation = ortung.Simulation(world)
        body = simulation.add_robot(robot, start=place)
        advance(simulation, body, here, 0.5)
        # A bearing fits everywhere at one heading or another, so it is drawn at the robot's.
        headings = [body.pose[2]] if title.endswith("bearing") else None
        chart = here.probability_map(features, headings, least is not None)
        lowest = np.nanmax(chart) + least if least else 0.0
        axes.imshow(chart, origin="lower", extent=here.extent, cmap="Greys", interpolation="nearest", vmin=lowest)
        axes.set_facecolor("#e8d8c0")
        axes.plot(*body.pose[:2], "o", markerfacecolor="none", markeredgecolor="red", markersize=10)
        axes.set_title(title)
        axes.set_xticks([])
        axes.set_yticks([])
    figure.savefig(out, dpi=100)


def frame(world, here, body, estimate, way, second, note):
    """Returns one picture: the field, the samples, the estimate and the robot."""
    axes = ortung.draw.world(world)
    axes.figure.set_size_inches(6.4, 4.4)
    axes.set(xlabel="", ylabel="", xticks=[], yticks=[], title="")
    samples = here.samples
    axes.plot(samples["x"], samples["y"], ".", color="tab:blue", markersize=3, alpha=0.5, zorder=4)
    axes.plot(*np.array(way).T, color="black", linewidth=0.8, zorder=4)
    x, y, heading = body.pose
    axes.plot(x, y, "o", markerfacecolor="none", markeredgecolor="black", markersize=13, zorder=6)
    axes.plot([x, x + 0.4 * math.cos(heading)], [y, y + 0.4 * math.sin(heading)], color="black", zorder=6)
    axes.plot(estimate.x, estimate.y, "x", color=COLOURS[estimate.status], markersize=9, markeredgewidth=2.5, zorder=7)
    axes.set_title(f"{second:4.1f} s   {estimate.status:<10} {note}", family="monospace", fontsize=10, loc="left")
    picture = io.BytesIO()
    axes.figure.savefig(picture, dpi=70)
    plt.close(axes.figure)
    return Image.open(picture).convert("RGB")


def draw_kidnap(out, seconds=14.0, kidnapped=2.4, place=(-1.0, 1.8, 2.2)):
    robot = MAPS / "robots/pioneer_near.toml"  # it sees goals and posts within 4 m, so a scan alone has two places
    with tempfile.TemporaryDirectory() as folder:
        here = ortung.Localization(robot, learned(FIELD, robot, folder), start=(2.0, -1.0, 0.0))
    simulation = ortung.Simulation(FIELD, seed=4)
    body = simulation.add_robot(robot, start=(2.0, -1.0, 0.0))
    body.wander(0.5)
    world = ortung.World(FIELD)
    pictures, way, carried, estimate = [], [], False, None
    period = 0.1
    for step in range(round(seconds / period)):
        second = step * period
        if not carried and second >= kidnapped:
            body.place(*place)
            carried, way = True, []
        advance(simulation, body, here, period)
        estimate = here.update() or here.estimate(simulation.now) or estimate
        way.append(body.pose[:2])
        if estimate and step % 3 == 0:
            error = math.dist(body.pose[:2], (estimate.x, estimate.y))
            note = f"error {error:5.2f} m" + ("   carried away" if 0 <= second - kidnapped < 1.5 else "")
            pictures.append(frame(world, here, body, estimate, way, second, note))
    first, *others = [picture.quantize(48, dither=Image.Dither.NONE) for picture in pictures]
    first.save(out, save_all=True, append_images=others, duration=200, loop=0, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["robot", "sensors", "kidnap"])
    parser.add_argument("--out", required=True, help="the picture")
    arguments = parser.parse_args()
    {"robot": draw_robot, "sensors": draw_sensors, "kidnap": draw_kidnap}[arguments.what](arguments.out)


if __name__ == "__main__":
    main()
