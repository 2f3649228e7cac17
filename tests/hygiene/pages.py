#!/usr/bin/env python3
"""pages.py ROOT  every block of every page is run by a test, or says why not."""
import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "docs"))
import blocks  # noqa: E402
from blocks import PageError  # noqa: E402

STATEFUL = re.compile(r"(cd|export|set|source|\.) |\w+=\S*$")  # each command has a shell of its own


def places_that_ci_runs(root):
    """What says which tests and scripts are run."""
    texts = [(root / ".ci/run").read_text(), (root / "scripts/test.sh").read_text()]
    texts += [p.read_text() for p in (root / "tests").rglob("CMakeLists.txt")]
    texts += [f"test_{name}.py" for name in re.findall(r"ortung_python_test\((\w+)", "\n".join(texts))]
    return "\n".join(texts)


def check_mark(root, block, registered):
    count = len(block.commands())
    for mark in block.marks:
        if wrong := [n for n in mark.commands if not 0 < n <= count]:
            raise PageError(block.page, mark.line, f"'{mark.word}' excuses command {wrong[0]}, but the block has {count}")
    if within := block.mark("within"):
        path = root / "tests/docs/within" / within.words[0]
        if block.language != "cpp" or not path.is_file() or not re.search(blocks.PLACE, path.read_text(), re.MULTILINE):
            raise PageError(block.page, within.line, f"within {within.words[0]}, expected a block of cpp and a file of "
                            f"tests/docs/within with a line '// the block'")
    for by in (m for m in block.marks if m.word == "by"):
        path = root / by.words[0]
        if not path.is_file():
            raise PageError(block.page, by.line, f"by {by.words[0]}, expected a file of the project")
        if path.name not in registered:
            raise PageError(block.page, by.line, f"by {by.words[0]}, expected something that CI runs: a test that "
                            "tests/*/CMakeLists.txt names, or a script of .ci/run")


def check_block(block, before):
    language = block.language
    known = blocks.COMMANDS | blocks.FILES | blocks.SHOWN | blocks.OTHERS
    if language not in known:
        raise PageError(block.page, block.line, f"a block of '{language}', expected one of {', '.join(sorted(known))}")
    if (prints := block.mark("prints")) and (before is None or before.language not in blocks.COMMANDS | {"cpp"}):
        raise PageError(block.page, prints.line, "'prints', but the block before runs nothing")
    if language in blocks.SHOWN:
        for number, line in enumerate(block.lines, block.line + 1):
            if re.match(r"\s*(\$ |ortung [a-z]|cmake -|sudo )", line):
                raise PageError(block.page, number, f"'{line.strip()}' in a block of text, expected ```sh or ```console")
        return
    if block.excuse() or block.mark("as") or block.mark("within"):
        return
    if language in blocks.OTHERS or (language == "cpp" and "int main(" not in block.text()):
        raise PageError(block.page, block.line, f"a block of {language} that nothing runs, expected a mark: by PATH, as FILE, "
                        "within FILE or fragment, with the reason")
    for number, command in enumerate(block.commands(), 1):
        if STATEFUL.match(command.text) and not block.excuse(number):
            raise PageError(block.page, command.line, f"'{command.text}' changes the shell, but each command is run in one "
                            "of its own: expected a command that stands alone, or a mark with an excuse")


def check_scripts(root, block):
    """Scripts, their options, and presets exist, also in what is not run."""
    presets = {p["name"] for p in json.loads((root / "CMakePresets.json").read_text())["configurePresets"]}
    for command in block.commands():
        for words in blocks.invocations(command):
            if words[0].startswith(("scripts/", "examples/", "python/")):
                script = root / words[0]
                if not script.is_file():
                    raise PageError(block.page, command.line, f"{words[0]} is run, but there is no such file")
                text = script.read_text()
                if script.with_suffix(".py").is_file():  # what compare-mrpt.sh passes on
                    text += script.with_suffix(".py").read_text()
                for word in words[1:]:
                    option = word.split("=")[0]
                    if option.startswith("--") and option not in text and script.name != "test.sh":
                        raise PageError(block.page, command.line, f"{words[0]} has no option {option}")
            for flag, value in zip(words, words[1:]):
                if flag == "--preset" and value not in presets:
                    raise PageError(block.page, command.line, f"there is no preset {value}, expected one of "
                                    f"{', '.join(sorted(presets))}")


def wrong_in(root, pages):
    root = pathlib.Path(root)
    registered = places_that_ci_runs(root)
    for page in pages:
        try:
            before = None
            for block in blocks.blocks(root, page):
                try:
                    check_mark(root, block, registered)
                    check_block(block, before)
                    check_scripts(root, block)
                except PageError as error:
                    yield str(error)
                before = block
        except PageError as error:  # no more can be read of this page
            yield str(error)


if __name__ == "__main__":
    pages = blocks.pages(sys.argv[1])
    wrong = list(wrong_in(sys.argv[1], pages))
    print("\n".join(wrong) if wrong else f"{len(pages)} pages: each block is run, or says why not")
    sys.exit(1 if wrong else 0)
