#!/usr/bin/env python3
"""links.py ROOT  says which links of pages lead nowhere: to files that are not there, or headings that no page has."""
import pathlib
import re
import subprocess
import sys

LINK = re.compile(r"(?<!`)\]\(([^)\s]+)\)")
FENCE = re.compile(r"^(```|~~~).*?^\1", re.M | re.S)
CODE = re.compile(r"`[^`\n]*`")


def anchors(page):
    """Of all headings, as viewers of Markdown make them."""
    titles = re.findall(r"^#+ (.+)$", FENCE.sub("", page.read_text()), re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def broken(root, page):
    text = CODE.sub("", FENCE.sub("", page.read_text()))
    for target in LINK.findall(text):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, heading = target.partition("#")
        place = (page.parent / file).resolve() if file else page
        if not place.exists() or root not in (place, *place.parents):
            yield "%s: %s is not there" % (page.relative_to(root), target)
        elif heading and place.suffix == ".md" and heading not in anchors(place):
            yield "%s: no heading makes %s" % (page.relative_to(root), target)


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    listed = subprocess.run(["git", "-C", root, "ls-files", "*.md"], capture_output=True, text=True).stdout.split()
    pages = [root / name for name in listed] or [p for p in root.rglob("*.md") if "node_modules" not in p.parts]
    trouble = [line for page in pages if page.exists() for line in broken(root, page)]
    print("\n".join(trouble) or "links: %d pages" % len(pages))
    return 1 if trouble else 0


if __name__ == "__main__":
    sys.exit(main())
