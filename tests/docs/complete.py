#!/usr/bin/env python3
"""Whether all that a contributor may add has its place in the pages and in the tests (CONTRIBUTING.md, "Recipes").

complete.py ORTUNG ROOT

Commands, plugins, panels of the viewer, functions of the Python package and figures of an evaluation are asked of the
program and of the sources; each must be named in the page that speaks of its kind. Prints what is missing and where it
was expected, and ends with 1.
"""
import json
import pathlib
import re
import subprocess
import sys

# The page that speaks of a kind of plugin. A name counts as named in `code`, with or without more in it.
PAGE_OF = {"Source": ["docs/files.md"],
           "Player": ["docs/players.md"],
           "SensorData": ["docs/sensors.md", "docs/cameras.md"],
           "MotionModel": ["docs/motion.md"],
           "DeviceDriver": ["docs/real-robot.md"],
           "Referee": ["docs/referee.md"]}


class Pages:
    def __init__(self, root):
        self.root = root

    def codes(self, names):
        """All that stands in `...` or between fences of pages."""
        text = "\n".join((self.root / name).read_text() for name in names if (self.root / name).exists())
        fenced = re.findall(r"^\s*```.*?^\s*```", text, re.S | re.M)
        return "\n".join(fenced + re.findall(r"`([^`\n]+)`", text))

    def names(self, pages, name):
        return re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", self.codes(pages)) is not None


def commands(ortung):
    told = subprocess.run([ortung, "--describe"], check=True, capture_output=True, text=True).stdout
    return [json.loads(line)["name"] for line in told.splitlines() if line]


def plugins(ortung):
    told = subprocess.run([ortung, "plugins"], check=True, capture_output=True, text=True).stdout
    return sorted(set(re.findall(r"^  (\w+) +(\w+)$", told, re.M)))


def listed(path, beginning):
    """The texts of a list in a source, from where it begins to its end."""
    text = path.read_text()
    return re.findall(r'"([^"]+)"', re.search(beginning + r"\s*=?\s*[\[{(](.*?)[\])}]", text, re.S).group(1))


def missing(ortung, root):
    pages = Pages(root)
    everywhere = ["README.md", *(str(p.relative_to(root)) for p in sorted((root / "docs").glob("*.md")))]
    for command in commands(ortung):
        if not pages.names(everywhere, command):
            yield f"'{command}' is used in no page"
    for kind, name in plugins(ortung):
        if kind in PAGE_OF and not pages.names(PAGE_OF[kind], name):
            yield f"the {kind} '{name}' is named in none of {', '.join(PAGE_OF[kind])}"
    panels = root / "board/web/page/src"
    source = next(p for p in sorted(panels.rglob("*.ts")) if "export const kPanels" in p.read_text())
    viewer = (root / "docs/viewer.md").read_text().lower()
    tests = (root / "board/web/page/e2e/page.test.mjs").read_text().lower()
    for panel in listed(source, r"export const kPanels"):
        if panel not in viewer:
            yield f"the panel '{panel}' is not in docs/viewer.md"
        if panel not in tests:
            yield f"the panel '{panel}' is looked at by no test of board/web/page/e2e/page.test.mjs"
    python = pages.codes(["docs/python.md", "docs/learning.md"])
    for stub in sorted((root / "python").rglob("*.pyi")):
        for name in re.findall(r"^(?:class|def) ([A-Za-z]\w*)", stub.read_text(), re.M):
            if not re.search(rf"\b{name}\b", python):
                yield f"'{name}' of {stub.relative_to(root)} is in neither docs/python.md nor docs/learning.md"
    figures = pages.codes(["docs/evaluation.md"])
    sources = ("app/report/RunResult.cpp", "app/report/ManyRuns.cpp", "mcl/study/src/Figures.cpp")
    report = "".join((root / name).read_text() for name in sources)
    for name in sorted(set(re.findall(r'\{"([a-z_0-9]+)", |json\["([a-z_0-9]+)"\]|count\("([a-z_0-9]+)"', report))):
        name = "".join(name)
        if not re.search(rf"\b{name}\b", figures):
            yield f"the figure '{name}' of an evaluation is not in docs/evaluation.md"


if __name__ == "__main__":
    found = list(missing(sys.argv[1], pathlib.Path(sys.argv[2])))
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)
