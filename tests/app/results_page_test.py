"""Tables that are printed get into the page behind their marks, and nothing else of it changes; the page of figures and its
charts are what the tables say."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.path.insert(0, sys.argv.pop(1))
import results_charts  # noqa: E402  (they are beside the script that is tried)
import results_figures  # noqa: E402
import results_page  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(results_page.__file__)))

PAGE = """# Page

<!-- table: Laser -->

| old | table |
|---|---|
| 1 | 2 |

Text after it.

<!-- table: Faults: share of time lost -->

More text.
"""

PRINTED = """
## Laser, three seeds

| log | error |
|---|---|
| intel | 0.03 |
- never right: intel

## Faults: share of time lost, mean / worst

| fault | lost |
|---|---|
"""


class ResultsPage(unittest.TestCase):
    def test_tables_are_found_by_the_heading_above_them(self):
        found = results_page.tables_of(PRINTED)
        self.assertEqual(found["Laser"], ["| log | error |", "|---|---|", "| intel | 0.03 |"])
        self.assertEqual(found["Faults: share of time lost"], ["| fault | lost |", "|---|---|"])

    def test_tables_take_the_place_of_those_behind_their_marks(self):
        page, missing = results_page.put(PAGE, results_page.tables_of(PRINTED))
        self.assertEqual(missing, [])
        self.assertNotIn("| old |", page)
        self.assertIn("<!-- table: Laser -->\n\n| log | error |\n|---|---|\n| intel | 0.03 |\n\nText after it.\n", page)
        self.assertIn("lost -->\n\n| fault | lost |\n|---|---|\n\nMore text.\n", page)
        again, _ = results_page.put(page, results_page.tables_of(PRINTED))
        self.assertEqual(again, page)

    def test_tables_say_which_sources_they_are_of(self):
        of = results_page.commit()
        if of == results_page.MEASURED + ".":
            self.skipTest("these sources are in no repository of git")
        self.assertRegex(of, r"^Measured at commit `[0-9a-f]{7,}` of \d{4}-\d\d-\d\d(, with changes)?\.$")
        tables = results_page.tables_of(PRINTED)
        first, _ = results_page.put(PAGE, tables, "Measured at commit `0` of then.")
        page, _ = results_page.put(first, tables, of)
        self.assertIn("<!-- table: Laser -->\n\n%s\n\n| log | error |\n" % of, page)
        self.assertIn("<!-- table: Faults: share of time lost -->\n\n%s\n\n| fault | lost |\n" % of, page)
        self.assertEqual(page.count("Measured at"), 2)

    def test_a_table_without_a_mark_is_named_and_changes_nothing(self):
        page, missing = results_page.put(PAGE, {"Sonar": ["| a |"]})
        self.assertEqual(page, PAGE)
        self.assertEqual(missing, ["<!-- table: Sonar -->"])

    def test_what_fails_leaves_the_page_as_it_was(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "page.md")
            with open(file, "w") as page:
                page.write(PAGE)
            with self.assertRaises(SystemExit), results_page.written(file):
                print(PRINTED)
                sys.exit("a command failed")
            with open(file) as page:
                self.assertEqual(page.read(), PAGE)
            self.assertEqual(os.listdir(folder), ["page.md"])

    def test_more_goals_are_those_of_the_same_situations(self):
        truth = [False] * 50 + [True] * 50
        self.assertEqual(results_page.more_goals(truth, truth), "+0.0 [+0.0, +0.0]")
        self.assertEqual(results_page.more_goals([True] * 100, [False] * 100), "+100.0 [+100.0, +100.0]")

    def test_a_folder_gets_each_table_into_the_page_that_has_its_mark(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("a.md", "<!-- table: Laser -->\n"), ("b.md", "<!-- table: Faults: share of time lost -->\n")):
                with open(os.path.join(folder, name), "w") as page:
                    page.write(text)
            with results_page.written(folder):
                print(PRINTED)
            texts = [open(os.path.join(folder, name)).read() for name in ("a.md", "b.md")]
        self.assertIn("| intel | 0.03 |", texts[0])
        self.assertNotIn("fault", texts[0])
        self.assertIn("| fault | lost |", texts[1])


TABLE = """# Speed

<!-- table: Speed -->

Measured at commit `abcdef12` of 2026-01-02.

