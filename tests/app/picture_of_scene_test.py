#!/usr/bin/python3
"""picture_of_scene_test.py SCRIPT ORTUNG  scripts/picture-of-scene.py draws things as they are, where they are."""
import pathlib
import subprocess
import sys
import tempfile

try:
    from PIL import Image
except ImportError:
    print("picture_of_scene_test.py: Skipped\nPillow (python3-pil) is not here")  # as scripts/skipped.py reads it
    sys.exit(77)

WORLD = """
[world]
name = "boxes"
x_m = [-3, 3]
y_m = [-2, 2]
[[rectangle]]
kind = "wall"
center_m = [2.95, 0]
size_m = [0.1, 4]
[[ellipse]]
kind = "ball"
center_m = [-1, -1]
size_m = [0.3, 0.3]
[[rectangle]]
name = "crate"
movable = true
mass_kg = 2
center_m = [1, 1]
size_m = [1.0, 0.4]
angle_deg = 90
colour = "#112233"
"""
SCENE = """
[scene]
world = "boxes.toml"
duration_s = 1
[[robot]]
file = "robot.toml"
name = "still"
start = { x_m = -2, y_m = 1, theta_deg = 0 }
"""
LINE = """
[[rectangle]]
kind = "line"
center_m = [0, 0]
size_m = [0.1, 1]
"""


def drawn(folder, script, ortung, world):
    (folder / "boxes.toml").write_text(world)
    subprocess.run([script, folder / "scene.toml", "--ortung", ortung, "--out", folder / "out", "--width", "600"],
                   check=True, stdout=subprocess.DEVNULL)
    return Image.open(folder / "out.png").convert("RGB"), Image.open(folder / "out.gif")


def main():
    script, ortung = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.toml").write_text(SCENE)
        (folder / "robot.toml").write_text('[robot]\nname = "still"\nradius_m = 0.3\n[[sensor]]\nplugin = "odometry"\n')
        picture, play = drawn(folder, script, ortung, WORLD)

        # 100 pixels a metre; the field begins behind the frame's line, at the first dark row and column.
        top = next(y for y in range(picture.height) if picture.getpixel((picture.width // 2, y)) == (29, 39, 51)
                   and picture.getpixel((picture.width // 2 + 100, y)) == (29, 39, 51)) + 1
        left = next(x for x in range(picture.width) if all(picture.getpixel((x, top + dy)) == (29, 39, 51)
                                                           for dy in range(50))) + 1

        def at(x, y):
            return picture.getpixel((left + round((x + 3) * 100), top + round((2 - y) * 100)))

        crate, orange, floor = (17, 34, 51), (255, 140, 0), (228, 231, 235)
        assert at(1.0, 1.4) == crate and at(1.1, 0.6) == crate, "the crate is a box, turned by 90 degrees"
        assert at(1.4, 1.0) == floor, "and no larger"
        assert at(-1.0, -1.0) == orange and at(-1.0, -1.25) == floor, "the ball is a ball"
        assert at(0.0, 0.0) == floor, "a floor without painted lines is no grass"
        assert at(-2.1, 1.1) == (86, 180, 233), "the robot has the first colour"
        below = picture.crop((0, top + 400, picture.width, picture.height))
        seen = {colour for _, colour in below.getcolors(1 << 20)}
        assert {crate, orange, (86, 180, 233)} <= seen, "the legend has all colours"
        clocks = []
        for frame in (0, play.n_frames - 1):
            play.seek(frame)
            clocks.append(play.convert("RGB").crop((0, 0, play.width, 20)).tobytes())
        assert clocks[0] != clocks[1], "the clock goes"

        picture, _ = drawn(folder, script, ortung, WORLD + LINE)
        assert at(1.0, -1.0) == (47, 107, 60), "lines are painted on grass"

        # 8 x 8 m of floor, one of its cells of 0.5 m black and one unknown: 8 and 5 cells along the rows, 4 and 10 up. Turned by a
        # quarter, rows go up and columns to the left.
        cells = bytearray([254] * 256)
        cells[16 * (15 - 4) + 8], cells[16 * (15 - 10) + 5] = 0, 205
        (folder / "map.pgm").write_bytes(b"P5 16 16 255\n" + cells)
        for origin, places in (("-4, -4, 0", ((0.25, -1.75), (-1.25, 1.25))), ("4, -4, 1.5707963", ((1.75, 0.25), (-1.25, -1.25)))):
            (folder / "map.yaml").write_text("image: map.pgm\nresolution: 0.5\norigin: [%s]\n" % origin)
            picture, _ = drawn(folder, script, ortung, WORLD + '[[grid]]\nmap = "map.yaml"\n')
            seen = [at(*place)[0] for place in (*places, (2.25, -1.75))]
            assert seen == [0, 205, 254], "a map at %s: %s" % (origin, seen)


if __name__ == "__main__":
    main()
