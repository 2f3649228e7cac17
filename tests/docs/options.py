#!/usr/bin/env python3
"""options.py ORTUNG ROOT  every command and option of `ortung` that a page shows exists, also where no test runs it:
in blocks for devices, in fragments, and in the pages' sentences (`ortung export html`, `--against-grid`)."""
import functools
import pathlib
import re
import subprocess
import sys

import blocks
from blocks import Command, PageError

OPTION = re.compile(r"(?<![\w-])-{1,2}[a-zA-Z][\w-]*")


class Program:
    """What the program says of its commands."""

    def __init__(self, path, root):
        self.path = path
        files = [*pathlib.Path(root, "scripts").glob("*.py"), *pathlib.Path(root).glob("realsensors/ros2_*/OrtungRos2*.cpp")]
        scripts = [p.read_text() for p in files]
        self.others = set(OPTION.findall("\n".join(scripts))) | {"--preset"}  # of scripts and other programs, and CMake's

    @functools.cache
    def help(self, *words):
        told = subprocess.run([self.path, *words, "--help"], capture_output=True, text=True, check=False)
        return told.stdout

    @functools.cache
    def commands(self, *words):
        """Names of the commands below one, e.g. html below export."""
        listed = self.help(*words).split("\nExample:")[0]
        return re.findall(r"^  ([a-z][\w-]*) ", listed, re.MULTILINE) if self.has_commands(*words) else []

    def has_commands(self, *words):
        usage = re.search(r"^Usage: .*$", self.help(*words), re.MULTILINE)
        return usage is not None and usage[0].endswith(" SUBCOMMAND")

    @functools.cache
    def options(self, *words):
        """The options of a command, of those above it, too."""
        lines = [line for line in self.help(*words).splitlines() if re.match(r"  -", line)]
        names = {name for line in lines for name in OPTION.findall(re.split(r"\s{2,}", line.strip())[0].split(" ")[0])}
        return names | (self.options(*words[:-1]) if words else set())

    @functools.cache
    def all_options(self):
        paths = [()] + [(c,) for c in self.commands()] + [(c, s) for c in self.commands() for s in self.commands(c)]
        return set().union(*(self.options(*path) for path in paths))

    def check(self, page, line, words, is_whole):
        """words: what follows `ortung`. A sentence may say an option alone: then some command or script has it."""
        if not is_whole and words[0].startswith("--"):
            option = words[0].split("=")[0]
            if option not in self.all_options() and option not in self.others:
                raise PageError(page, line, f"'{option}', expected an option of a command of 'ortung', or of a script or another program")
            return
        path = []
        while names := self.commands(*path):
            word = words[len(path)] if len(words) > len(path) else None
            if word is None or word.startswith("-"):
                break
            if word not in names:
                if not is_whole and (word.isupper() or word == "..."):
                    return
                raise PageError(page, line, f"'{' '.join(['ortung', *path, word])}', but 'ortung {' '.join(path)}' has the "
                                f"commands {', '.join(names)}")
            path.append(word)
        for word in words[len(path):]:
            option = word.split("=")[0]
            if OPTION.fullmatch(option) and option not in self.options(*path):
                raise PageError(page, line, f"'{' '.join(['ortung', *path, option])}', expected an option of it: "
                                f"{', '.join(sorted(self.options(*path)))}")


def shown(root, page):
    """(line, words behind `ortung`, whether it is a block's) of all that a page shows of the program. An option alone, as
    sentences name them, comes without a command."""
    in_blocks = set()
    for block in blocks.blocks(root, page):
        in_blocks.update(range(block.line, block.line + len(block.lines) + 2))
        for command in block.commands():
            for words in blocks.invocations(command):
                if pathlib.Path(words[0]).name == "ortung":
                    yield command.line, words[1:], True
    text = (pathlib.Path(root) / page).read_text(encoding="utf-8")
    lines = ["" if number in in_blocks else line for number, line in enumerate(text.splitlines(), 1)]
    for span in re.finditer(r"`([^`]+)`", "\n".join(lines)):
        line = 1 + "\n".join(lines)[:span.start()].count("\n")
        code = span[1].replace("\n", " ").strip()
        if re.match(r"--[a-z]", code):
            yield line, code.split()[:1], False
        if re.match(r"(\w+=\S+ )*ortung (?!record \d)", code):  # a record begins with "ortung record 2"
            try:
                calls = list(blocks.invocations(Command(code, line)))
            except ValueError:  # an open quote
                calls = [code.split()]
            yield from ((line, words[1:], False) for words in calls if words[0] == "ortung")


def main():
    program = Program(sys.argv[1], sys.argv[2])
    wrong, count = [], 0
    for page in blocks.pages(sys.argv[2]):
        try:
            calls = list(shown(sys.argv[2], page))
        except PageError as error:  # no more can be read of this page
            wrong.append(str(error))
            continue
        for line, words, is_whole in calls:
            count += 1
            try:
                program.check(page, line, words, is_whole)
            except PageError as error:
                wrong.append(str(error))
    if count < 50:
        wrong.append(f"the pages show the program {count} times only, expected some hundred: are they read at all?")
    print("\n".join(wrong) if wrong else f"{count} times the program is shown with commands and options that it has")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
