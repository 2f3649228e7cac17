#!/usr/bin/python3
"""pictures.py robot|sensors|derived|kidnap --out FILE  draws pictures of the pages by the package `ortung`.

Each is made of a simulation:

  robot    a robot file: its body, and where its sensors sit and look (PNG)
  sensors  p(s given l) of one reading of each kind of sensor (PNG)
  derived  the same of cylinders and positions found in a scan, of a teammate's sighting and of a compass (PNG)
  kidnap   the samples of a filter whose robot is carried away (GIF)

Needs python3-matplotlib and python3-pil, and the folder of the package in PYTHONPATH, e.g. build/dev/lib/python.
"""
import argparse
import dataclasses
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


@dataclasses.dataclass(frozen=True)
class Panel:
    """One reading, and how the map of its p is drawn."""

    title: str
    world: str
    robot: str  # of maps/robots, or the text of a robot file
    features: tuple  # whose readings are weighed
    place: tuple  # the robot's pose
    least: float | None = None  # least ln p that is drawn, below that of the best place; None: p itself
    own_heading: bool = False  # whether p is that at the robot's heading, not at the best one
    lookout: tuple | None = None  # where a teammate stands that sees the robot


SENSORS = [
    Panel("lrf: one scan", "f2000", "pioneer_lrf", ("LMS200/LRF/*",), (2.3, -1.2, 0.5), -12),
    Panel("sonar: a ring of them", "arena", "sonar_ring", ("polaroid/ultrasonic/*",), (1.0, -0.8, 0.5), -12),
    Panel("landmarks: one distance", "f2000", "pioneer_posts", ("omnivision/camera/post1Distance",), (2.3, -1.2, 0.5)),
    # A bearing fits everywhere at one heading or another.
    Panel("landmarks: one bearing", "f2000", "pioneer_posts", ("omnivision/camera/post1Bearing",), (2.3, -1.2, 0.5),
          own_heading=True),
    Panel("iconic_omnivision: lines", "msl", "msl_omni", ("omnivision/camera/lines",), (4.0, -2.0, 0.5), -12),
    Panel("iconic_omnivision: goals", "msl", "msl_omni", ("omnivision/camera/goals",), (4.0, -2.0, 0.5)),
]

WHEELS = """
[robot]
name = "example"
radius_m = 0.25

[[sensor]]
plugin = "odometry"

[[sensor]]
"""
SCANNER = WHEELS + """
plugin = "lrf"
beams = 361
max_range_m = 8
noise_sigma_m = 0.02
noise_sigma_per_m = 0
localizes = false

[[sensor]]
reads = "LMS200/LRF/180DegreeScan"
"""
# Sigmas as wide as cells, which the picture needs to show every place.
CYLINDERS = """
plugin = "lrf_cylinders"
kind = "post"
radius_m = 0.1
range_sigma_m = 0.1
bearing_sigma_deg = 2
"""
DERIVED = [
    Panel("lrf_cylinders: posts", "f2000", SCANNER + CYLINDERS, ("LMS200/LRF/cylinders",), (3.0, -0.5, 0.0), -6),
    Panel("lrf_iconic: position", "f2000", SCANNER + 'plugin = "lrf_iconic"', ("LMS200/LRF/position",), (3.3, -1.2, 0.5)),
    Panel("teammate: position", "f2000", WHEELS + 'plugin = "teammate"', ("radio/teammate/position",), (2.3, -1.2, 0.5),
          lookout=(-2.0, 2.0, 0.0)),
    Panel("compass", "f2000", WHEELS + 'plugin = "compass"\nnoise_sigma_deg = 2', ("compass/compass/north",),
          (2.3, -1.2, 0.5), own_heading=True),
]
HEADINGS = np.radians(np.arange(-180, 181, 2))


@dataclasses.dataclass
class Chart:
    """p(s|l) of the readings of a panel."""

    p: np.ndarray  # (rows, columns) from the lower left corner, or its logarithm; NaN: no robot can be there
    extent: tuple  # of the field: least and greatest x, y [m]
    pose: tuple  # where the readings were made: x, y [m], heading [rad]
    by_heading: np.ndarray  # p at that place and each of HEADINGS


def chart(panel):
    """Simulates the robot of a panel for half a second, and returns how probable its readings are."""
    world = MAPS / f"fields/{panel.world}.toml"
    with tempfile.TemporaryDirectory() as folder:
        robot = MAPS / f"robots/{panel.robot}.toml"
        if "\n" in panel.robot:
            robot = pathlib.Path(folder) / "robot.toml"
            robot.write_text(panel.robot)
        here = ortung.Localization(robot, learned(world, robot, folder))
        simulation = ortung.Simulation(world)
        body = simulation.add_robot(robot, start=panel.place, name="seen")
    if panel.lookout:
        simulation.add_robot(MAPS / "robots/lookout.toml", start=panel.lookout).play("lookout:of=seen")
    advance(simulation, body, here, 0.5)
    headings = [body.pose[2]] if panel.own_heading else None
    p = here.probability_map(list(panel.features), headings, panel.least is not None)
    by_heading = [here.container.probability(*body.pose[:2], heading) for heading in HEADINGS]
    return Chart(p, here.extent, body.pose, np.array(by_heading))


def draw_panel(axes, panel):
    seen = chart(panel)
    lowest = np.nanmax(seen.p) + panel.least if panel.least else 0.0
    # Black is the most probable place, and what is alike everywhere is grey.
    highest = np.nanmax(seen.p) if np.nanmin(seen.p) < np.nanmax(seen.p) else 2.0 * np.nanmax(seen.p)
    axes.imshow(seen.p, origin="lower", extent=seen.extent, cmap="Greys", interpolation="nearest", vmin=lowest,
                vmax=highest)
    axes.set_facecolor("#e8d8c0")
    axes.plot(*seen.pose[:2], "o", markerfacecolor="none", markeredgecolor="red", markersize=10)
    axes.set_title(panel.title)
    axes.set_xticks([])
    axes.set_yticks([])
    if panel.title == "compass":
        curve = axes.inset_axes([0.04, 0.55, 0.52, 0.41])
        curve.plot(np.degrees(HEADINGS), seen.by_heading, color="black", linewidth=1.2)
        curve.axvline(math.degrees(seen.pose[2]), color="red", linewidth=0.8)
        curve.set(xticks=[-180, 0, 180], yticks=[0, 1], xlim=(-180, 180), ylim=(0, 1.1))
        curve.tick_params(labelsize=7, pad=1)
        curve.set_xlabel("heading [deg]", fontsize=7, labelpad=1)


def draw_panels(out, panels, rows, size):
    figure, all_axes = plt.subplots(rows, len(panels) // rows, figsize=size, layout="constrained")
    for axes, panel in zip(all_axes.flat, panels):
        draw_panel(axes, panel)
    figure.savefig(out, dpi=100)


def draw_sensors(out):
    draw_panels(out, SENSORS, 2, (10.5, 5.2))


def draw_derived(out):
    draw_panels(out, DERIVED, 2, (7.6, 5.6))


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
    parser.add_argument("what", choices=["robot", "sensors", "derived", "kidnap"])
    parser.add_argument("--out", required=True, help="the picture")
    arguments = parser.parse_args()
    draw = {"robot": draw_robot, "sensors": draw_sensors, "derived": draw_derived, "kidnap": draw_kidnap}
    draw[arguments.what](arguments.out)


if __name__ == "__main__":
    main()
