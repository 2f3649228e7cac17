#!/usr/bin/env python3
"""Puts the tables of keys of the plugins' READMEs into docs/robots.md, between its markers.

  scripts/robots-page.py            writes the page
  scripts/robots-page.py --check    ends with 1 if the page is not what would be written
"""
import pathlib
import posixpath
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "robots.md"
MARKER = re.compile(r"<!-- keys: (\S+)(?: \(([^\n]*)\))? -->\n.*?<!-- end of keys -->", re.DOTALL)


def tables(file, head):
    """The tables of a page whose first column is called `key...`, or as `head` says; links as seen from docs/."""
    found = []
    for block in re.split(r"\n\s*\n", (ROOT / file).read_text()):
        lines = [line for line in block.split("\n") if line.startswith("|")]
        if lines and (lines[0].startswith(f"| {head} |") if head else lines[0].startswith("| key")):
            found.append("\n".join(lines))
    if not found:
        sys.exit(f"{file}: no table of keys")

    def moved(link):
        page, place = link.groups("")
        target = posixpath.normpath(posixpath.join(posixpath.dirname(file), page)) if page else file
        return "](" + posixpath.relpath(target, "docs") + place + ")"

    return re.sub(r"\]\((?!http)([^)#]*)(#[^)]*)?\)", moved, "\n\n".join(found))


def main():
    text = PAGE.read_text()
    made = MARKER.sub(lambda m: m[0].split("\n")[0] + "\n" + tables(m[1], m[2]) + "\n<!-- end of keys -->", text)
    if sys.argv[1:] == ["--check"]:
        if made != text:
            sys.exit("docs/robots.md is not what the READMEs say: run scripts/robots-page.py")
    else:
        PAGE.write_text(made)


if __name__ == "__main__":
    main()
