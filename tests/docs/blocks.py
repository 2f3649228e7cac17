"""The fenced blocks of the pages, their marks, and the commands in them (docs/testing.md, "The pages").

A mark is an HTML comment directly before a block, which a reader of the page does not see:

  <!-- run: given run.rec robot.toml DIR=installed -->  the block finds these files of the shelf in its folder
  <!-- run: as cart.cpp -->            the block is that file, in the page's folder
  <!-- run: within FILE.cpp -->        the block is compiled in the place of the line PLACE of tests/docs/within/FILE.cpp
  <!-- run: prints -->                 the block is what the commands of the block before print
  <!-- run: long: WHY -->              run only if ORTUNG_LONG_DOCS=1
  <!-- run: needs THING: WHY -->       never run: no test has the thing
  <!-- run: by PATH: WHAT -->          run by that test or script instead
  <!-- run: fragment: WHY -->          not a whole command, program or file

The last four excuse a block, or those of its commands whose numbers they say: <!-- run: long 2 3: WHY -->.
"""
import dataclasses
import pathlib
import re
import shlex

PAGES = ("README.md", "STABILITY.md", "CONTRIBUTING.md", "examples/README.md", "realsensors/README.md", "docs/**/*.md",
         "plugins/*/*/README.md")
COMMANDS = {"sh", "console", "python"}      # languages of which each block is run
FILES = {"cpp", "toml"}                     # those that can be compiled or checked where they are whole
SHOWN = {"text"}                            # what nobody runs: output, formulas, drawings
OTHERS = {"cmake", "session", "replies", "recording", "json"}  # those that something else has to run
WORDS = {"given", "as", "within", "prints", "long", "needs", "fragment", "by"}
EXCUSES = {"long", "needs", "fragment", "by"}
PLACE = "^ *// the block\n"                  # the line that `within` replaces
THINGS = {"devices", "network", "packages", "build"}


class PageError(Exception):
    """What is wrong with a page: file, line, what was found and what was expected."""

    def __init__(self, page, line, text):
        super().__init__(f"{page}:{line}: {text}")


@dataclasses.dataclass
class Mark:
    word: str
    words: list     # what follows, up to the colon
    reason: str
    line: int
    commands: list  # the numbers of the commands that it excuses; none: all


@dataclasses.dataclass
class Command:
    text: str
    line: int
    expected: list | None = None  # lines that a `console` block shows


@dataclasses.dataclass
class Block:
    page: str
    line: int       # of the fence
    language: str
    lines: list
    marks: list

    def mark(self, word):
        return next((m for m in self.marks if m.word == word), None)

    def excuse(self, number=None):
        """What excuses the whole block, or its command of that number, from being run."""
        return next((m for m in self.marks if m.word in EXCUSES and (not m.commands or number in m.commands)), None)

    def text(self):
        return "\n".join(self.lines) + "\n"

    def commands(self):
        """The block's commands, each whole: with its continued lines, quotes and here-documents."""
        if self.language == "sh":
            return list(_whole(self.page, list(enumerate(self.lines, self.line + 1))))
        if self.language == "console":
            return list(_of_console(self))
        return []


def pages(root):
    """All pages with commands, as paths below root."""
    root = pathlib.Path(root)
    return sorted(str(p.relative_to(root)) for pattern in PAGES for p in root.glob(pattern))


