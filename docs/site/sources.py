"""The pages of the repository as Sphinx gets them: the same tree in a folder of the build, with links that lead to
pages of the site, without the marks that only tests read, and with the contents of the sidebar."""
import os
import pathlib
import re
import shutil
import tomllib

FENCE = re.compile(r"^( *)(```|~~~).*?^\1?\2 *$", re.M | re.S)
CODE = re.compile(r"`[^`\n]*`")
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\]|!\[[^\]]*\]\([^)]*\))*)\]\(([^)\s]+)\)")
MARK = re.compile(r"^ *<!-- (?:run|table|keys|end of keys)\b.*?-->\n", re.M | re.S)


class SiteError(Exception):
    """What is wrong with the site's sources: the file, what was found, what was expected."""


def contents(root):
    """(page of the beginning, [(title, pages)]) of contents.toml. Patterns are what they match in the repository.
    @raises SiteError for a part with a page that is neither there nor made"""
    with (root / "docs/site/contents.toml").open("rb") as file:
        told = tomllib.load(file)
    parts = []
    for part in told["part"]:
        pages = []
        for page in part["pages"]:
            found = sorted(str(p.relative_to(root).with_suffix("")) for p in root.glob(page + ".md"))
            if not found and not page.startswith("reference/"):
                raise SiteError(f"docs/site/contents.toml: the part '{part['title']}' has the page '{page}', expected one that "
                                f"is there: {page}.md")
            pages += found or [page]
        parts.append((part["title"], pages))
    return told["first"], parts


def with_links(text, change):
    """The text with change(link) in place of each link that is neither in fences nor in `code`; its words may be `code`."""
    def links(part):
        return re.sub(f"{LINK.pattern}|{CODE.pattern}", lambda found: change(found) if found[3] else found[0], part)
    parts, at = [], 0
    for fence in FENCE.finditer(text):
        parts += [links(text[at:fence.start()]), fence[0]]
        at = fence.end()
    return "".join([*parts, links(text[at:])])


class Tree:
    """Copies pages and the pictures in them into a folder."""

    def __init__(self, root, out, pages):
        self.root, self.out, self.pages = root, out, set(pages)

    def place_of(self, page, target):
        """The path in the repository that a link leads to, without its #heading; None if it leads elsewhere."""
        if re.match(r"[a-z]+:|#", target):
            return None
        return os.path.normpath(os.path.join(os.path.dirname(page), target.partition("#")[0]))

    def link(self, page, match):
        """A link as the site has it: files that are no pages can't be followed there, so their text stays."""
        image, text, target = match.groups()
        if text.startswith("!["):  # a picture that is a link
            text = LINK.sub(lambda inner: self.link(page, inner), text)
        place = self.place_of(page, target)
        if place is None:
            return f"{image}[{text}]({target})"
        if image:
            self.copy(place)
            return match[0]
        for name in (place, os.path.join(place, "README.md")):
            if name.endswith(".md") and name[:-3] in self.pages:
                heading = "#" + target.partition("#")[2] if "#" in target else ""
                return f"[{text}]({os.path.relpath(name, os.path.dirname(page))}{heading})"
        return text if text.startswith("`") else f"{text} (`{place}`)"

    def copy(self, place):
        source = self.root / place
        if not source.is_file():
            raise SiteError(f"{place}: a page shows this picture, but there is none")
        (self.out / place).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, self.out / place)

    def page(self, page, addition=""):
        text = MARK.sub("", (self.root / (page + ".md")).read_text(encoding="utf-8"))
        text = with_links(text, lambda match: self.link(page, match))
        place = self.out / (page + ".md")
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text + addition, encoding="utf-8")


def sidebar(first, parts):
    """The tables of contents that Sphinx makes the sidebar of."""
    folder = os.path.dirname(first)
    text = ""
    for title, pages in parts:
        if title:
            entries = "\n".join(os.path.relpath(page, folder) for page in pages)
            text += f"\n```{{toctree}}\n:hidden:\n:caption: {title}\n\n{entries}\n```\n"
    return text


def write(root, out):
    """Writes all pages that are in the repository below out. Returns all pages of the site, made ones too."""
    root, out = pathlib.Path(root), pathlib.Path(out)
    first, parts = contents(root)
    pages = [first] + [page for _, some in parts for page in some]
    hidden = [page for title, some in parts if not title for page in some if not page.startswith("plugins/")]
    forgotten = {str(p.relative_to(root).with_suffix("")) for p in root.glob("docs/**/*.md")} - set(pages)
    if forgotten:
        raise SiteError(f"docs/site/contents.toml lacks {', '.join(sorted(forgotten))}: expected each page of docs/ in a part")
    tree = Tree(root, out, pages)
    for page in pages:
        if (root / (page + ".md")).is_file():
            tree.page(page, sidebar(first, parts) if page == first else "")
    for page in hidden:  # front matter: in no table of contents, and meant so
        place = out / (page + ".md")
        place.write_text("---\norphan: true\n---\n\n" + place.read_text(encoding="utf-8"), encoding="utf-8")
    return pages
