#!/usr/bin/env python3
"""What is wrong with a page is found, and said with its page and line: by pages.py, and by what runs the pages."""
import contextlib
import io
import pathlib
import stat
import sys
import tempfile
import types
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent), str(pathlib.Path(__file__).resolve().parent.parent / "docs")]
import blocks  # noqa: E402
import options  # noqa: E402
import pages  # noqa: E402
import run  # noqa: E402

HELP = """#!/bin/sh
case "$*" in
  --help) printf 'Usage: ortung [OPTIONS] SUBCOMMAND\\n\\nOptions:\\n  -h,--help   Help\\n\\nSubcommands:\\n  learn   Learn\\n  export  Export\\n' ;;
  "export --help") printf 'Usage: ortung export [OPTIONS] SUBCOMMAND\\n\\nOptions:\\n  -h,--help   Help\\n\\nSubcommands:\\n  html    Page\\n' ;;
  "learn --help") printf 'Options:\\n  -h,--help   Help\\n  --out TEXT REQUIRED   File, see --nothing\\n' ;;
  "export html --help") printf 'Options:\\n  --page TEXT   Page\\n' ;;
  say*) shift; echo "$*" ;;
  fail) echo it failed; exit 3 ;;
  *--listen*) exec python3 -c "import socket, time; s = socket.create_server(('127.0.0.1', 0)); time.sleep(60)" ;;
esac
"""