def blocks(root, page):
    """All blocks of a page. Throws PageError for marks and fences that nobody understands."""
    found, marks = [], []
    lines = (pathlib.Path(root) / page).read_text(encoding="utf-8").splitlines()
    at = 0
    while at < len(lines):
        line, number = lines[at], at + 1
        if mark := re.fullmatch(r"\s*<!--\s*run:\s*(.*?)\s*-->\s*", line):
            marks.append(_mark(page, number, mark[1]))
        elif fence := re.match(r"( *)```(\S*)\s*$", line):
            end = next((i for i in range(at + 1, len(lines)) if re.match(r" *```\s*$", lines[i])), None)
            if end is None:
                raise PageError(page, number, "a block begins and never ends, expected ```")
            indent = len(fence[1])
            found.append(Block(page, number, fence[2], [text[indent:] for text in lines[at + 1:end]], marks))
            marks, at = [], end
        else:
            if marks:
                raise PageError(page, marks[-1].line, f"a mark before '{line}', expected a block (```) right behind it")
            before = lines[at - 1].strip() if at > 0 else ""
            if line.startswith("    ") and (not before or before.endswith(("-->", "```"))) and not _in_list(lines, at):
                raise PageError(page, number, f"'{line.strip()}' is a block by indentation, expected a fence that says "
                                "its language: ```sh, ```text, ...")
            if re.match(r"\s*<!--\s*run\b", line):
                raise PageError(page, number, f"'{line.strip()}', expected a mark <!-- run: WORD ... --> on a line of its own")
        at += 1
    if marks:
        raise PageError(page, marks[-1].line, "a mark at the page's end, expected a block behind it")
    return found


def invocations(command):
    """The programs that a command runs, each with its arguments: what stands between pipes, && and the like."""
    text = re.split(r"<<-?\s*'?\w+'?", command.text)[0] if "<<" in command.text else command.text
    lexer = shlex.shlex(text.replace("\\\n", " "), posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    current = []
    for word in [*lexer, ";"]:
        if re.fullmatch(r"[();<>|&]+", word):
            if current:
                yield current
            current = []
        elif current or not re.match(r"\w+=", word):  # without the variables before it
            current.append(word)


def _in_list(lines, at):
    """Whether an indented line goes on with an item of a list."""
    for line in reversed(lines[:at]):
        if line.strip() and not line.startswith(" "):
            return bool(re.match(r"([-*]|\d+\.) ", line))
    return False


def _mark(page, number, text):
    before, _, reason = text.partition(": ") if not text.endswith(":") else (text[:-1], "", "")
    words = before.split()
    if not words or words[0] not in WORDS:
        raise PageError(page, number, f"the mark '{text}', expected one of {', '.join(sorted(WORDS))}")
    numbers = [int(w) for w in words if w.isdigit()] if words[0] in EXCUSES else []
    words = [w for w in words if not w.isdigit() or not numbers]
    mark = Mark(words[0], words[1:], reason.strip(), number, numbers)
    if mark.word in EXCUSES and not mark.reason:
        raise PageError(page, number, f"the mark '{text}' excuses a block from being run, expected ': ' and the reason")
    if mark.word == "needs" and (len(mark.words) != 1 or mark.words[0] not in THINGS):
        raise PageError(page, number, f"the mark '{text}', expected needs and one of {', '.join(sorted(THINGS))}")
    wanted = {"given": mark.words, "as": len(mark.words) == 1, "within": len(mark.words) == 1, "by": len(mark.words) == 1}
    if not wanted.get(mark.word, mark.word == "needs" or not mark.words):
        raise PageError(page, number, f"the mark '{text}' has {len(mark.words)} words behind '{mark.word}', "
                        "see tests/docs/blocks.py")
    return mark


def _whole(page, numbered):
    pending, begin = [], 0
    for number, line in numbered:
        if not pending:
            if not line.strip() or line.lstrip().startswith("#"):
                continue
            begin = number
        pending.append(line)
        text = "\n".join(pending)
        if not _is_open(text):
            yield Command(text, begin)
            pending = []
    if pending:
        raise PageError(page, begin, f"the command '{pending[0]}' goes on behind the block's end")


def _is_open(text):
    if here := re.search(r"<<-?\s*'?(\w+)'?", text):
        return here[1] not in text.splitlines()[1:]
    if text.endswith("\\"):
        return True
    try:
        shlex.split(text, comments=True)
        return False
    except ValueError:  # a quote is open
        return True


def _of_console(block):
    command = None
    for number, line in enumerate(block.lines, block.line + 1):
        if line.startswith("$ "):
            if command:
                yield command
            command = Command(line[2:], number, [])
        elif command is None:
            raise PageError(block.page, number, f"'{line}' in a console block, expected '$ COMMAND' first")
        elif _is_open(command.text):
            command.text += "\n" + line
        else:
            command.expected.append(line)
    if command:
        yield command