| log | who | ms | right |
|---|---|---|---|
| a | we | 1,234.5 / 7 | 3 of 4 |
| b | we | 10 / 8 | 1 of 2 |
| a | they | 20 / 9 | 0 of 2 |
"""
FIGURE = {"name": "speed"}


class Figures(unittest.TestCase):
    def series(self, **told):
        with tempfile.TemporaryDirectory() as root:
            with open(os.path.join(root, "page.md"), "w") as page:
                page.write(TABLE)
            return results_figures.Series(root, FIGURE, {"name": "we", "page": "page.md", "table": "Speed", "label": ["log"], "column": "ms",
                                                         "where": {"who": "we"}, **told})

    def test_numbers_are_those_of_the_rows_that_fit(self):
        self.assertEqual(self.series().values, {"a": (1234.5, None, None), "b": (10, None, None)})
        self.assertEqual(self.series(number=1).values, {"a": (7, None, None), "b": (8, None, None)})
        self.assertEqual(self.series(where={"ms": {"most": 15}}).values, {"b": (10, None, None)})
        self.assertEqual(self.series(where={"ms": {"least": 15}, "who": {"unlike": "we"}}).values, {"a": (20, None, None)})
        shares = self.series(column="right", share=True, aggregate="sum")
        self.assertEqual(shares.aggregate(), "4 of 6")
        self.assertAlmostEqual(shares.values["we"][0], 100 * 4 / 6)

    def test_the_table_says_what_was_measured(self):
        self.assertEqual(self.series().measured, ("abcdef12", "2026-01-02"))

    def test_what_a_figure_asks_for_has_to_be_there(self):
        for told in ({"table": "Slow"}, {"column": "s"}, {"where": {"who": "nobody"}}, {"values": [["a", 1]]}):
            with self.assertRaisesRegex(results_figures.FigureError, "figure 'speed', series 'we': .*expected|no table"):
                self.series(**told)

    def test_bars_are_as_long_as_their_values(self):
        svg = results_charts.chart("t", "s", [("we", 0, {"a": (2, None, None), "b": (5, 4, 6)}), ("they", 1, {"a": (40, None, None)})], 10)
        ends = [float(end) for end in re.findall(r'd="M190\.0 [\d.]+H([\d.]+)v13', svg)]
        width = results_charts.WIDTH
        self.assertEqual(ends, [190 + 0.2 * width, 190 + 0.5 * width])
        self.assertIn(">40</text>", svg)  # longer than the chart, with an arrow

    def test_axes_end_beyond_the_greatest_value(self):
        for most in (0.03, 1, 3.5, 7, 14, 99, 2822, 69700):
            ticks = results_charts.steps(most)
            self.assertGreaterEqual(ticks[-1], most * (1 - 1e-9))
            self.assertLess(ticks[-2], most)
            self.assertIn(len(ticks), range(4, 8))

    def test_text_and_bars_stand_out_on_light_and_dark_pages(self):
        def light(colour):
            parts = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
            return sum(w * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4)
                       for w, c in zip((0.2126, 0.7152, 0.0722), parts))

        def contrast(one, other):
            low, high = sorted((light(one), light(other)))
            return (high + 0.05) / (low + 0.05)
        for page in ("#ffffff", "#131416", "#0d1117"):
            self.assertGreater(contrast(results_charts.TEXT, page), 4)
            for colour in results_charts.COLOURS:
                self.assertGreater(contrast(colour, page), 3)


class Page(unittest.TestCase):
    """Of this project."""

    def test_page_and_charts_are_what_the_tables_say(self):
        self.assertEqual([name for name, _ in results_page.stale(ROOT)], [], "run scripts/results_page.py")

    def test_another_cell_makes_its_chart_stale(self):
        with tempfile.TemporaryDirectory() as root:
            shutil.copytree(os.path.join(ROOT, "docs"), os.path.join(root, "docs"), ignore=shutil.ignore_patterns("site", "*.png", "*.gif"))
            self.assertEqual(list(results_page.stale(root)), [])
            file = os.path.join(root, "docs/results/recovery.md")
            results_page.rewrite(file, lambda text: re.sub(r"(\| intel \| 20 of 20 [^|]*\|) 3\.5 /", r"\1 3.6 /", text, count=1))
            self.assertEqual([name for name, _ in results_page.stale(root)], ["docs/pictures/results-kidnaps.svg"])

    def test_each_of_nine_figures_says_commit_date_and_command(self):
        with open(os.path.join(ROOT, "docs/results.md"), encoding="utf-8") as page:
            sections = [s for s in page.read().split("\n## ")[1:] if not s.startswith("Everything else")]
        self.assertEqual(len(sections), 9)
        for section in sections:
            title = section.partition("\n")[0]
            self.assertRegex(section, r"\n\n\*\*.*\d.*\*\*\n", title)
            self.assertRegex(section, r"Measured at commit `[0-9a-f]{8}` of 20\d\d-\d\d-\d\d", title)
            self.assertRegex(section, r"<!-- run: .+ -->\n```sh\n\S", title)
            self.assertRegex(section, r"\[[^\]]+\]\((results/)?[\w-]+\.md", title)
            picture = re.search(r"!\[.+\]\((pictures/.+\.svg)\)", section)[1]
            with open(os.path.join(ROOT, "docs", picture), encoding="utf-8") as file:
                svg = file.read()
            self.assertLess(len(svg), 30000)
            self.assertEqual({e.tag.rpartition("}")[2] for e in xml.etree.ElementTree.fromstring(svg).iter()}, {"svg", "title", "text", "path"})
            self.assertNotIn("url(", svg)

    def test_commits_are_those_of_this_project(self):
        def git(*words):
            return subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True)
        if git("rev-parse", "--is-shallow-repository").stdout.strip() != "false":
            self.skipTest("this project's history is not here")
        for figure, series in results_figures.read(ROOT)[1]:
            for one in series:
                told = git("log", "-1", "--format=%cs", one.measured[0]).stdout.strip()
                self.assertEqual(told, one.measured[1], "%s, %s: commit %s" % (figure["name"], one.name, one.measured[0]))


if __name__ == "__main__":
    unittest.main()
