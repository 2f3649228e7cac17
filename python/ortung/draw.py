"""Pictures by Matplotlib (Debian's python3-matplotlib), one call each: world(), robot(), map(), run().

Each draws into `axes`, or into those of a new figure, in the field's frame [m], and returns the axes; `axes.figure`
is what savefig() belongs to. Matplotlib is loaded with the first picture.
"""
import os

import numpy as np

from ._arguments import need, plainly, shown
from ._core import EvaluatedRun, Localization, Robot
from ._needs import needs

__all__ = ["map", "robot", "run", "world"]

_PALE = 0.05  # share of cells at the pale end of a logarithmic scale, as in the pictures of `ortung show`
_TRUE_WAY = 6.0  # width of its line, on which good estimates lie [points]
_STATUS_COLOURS = {"tracking": "tab:green", "uncertain": "tab:orange", "lost": "tab:red"}


def _axes(axes):
    """Returns the axes to draw in, with both coordinates in one scale."""
    if axes is None:
        try:
            from matplotlib import pyplot
        except ImportError as error:
            raise ImportError(needs("pictures", "Matplotlib", ["python3-matplotlib"], error)) from error
        _, axes = pyplot.subplots(layout="constrained")
    elif not hasattr(axes, "set_aspect"):
        raise TypeError(f"axes is {shown(axes)}, expected axes of Matplotlib, or None")
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    return axes


@plainly
def world(world, axes=None):
    """Draws a World, or the file of one: walls, bodies, painted lines and landmarks."""
    from . import World

    if not isinstance(world, (World, str, os.PathLike)):
        raise TypeError(f"world(): world is {shown(world)}, expected a World, or the file of one")
    world = world if isinstance(world, World) else World(world)
    axes = _axes(axes)
    for line in world.lines:
        axes.plot(*line["points"].T, color="lightgrey", linewidth=1.0, zorder=1)
    for thing in world.objects:
        for outline in thing["outlines"]:
            axes.fill(*outline.T, facecolor="0.6", edgecolor="0.2", linewidth=0.6, zorder=2)
    for x0, y0, x1, y1, _, _ in world.walls:
        axes.plot((x0, x1), (y0, y1), color="black", linewidth=1.0, zorder=2)
    if world.landmarks:
        axes.plot(*np.array([mark["position"][:2] for mark in world.landmarks]).T, "d", color="tab:purple",
                  markersize=5, zorder=3, label="landmarks")
    left, right, low, high = world.extent
    margin = 0.02 * max(right - left, high - low)
    axes.set_xlim(left - margin, right + margin)
    axes.set_ylim(low - margin, high + margin)
    axes.set_title(world.name)
    return axes


def _arrow(axes, pose, length, **style):
    x, y, heading = pose
    axes.annotate("", (x + length * np.cos(heading), y + length * np.sin(heading)), (x, y),
                  arrowprops={"arrowstyle": "->", "shrinkA": 0, "shrinkB": 0, **style})


@plainly
def robot(robot, pose=(0.0, 0.0, 0.0), axes=None, reach=None):
    """Draws a Robot at a pose (x, y, heading) [m, rad]: its body, and where each sensor sits and looks.

    reach: length of the drawn fields of view [m]; None: three times the robot's radius."""
    need("robot", "robot", robot, Robot, "of a robot file: ortung.Robot(FILE)")
    axes = _axes(axes)
    x, y, heading = pose
    radius = robot.radius
    reach = 3.0 * radius if reach is None else reach
    turn = np.linspace(0.0, 2.0 * np.pi, 60)
    axes.fill(x + radius * np.cos(turn), y + radius * np.sin(turn), facecolor="lightsteelblue", edgecolor="black",
              zorder=3)
    _arrow(axes, pose, radius, color="black")
    colours, drawn = {}, set()
    for feature, sensor in robot.sensors.items():
        mount_x, mount_y, turned = sensor["mount"]
        at = np.array([x + mount_x * np.cos(heading) - mount_y * np.sin(heading),
                       y + mount_x * np.sin(heading) + mount_y * np.cos(heading)])
        device = feature.rpartition("/")[0]
        if (device, *sensor["mount"]) in drawn:  # of a ring each one sits elsewhere
            continue
        drawn.add((device, *sensor["mount"]))
        name = None if device in colours else device
        colour = colours.setdefault(device, f"C{len(colours) % 10}")
        axes.plot(*at, "o", color=colour, markersize=4, zorder=5, label=name)
        if sensor["fov"]:
            rays = heading + turned + np.linspace(-0.5, 0.5, 40) * sensor["fov"]
            edge = at + reach * np.column_stack([np.cos(rays), np.sin(rays)])
            axes.fill(*np.vstack([at, edge]).T, facecolor=colour, alpha=0.15, zorder=2)
    if colours:
        axes.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1.0, 1.0))
    axes.set_title(robot.name)
    return axes


