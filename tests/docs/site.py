#!/usr/bin/env python3
"""site.py HTML  looks at a built site: its links and anchors lead somewhere in it, nothing is loaded from elsewhere, pictures
and tables are whole, each page is reached from the first one, and the search knows what readers look for.

Prints what is wrong, and ends with 1.
"""
import html.parser
import json
import pathlib
import re
import sys
import urllib.parse

LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src", "video": "src", "audio": "src",
          "object": "data", "embed": "src"}
# Words that a reader of each kind looks for, with a page that has to be among those that the search finds.
WORDS = {"kidnap": "docs/method/recovery", "amcl": "docs/ros2", "learnprob": "docs/architecture", "mrclam": "docs/results/landmarks",
         "gymnasium": "docs/learning", "budget_m": "reference/keys", "sensorcontain": "reference/cpp/container-core"}


class Page(html.parser.HTMLParser):
    """What a page of HTML links to, loads and has."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loads, self.pictures_without_text, self.headless = set(), [], [], [], 0
        self.in_table = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        told = dict(attributes)
        self.anchors |= {told[key] for key in ("id", "name") if told.get(key)}
        if tag == "a" and told.get("href"):
            self.links.append(told["href"])
        if tag in LOADED and told.get(LOADED[tag]) and told.get("rel") not in ("canonical", "author", "next", "prev"):
            self.loads.append(told[LOADED[tag]])
        if tag == "img" and not told.get("alt"):
            self.pictures_without_text.append(told.get("src"))
        if tag == "table":
            self.in_table.append(False)
        if tag == "th" and self.in_table:
            self.in_table[-1] = True

    def handle_endtag(self, tag):
        if tag == "table" and self.in_table and not self.in_table.pop():
            self.headless += 1


class Site:
    def __init__(self, root):
        self.root = pathlib.Path(root).resolve()
        self.pages = {str(p.relative_to(self.root)): Page(p.read_text(encoding="utf-8"))
                      for p in sorted(self.root.rglob("*.html")) if "_static" not in p.parts}

    def target(self, page, link):
        """(file below the root, anchor) of a link; None if it leads elsewhere."""
        if re.match(r"[a-z]+:|//", link):
            return None
        path, _, anchor = link.partition("#")
        path = urllib.parse.unquote(path.partition("?")[0])
        place = (self.root / page).parent / path if path else self.root / page
        return place.resolve(), urllib.parse.unquote(anchor)

    def wrong_links(self, page):
        for link in self.pages[page].links + self.pages[page].loads:
            if (target := self.target(page, link)) is None:
                continue
            place, anchor = target
            if self.root not in place.parents or not place.is_file():
                yield f"{page}: the link {link} leads to no file of the site"
            elif anchor and place.suffix == ".html":
                name = str(place.relative_to(self.root))
                if name in self.pages and anchor not in self.pages[name].anchors:
                    yield f"{page}: the link {link} leads to a page without that anchor"

    def wrong(self):
        for name, page in self.pages.items():
            yield from self.wrong_links(name)
            yield from (f"{name}: loads {load}, expected nothing from elsewhere" for load in page.loads
                        if self.target(name, load) is None and not load.startswith("data:"))
            yield from (f"{name}: the picture {picture} has no text in its place" for picture in page.pictures_without_text)
            if page.headless and name not in ("genindex.html",) and not name.startswith("reference/cpp/"):
                yield f"{name}: {page.headless} tables without a head"
        for style in self.root.rglob("*.css"):
            for url in re.findall(r"(?:@import\s+|url\()\s*[\"']?((?:https?:)?/[^\"')]+)", style.read_text(encoding="utf-8")):
                yield f"{style.relative_to(self.root)}: loads {url}, expected nothing from elsewhere"
        yield from self.unreachable()
        yield from self.wrong_search()

    def unreachable(self):
        """Pages that no way leads to from the first one."""
        seen, open_pages = set(), ["index.html"]
        while open_pages:
            name = open_pages.pop()
            if name in seen or name not in self.pages:
                continue
            seen.add(name)
            targets = [self.target(name, link) for link in self.pages[name].links]
            open_pages += [str(t[0].relative_to(self.root)) for t in targets if t and self.root in t[0].parents]
        for name in sorted(set(self.pages) - seen - {"search.html", "genindex.html"}):
            yield f"{name}: no link leads there from index.html"

    def wrong_search(self):
        text = (self.root / "searchindex.js").read_text(encoding="utf-8")
        index = json.loads(text[text.index("(") + 1:text.rindex(")")])
        for word, wanted in WORDS.items():
            numbers = set()
            for places in [found for key in ("terms", "titleterms") for term, found in index[key].items() if term.startswith(word)]:
                numbers |= set(places) if isinstance(places, list) else {places}
            if index["docnames"].index(wanted) not in numbers:
                yield f"searchindex.js: '{word}' is not found in {wanted}"
        for page in index["docnames"]:
            if page + ".html" not in self.pages:
                yield f"searchindex.js: has {page}, but there is no such page"


SKIPPED = 77

if __name__ == "__main__":
    if not (pathlib.Path(sys.argv[1]) / "index.html").exists():
        print(f"Skipped\n{sys.argv[1]} has no site: docs.site says why")
        sys.exit(SKIPPED)
    site = Site(sys.argv[1])
    trouble = list(site.wrong())
    if len(site.pages) < 40:
        trouble.append(f"{len(site.pages)} pages, expected more than 40")
    print("\n".join(trouble) or f"site: {len(site.pages)} pages")
    sys.exit(1 if trouble else 0)