class Project(unittest.TestCase):
    """A project of one page."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name, text in {".ci/run": "", "scripts/test.sh": "", "tests/x/CMakeLists.txt": "XTest.cpp", "tests/x/XTest.cpp": "",
                           "tests/x/nobody.sh": "", "CMakePresets.json": '{"configurePresets": [{"name": "dev"}]}',
                           "scripts/do.py": "--known", "shelf/run.rec": "a record\n", "bin/ortung": HELP}.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)
        (self.root / "bin/ortung").chmod(stat.S_IRWXU)
        (self.root / "docs").mkdir()

    def write(self, *lines):
        (self.root / "docs/page.md").write_text("\n".join(lines) + "\n")

    def wrong(self, *lines):
        self.write(*lines)
        return "\n".join(pages.wrong_in(self.root, blocks.pages(self.root)))

    def run_page(self, *lines):
        """What is said of a page that is run, or '' if all is well."""
        self.write(*lines)
        told = io.StringIO()
        session = run.Session(types.SimpleNamespace(source=self.root, programs=str(self.root / "bin"), python="", compiler="c++", link="",
                                                    shelf=self.root / "shelf"))
        try:
            with contextlib.redirect_stdout(told):
                self.complete = run.run_page(session, "docs/page.md")
            return ""
        except blocks.PageError as error:
            return str(error)
        finally:
            session.close()
            self.told = told.getvalue()


class Marks(Project):
    def test_a_block_that_is_run_or_says_why_not_is_right(self):
        self.assertEqual(self.wrong("```sh", "ortung learn", "```", "<!-- run: prints -->", "```text", "x", "```"), "")
        self.assertEqual(self.wrong("<!-- run: given run.rec -->", "<!-- run: long 2: hours -->", "```sh", "a", "b", "```"), "")
        self.assertEqual(self.wrong("- item", "", "      goes on", "", "<!-- run: by tests/x/XTest.cpp: all -->", "```cpp", "f();",
                                    "```"), "")

    def test_what_is_wrong_is_named_with_its_line(self):
        for expected, lines in {
            "docs/page.md:1: the mark 'never: x', expected one of as, by,": ["<!-- run: never: x -->", "```sh", "a", "```"],
            "docs/page.md:1: the mark 'long' excuses": ["<!-- run: long -->", "```sh", "a", "```"],
            "docs/page.md:1: the mark 'needs money: x', expected needs": ["<!-- run: needs money: x -->", "```sh", "a", "```"],
            "docs/page.md:1: a mark before 'text'": ["<!-- run: prints -->", "text"],
            "docs/page.md:2: a mark at the page's end": ["text", "<!-- run: prints -->"],
            "docs/page.md:1: '<!-- run prints -->', expected a mark": ["<!-- run prints -->"],
            "docs/page.md:1: 'long' excuses command 2, but the block has 1": ["<!-- run: long 2: x -->", "```sh", "a", "```"],
            "docs/page.md:1: by tests/y.sh, expected a file": ["<!-- run: by tests/y.sh: x -->", "```sh", "a", "```"],
            "docs/page.md:1: by tests/x/nobody.sh, expected something that CI runs":
                ["<!-- run: by tests/x/nobody.sh: x -->", "```sh", "a", "```"],
            "docs/page.md:1: within a.cpp, expected a block of cpp": ["<!-- run: within a.cpp -->", "```cpp", "f();", "```"],
            "docs/page.md:1: 'prints', but the block before runs nothing": ["<!-- run: prints -->", "```text", "a", "```"],
            "docs/page.md:1: a block of '', expected one of cmake": ["```", "a", "```"],
            "docs/page.md:3: 'ortung learn' is a block by indentation": ["text", "", "    ortung learn"],
            "docs/page.md:2: 'ortung learn' in a block of text": ["```text", "ortung learn", "```"],
            "docs/page.md:1: a block of cpp that nothing runs": ["```cpp", "f();", "```"],
            "docs/page.md:1: a block begins and never ends": ["```sh", "a"],
            "docs/page.md:3: 'cd folder' changes the shell": ["```sh", "a", "cd folder", "```"],
            "docs/page.md:2: the command 'echo \"a' goes on behind": ["```sh", "echo \"a", "```"],
            "docs/page.md:2: scripts/do.py has no option --unknown": ["```sh", "scripts/do.py --known --unknown=1", "```"],
            "docs/page.md:2: scripts/gone.py is run, but there is": ["```sh", "scripts/gone.py", "```"],
            "docs/page.md:2: there is no preset fast": ["```sh", "cmake --preset fast", "```"],
            "docs/page.md:2: 'output' in a console block": ["```console", "output", "```"],
        }.items():
            with self.subTest(expected):
                self.assertIn(expected, self.wrong(*lines))

    def test_commands_are_whole(self):
        self.write("```sh", "# a note", "a \\", "  b  # why", "", "cat > f <<'END'", "x", "END", "c 'd", "e'", "```")
        self.assertEqual([(c.line, c.text) for c in blocks.blocks(self.root, "docs/page.md")[0].commands()],
                         [(3, "a \\\n  b  # why"), (6, "cat > f <<'END'\nx\nEND"), (9, "c 'd\ne'")])
        calls = list(blocks.invocations(blocks.Command("A=1 ortung 'a&b' --c && d | e > f &  # g", 1)))
        self.assertEqual(calls, [["ortung", "a&b", "--c"], ["d"], ["e"], ["f"]])


class Options(Project):
    def wrong_options(self, *lines):
        self.write(*lines)
        program = options.Program(str(self.root / "bin/ortung"), self.root)
        for shown in options.shown(self.root, "docs/page.md"):
            try:
                program.check("docs/page.md", *shown)
            except blocks.PageError as error:
                return str(error)
        return ""

    def test_those_of_blocks_and_sentences_exist(self):
        self.assertEqual(self.wrong_options("`ortung export html --page x`, `ortung COMMAND`, `--known`, `ortung record 2`,",
                                            "<!-- run: fragment: x -->", "```sh", "ortung learn --out x -h", "```"), "")
        for expected, lines in {
            "page.md:2: 'ortung learn --in', expected an option of it: --help, --out, -h": ["```sh", "ortung learn --in x", "```"],
            "page.md:3: 'ortung learn --nothing'": ["<!-- run: needs devices: x -->", "```sh", "ortung learn --nothing", "```"],
            "page.md:2: 'ortung export pdf', but 'ortung export' has the commands html": ["text", "with `ortung export pdf x`"],
            "page.md:1: 'ortung lern'": ["`ortung lern x`"],
            "page.md:1: '--unknown', expected an option of a command": ["by `--unknown`"],
        }.items():
            with self.subTest(expected):
                self.assertIn(expected, self.wrong_options(*lines))


class Runs(Project):
    def test_what_is_printed_is_compared(self):
        for right in (["$ ortung say a", "a"], ["$ ortung say a b c", "a ... c"], ["$ printf '1\\n2\\n3\\n4\\n'", "...", "3", "..."]):
            with self.subTest(right):
                self.assertEqual(self.run_page("```console", *right, "```"), "")
        for expected, lines in {
            "docs/page.md:3: the page shows 'b', but printed was 'a'": ["$ ortung say a", "b"],
            "docs/page.md:4: the page shows 'b', but printed was the end": ["$ ortung say a", "a", "b"],
            "docs/page.md:3: the page's output ends here, but printed was also '2'": ["$ printf '1\\n2\\n'", "1"],
            "docs/page.md:5: the page shows '9'": ["$ printf '1\\n2\\n'", "1", "...", "9"],
        }.items():
            with self.subTest(expected):
                self.assertIn(expected, self.run_page("```console", *lines, "```"))
        self.assertIn("docs/page.md:6: the page shows 'b'", self.run_page("```sh", "ortung say a", "```", "<!-- run: prints -->",
                                                                         "```text", "b", "```"))

    def test_a_command_that_fails_is_named(self):
        self.assertRegex(self.run_page("```sh", "true", "ortung fail", "```"),
                         "(?s)docs/page.md:3: 'ortung fail' ends with exit code 3, expected 0.*it failed")

    def test_files_are_given_and_written(self):
        self.assertEqual(self.run_page("<!-- run: given a.rec=run.rec -->", "```console", "$ cat a.rec b.txt", "a record", "later",
                                       "```", "<!-- run: as b.txt -->", "```toml", "later", "```"), "")
        self.assertIn("docs/page.md:1: given x.rec, but the shelf has no such file",
                      self.run_page("<!-- run: given x.rec -->", "```sh", "true", "```"))
        self.assertEqual(self.run_page("<!-- run: given data/log -->", "```sh", "false", "```"), "")
        self.assertFalse(self.complete)
        self.assertRegex(self.told, r"docs/page.md:2: Skipped\n\S*shared/data/log is not here")

    def test_what_does_not_compile_is_named_by_the_page(self):
        (self.root / "tests/docs/within").mkdir(parents=True)
        (self.root / "tests/docs/within/a.cpp").write_text("int f();\nint main() {\n  // the block\n}\n")
        self.assertEqual(self.run_page("<!-- run: within a.cpp -->", "```cpp", "f();", "```"), "")
        self.assertRegex(self.run_page("<!-- run: within a.cpp -->", "```cpp", "f();", "g();", "```"),
                         "(?s)docs/page.md:2: .*docs/page.md:4:.*g")
        self.assertEqual(self.run_page("```cpp", "#include <cstdio>", "int main() { std::puts(\"1\"); }", "```",
                                       "<!-- run: prints -->", "```text", "1", "```"), "")

    def test_what_is_excused_is_not_run(self):
        self.assertEqual(self.run_page("<!-- run: long 2: hours -->", "```sh", "true", "false", "```",
                                       "<!-- run: needs devices: one -->", "```sh", "false", "```"), "")
        self.assertTrue(self.complete)
        self.assertEqual(self.run_page("<!-- run: long: hours -->", "```sh", "false", "```"), "")
        self.assertFalse(self.complete)
        self.assertIn("docs/page.md: Skipped\nits commands are long", self.told)

    def test_servers_are_awaited_and_ended(self):
        self.assertIn("docs/page.md:2: 'ortung sim --listen 0' ends with exit code -2 after SIGINT, expected 0",
                      self.run_page("```sh", "ortung sim --listen 0", "ortung say hello", "```"))
        self.assertIn("docs/page.md:2: 'ortung demo' has ended with exit code 0, expected a server",
                      self.run_page("```sh", "ortung demo", "```"))


if __name__ == "__main__":
    unittest.main()
