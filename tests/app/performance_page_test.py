#!/usr/bin/env python3
"""docs/performance.md has the tables that its figures make.

usage: performance_page_test.py SCRIPTS
"""
import contextlib
import io
import json
import os
import stat
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, sys.argv[1])
import performance  # noqa: E402

TABLES = """
[program]
some_bench = ["--out=OUT"]
[[table]]
name = "Weighing"
program = "some_bench"
head = ["method", "ns", "x"]
rows = [["naive", "{naive/1|ns|.0f}", "1"], ["ours", "{ours|ns}", "{naive/1 by ours|ns|.2f}"], ["absent", "{wide|ns}", ""]]
"""
FIGURES = {"naive/1": {"ns": 20.4}, "ours": {"ns": 5.06}}
PAGE = "# Performance\n\n<!-- table: Weighing -->\n\nText below.\n"
ROWS = ["| method | ns | x |", "| --- | --- | --- |", "| naive | 20 | 1 |", "| ours | 5.1 | 4.03 |", "| absent | - |  |"]
OF = "Measured at commit `1234567` of 2026-01-01 on a machine."


class Folder(unittest.TestCase):
    """A root with page, tables and figures."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = temporary.name
        os.makedirs(os.path.join(self.root, performance.FOLDER))
        self.put(performance.FOLDER + "/tables.toml", TABLES)
        self.put(performance.PAGE, PAGE)

    def put(self, name, text):
        with open(os.path.join(self.root, name), "w") as file:
            file.write(text)

    def keep(self, figures):
        self.put(performance.FOLDER + "/figures.json", json.dumps({"some_bench": {"of": OF, "figures": figures}}))

    def check(self):
        told = io.StringIO()
        with contextlib.redirect_stdout(told):
            return performance.check(self.root), told.getvalue()


class Tables(Folder):
    def test_cells_have_the_figures_and_a_dash_for_what_a_machine_lacks(self):
        one = performance.described(self.root)["table"][0]
        self.assertEqual(performance.table(one, FIGURES), ROWS)

    def test_a_counter_that_is_none_and_a_table_without_figures_are_errors(self):
        one = performance.described(self.root)["table"][0]
        with self.assertRaisesRegex(performance.FigureError, "Weighing.*'ours' has no 'ns', but ms"):
            performance.table(one, {"naive/1": {"ns": 1.0}, "ours": {"ms": 5.0}})
        with self.assertRaisesRegex(performance.FigureError, "none of its benchmarks was measured"):
            performance.table(one, {"other": {}})

    def test_names_are_those_without_what_google_benchmark_appends(self):
        text = json.dumps({"benchmarks": [{"name": "a/2/min_time:0.300/real_time", "ns": 1.5, "label": "x"},
                                          {"name": "b", "error_occurred": True}]})
        self.assertEqual(performance.benchmarks_of(text), {"a/2": {"ns": 1.5}})


class Page(Folder):
    def test_is_checked_against_its_figures(self):
        self.assertEqual(self.check(), (1, "some_bench was never measured\n"))
        self.keep(FIGURES)
        self.assertEqual(self.check()[0], 1)
        page, missing = performance.page_with(PAGE, performance.described(self.root), performance.kept(self.root))
        self.assertEqual(missing, [])
        self.put(performance.PAGE, page)
        self.assertEqual(self.check(), (0, ""))
        self.assertIn("\n".join([OF, "", *ROWS, "", "Text below."]), page)
        self.put(performance.PAGE, page.replace("4.03", "5.03"))
        self.assertEqual(self.check()[0], 1)

    def test_the_pages_own_tables_are_those_of_its_figures(self):
        root = os.path.dirname(os.path.abspath(sys.argv[1]))
        told = io.StringIO()
        with contextlib.redirect_stdout(told):
            self.assertEqual(performance.check(root), 0, told.getvalue())


class Run(Folder):
    def program(self, text):
        os.makedirs(os.path.join(self.root, "bin"), exist_ok=True)
        file = os.path.join(self.root, "bin", "some_bench")
        self.put("bin/some_bench", "#!/bin/sh\n" + text)
        os.chmod(file, os.stat(file).st_mode | stat.S_IXUSR)

    def test_takes_the_file_by_option_or_environment(self):
        told = '{"benchmarks": [{"name": "ours", "ns": 2}]}'
        for place in ("${1#--out=}", "$ORTUNG_FIGURES"):
            self.program("echo '%s' > \"%s\"\n" % (told, place))
            self.assertEqual(performance.run("some_bench", ["--out=OUT"], self.root), {"ours": {"ns": 2}})

    def test_a_script_prints_its_table(self):
        with unittest.mock.patch.object(performance, "ROOT", self.root):
            os.makedirs(os.path.join(self.root, "scripts"))
            self.put("scripts/some.py", "#!/bin/sh\necho \"for $1\"\necho '| a |'\n")
            os.chmod(os.path.join(self.root, "scripts/some.py"), 0o755)
            figures = performance.run("some.py", ["BUILD"], self.root)
        self.assertEqual(performance.table({"name": "Some"}, figures), ["| a |"])

    def test_a_program_that_fails_or_writes_nothing_is_an_error(self):
        for text in ("exit 3\n", "true\n"):
            self.program(text)
            with self.assertRaisesRegex(performance.FigureError, "some_bench.* ended with .*should have measured"):
                performance.run("some_bench", [], self.root)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
