"""The page of all keys of robot files, world files and scenes: the rows of all tables of keys, sorted, each with a link to
its table. Those tables are compared with the code by tests (mcl.MclSettingsLimits, hygiene.robots_page, docs.complete)."""
import os
import re

HEAD = re.compile(r"^\| (?:key|option)\b(?: of `?([^|]*?)`?)? \|")
PAGES = ("docs/robots.md", "docs/mcl.md", "docs/worlds.md", "docs/motion.md", "docs/real-robot.md", "docs/referee.md")


def cells(row):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", row.strip().strip("|"))]


def slug(heading):
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def rows(root, page):
    """(key, default, meaning, page, heading, slug) of each row of each table of keys of a page."""
    heading, head = "", None
    for line in (root / page).read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            heading = line.lstrip("# ")
        if HEAD.match(line):
            head = cells(line)
        elif not line.startswith("|"):
            head = None
        elif head and not re.match(r"^\|[-| :]+\|$", line):
            row = dict(zip(head, cells(line)))
            meaning = row.get("meaning") or row.get("what") or ""
            yield row[head[0]], row.get("default", ""), meaning, page, heading


def moved(text, page):
    """Links of a row as seen from reference/keys.md."""
    def link(match):
        target, _, place = match[1].partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(page), target)) if target else page
        return "](" + os.path.relpath(path, "reference") + ("#" + place if place else "") + ")"
    return re.sub(r"\]\((?!https?:)([^)]*)\)", link, text)


def page(root):
    found = sorted((row for name in PAGES for row in rows(root, name) if row[0].startswith("`")),
                   key=lambda row: row[0].strip("`").lower())
    lines = ["# All keys, A to Z", "",
             "Keys of robot files, of worlds and of what plugins take, in one table. The page behind a key's link says more of "
             "it, and which table of the file it belongs to. A key that nobody reads is an error, so a typing error is found "
             "at once; `ortung check FILE` looks at a file without running anything.", "",
             "| key | default | meaning | where |", "|---|---|---|---|"]
    for key, default, meaning, name, heading in found:
        where = f"[{heading}](../{name}#{slug(heading)})"
        lines.append(f"| {key} | {moved(default, name)} | {moved(meaning, name)} | {where} |")
    return "\n".join(lines) + "\n"
