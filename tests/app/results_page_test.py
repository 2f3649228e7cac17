"""Tables that are printed get into the page behind their marks, and nothing else of it changes."""
import os
import sys
import tempfile
import unittest

sys.path.insert(0, sys.argv.pop(1))
import results_page  # noqa: E402  (it is beside the script that is tried)

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


if __name__ == "__main__":
    unittest.main()