def _has_readings(localization):
    container = localization.container
    return any(container.stamp(feature) is not None for feature in container.features)


@plainly
def map(localization, features=None, *, log=False, headings=None, pose=None, axes=None):
    """Draws p(s|l) of a Localization's present readings, as its probability_map(), with the samples.

    features: a name, a pattern, or a list of them, as of probability_map(). The darker, the more probable, as in the pictures of `ortung show`; grey is where no robot can be. log: colours
    stand for ln p(s|l); the least twentieth of the cells has the palest one. pose: (x, y, heading) that is marked, e.g. the truth [m, rad].
    The title says so if there is no reading yet: then all poses are equally probable."""
    need("map", "localization", localization, Localization, "of a robot file and tables: ortung.Localization(ROBOT, TABLES)")
    axes = _axes(axes)
    chart = localization.probability_map(features, headings, log)
    extent = localization.extent
    values = chart[np.isfinite(chart)]
    most = values.max() if values.size else 0.0
    least = np.quantile(values, _PALE) if log and values.size else 0.0
    picture = axes.imshow(chart, origin="lower", extent=extent, cmap="YlGnBu", interpolation="nearest", vmin=least,
                          vmax=most if most > least else least + 1.0)
    axes.set_facecolor("0.62")  # of cells without a value
    axes.figure.colorbar(picture, ax=axes, label="ln p(s|l)" if log else "p(s|l)", extend="min" if log else "neither")
    samples = localization.samples
    axes.plot(samples["x"], samples["y"], ".", color="black", markersize=1.0, alpha=0.4)
    if pose is not None:
        axes.plot(pose[0], pose[1], "o", markerfacecolor="none", markeredgecolor="red", markersize=10)
        _arrow(axes, pose, 0.05 * (extent[1] - extent[0]), color="red")
    axes.set_xlim(extent[0], extent[1])
    axes.set_ylim(extent[2], extent[3])
    if not _has_readings(localization):
        axes.set_title("no reading yet: all poses are equally probable")
    return axes


@plainly
def run(run, world=None, axes=None):
    """Draws an EvaluatedRun: the true way as a grey band, and on it the estimates in the colour of their status.

    world: a World, or the file of one, that is drawn below."""
    need("run", "run", run, EvaluatedRun, "of evaluate()")
    from . import draw

    axes = _axes(axes) if world is None else draw.world(world, axes)
    axes.plot(*run.truth[:, :2].T, color="0.45", alpha=0.5, linewidth=_TRUE_WAY, solid_capstyle="round", zorder=4,
              label="truth")
    status = run.status
    for name, colour in _STATUS_COLOURS.items():
        chosen = status == name
        if chosen.any():
            axes.plot(*run.estimates[chosen, :2].T, ".", color=colour, markersize=3, zorder=5, label=name)
    axes.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1.0, 1.0))
    axes.set_title(f"{run.robot} in {run.world}: {run.figures['position_rmse_m']:.3f} m RMS")
    return axes
