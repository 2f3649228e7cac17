"""test_pictures.py SCRIPT  what scripts/pictures.py draws, against where things stand in the worlds."""
import functools
import importlib.util
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import matplotlib
    import matplotlib.pyplot as plt
    import numpy as np
    from PIL import Image
except ImportError as missing:
    print(f"test_pictures.py: Skipped\n{missing} (python3-numpy python3-matplotlib python3-pil)")
    sys.exit(77)
matplotlib.use("Agg")

SCRIPT = pathlib.Path(sys.argv.pop(1))
spec = importlib.util.spec_from_file_location("pictures", SCRIPT)
pictures = importlib.util.module_from_spec(spec)
sys.modules["pictures"] = pictures  # dataclasses look their module up
spec.loader.exec_module(pictures)
pictures.chart = functools.cache(pictures.chart)

CELL = 0.1  # [m]
POST_1 = (-6.5, -4.5)  # of maps/fields/f2000.toml
GOALS = [(-11.0, 0.0), (11.0, 0.0)]  # of maps/fields/msl.toml
PANELS = {panel.title: panel for panel in pictures.SENSORS + pictures.DERIVED}


def centres(seen):
    """x and y of each cell of a chart, (rows, columns) each."""
    rows, columns = seen.p.shape
    x = seen.extent[0] + (np.arange(columns) + 0.5) * CELL
    y = seen.extent[2] + (np.arange(rows) + 0.5) * CELL
    return np.meshgrid(x, y)


def places(seen, share=0.9):
    """Cells whose p is at least that share of the greatest one, (N, 2) [m]."""
    x, y = centres(seen)
    chosen = np.nan_to_num(seen.p, nan=-np.inf) >= share * np.nanmax(seen.p)
    return np.stack([x[chosen], y[chosen]], axis=1)


def best(seen):
    x, y = centres(seen)
    at = np.nanargmax(seen.p)
    return x.flat[at], y.flat[at]


class Charts(unittest.TestCase):
    def chart(self, title):
        return pictures.chart(PANELS[title])

    def test_scans_sonars_lines_and_posts_are_likeliest_where_they_were_seen(self):
        # On a field that is the same after half a turn, also at the opposite place.
        for title, within in [("lrf: one scan", 0.15), ("sonar: a ring of them", 0.25), ("iconic_omnivision: lines", 0.3),
                              ("lrf_cylinders: posts", 0.15), ("lrf_iconic: position", 0.15)]:
            with self.subTest(title):
                seen = self.chart(title)
                found, there = best(seen), seen.pose[:2]
                offset = math.dist(found, there)
                if title != "sonar: a ring of them":
                    offset = min(offset, math.dist(found, (-there[0], -there[1])))
                self.assertLess(offset, within)

    def test_both_places_of_a_symmetric_field_are_dark(self):
        seen = self.chart("lrf_iconic: position")
        x, y, _ = seen.pose
        for place in places(seen):
            self.assertLess(min(math.dist(place, (x, y)), math.dist(place, (-x, -y))), 0.2)
        for there in [(x, y), (-x, -y)]:
            self.assertLess(min(math.dist(place, there) for place in places(seen)), 0.15)

    def test_a_distance_is_a_circle(self):
        seen = self.chart("landmarks: one distance")
        distance = math.dist(seen.pose[:2], POST_1)
        sigma = 0.1 + 0.05 * distance  # of maps/robots/pioneer_posts.toml
        apart = np.hypot(*(places(seen) - POST_1).T)
        self.assertLess(np.ptp(apart), 2 * sigma)
        self.assertLess(abs(apart.mean() - distance), 3 * sigma)

    def test_a_bearing_is_a_wedge(self):
        seen = self.chart("landmarks: one bearing")
        truth = math.atan2(POST_1[1] - seen.pose[1], POST_1[0] - seen.pose[0])
        towards = np.arctan2(*(POST_1 - places(seen)).T[::-1])
        off = np.degrees(np.angle(np.exp(1j * (towards - truth))))
        self.assertLess(np.ptp(off), 2 * 3)  # sigma is 3 degrees
        self.assertLess(abs(off.mean()), 3 * 3)

    def test_a_goal_that_is_not_identified_is_a_circle_around_each(self):
        seen = self.chart("iconic_omnivision: goals")
        truth = min(math.dist(seen.pose[:2], goal) for goal in GOALS)
        nearest = np.min([np.hypot(*(places(seen) - goal).T) for goal in GOALS], axis=0)
        self.assertLess(abs(nearest.mean() - truth), 3 * (0.02 + 0.03 * truth))  # noise of maps/robots/msl_omni.toml
        self.assertLess(np.ptp(nearest), 2 * (0.2 + 0.05 * truth))  # the model's sigma there
        self.assertTrue((places(seen)[:, 0] < 0).any() and (places(seen)[:, 0] > 0).any())

    def test_a_teammate_sees_the_robot_where_it_is(self):
        seen = self.chart("teammate: position")
        panel = PANELS["teammate: position"]
        distance = math.dist(panel.lookout[:2], seen.pose[:2])
        self.assertLess(math.dist(best(seen), seen.pose[:2]), 3 * (0.02 + 0.03 * distance))  # of maps/robots/lookout.toml

    def test_a_compass_tells_the_heading_and_no_place(self):
        seen = self.chart("compass")
        self.assertLess(np.nanmax(seen.p) - np.nanmin(seen.p), 1e-9)
        heading = pictures.HEADINGS[seen.by_heading.argmax()]
        self.assertLess(abs(math.degrees(heading - seen.pose[2])), 3 * 2 + 2)  # noise of 2 degrees, a step of 2
        far = np.abs(np.degrees(pictures.HEADINGS - heading)) > 50  # five sigmas of the model
        self.assertLess(seen.by_heading[far].max(), 0.11)  # `outliers` is 0.1


class Drawn(unittest.TestCase):
    def test_the_ring_is_where_the_robot_is_and_the_place_in_it_is_black(self):
        panel = PANELS["lrf: one scan"]
        figure = plt.figure(figsize=(7.0, 5.0), dpi=100)
        axes = figure.add_axes([0, 0, 1, 1])
        pictures.draw_panel(axes, panel)
        figure.canvas.draw()
        pixels = np.asarray(figure.canvas.buffer_rgba())[:, :, :3].astype(int)
        rows, columns = np.nonzero((pixels[:, :, 0] > 200) & (pixels[:, :, 1:].max(axis=2) < 60))
        self.assertGreater(len(rows), 20)
        row, column = rows.mean(), columns.mean()
        x, y = axes.transData.inverted().transform((column + 0.5, pixels.shape[0] - row - 0.5))
        self.assertLess(math.dist((x, y), panel.place[:2]), CELL)
        inside = pixels[round(row) - 3:round(row) + 4, round(column) - 3:round(column) + 4].sum(axis=2)
        self.assertLess(inside.min(), 30)
        self.assertGreater(np.median(pixels.sum(axis=2)), 300)
        plt.close(figure)

    def test_the_script_writes_pictures(self):
        with tempfile.TemporaryDirectory() as folder:
            robot, derived = pathlib.Path(folder) / "robot.png", pathlib.Path(folder) / "derived.png"
            subprocess.run([sys.executable, "-B", SCRIPT, "robot", "--out", robot], check=True)
            pictures.draw_derived(derived)
            for file, size in [(robot, (560, 400)), (derived, (760, 560))]:
                with Image.open(file) as picture:
                    self.assertEqual(picture.size, size)
                    self.assertGreater(len(picture.convert("RGB").getcolors(1 << 20)), 20)

    def test_a_kidnapping_has_a_frame_each_0_3_s(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "kidnap.gif"
            pictures.draw_kidnap(out, seconds=0.9, kidnapped=0.5)
            with Image.open(out) as picture:
                self.assertEqual(picture.n_frames, 3)


if __name__ == "__main__":
    unittest.main()
