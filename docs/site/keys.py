"""The page of all keys of robot files, worlds and scenes. Which keys there are, what they may hold and what they are without
being told is asked of the program (`ortung check --schema`, which asks the readers and the plugins); what they mean stands in the
tables of the pages. A key that no table tells about is an error of the site."""
import json
import os
import re
import subprocess

import sources

HEAD = re.compile(r"^\|(?: table \|)? (?:key|option)\b(?: of `?([^|]*?)`?)? \|")
PAGES = ("docs/robots.md", "docs/mcl.md", "docs/worlds.md", "docs/simulation.md", "docs/motion.md", "docs/cameras.md",
         "docs/real-robot.md", "plugins/sensors/image_features/README.md", "plugins/sensors/teammate/README.md")
KINDS = {"robot": "robot files", "world": "worlds", "scene": "scenes"}


def cells(row):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", row.strip().strip("|"))]


def slug(heading):
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def names(cell):
    """The keys that a cell tells about, those of inner tables too: pose, x_m and y_m of "`pose = { x_m, y_m }`"."""
    return re.findall(r"\w+", " ".join(re.findall(r"`([^`]*)`", cell)))


def rows(root, page):
    """Each row of each table of keys of a page: keys, default, meaning, page, heading, and of which tables and plugins it is."""
    heading, head, table = "", None, ""
    for line in (root / page).read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            heading = line.lstrip("# ")
        if HEAD.match(line):
            head, table = cells(line), ""
        elif not line.startswith("|"):
            head = None
        elif head and not re.match(r"^\|[-| :]+\|$", line):
            row = dict(zip(("key" if name.startswith(("key", "option")) else name for name in head), cells(line)))
            table = row.get("table") or table
            of = re.findall(r"`([^`]*)`", " ".join((heading, table, *head)))
            of += [page.split("/")[-2]] if page.startswith("plugins/") else []
            inner = [name for name in re.findall(r"`([^`]*)`", head[0]) if not name.startswith("[")]
            yield {"keys": names(row["key"]), "inner": inner, "default": row.get("default", ""), "of": of, "page": page,
                   "heading": heading, "meaning": row.get("meaning") or row.get("what") or ""}


def entries(schema):
    """(table, plugin, key, what it may hold and its default) of all keys of a schema."""
    def of_table(table, plugin, path, part):
        for key, value in sorted(part.get("properties", {}).items()):
            name = path + key
            if value.get("type") == "array" and "properties" in value.get("items", {}):
                yield from of_part(f"[[{(table.strip('[]') + '.' if table else '') + name}]]", value["items"])
            elif "properties" in value or "allOf" in value:
                yield table, plugin, name, value
                yield from of_table(table, plugin, name + ".", value)
            else:
                yield table, plugin, name, value

    def of_part(table, part):
        plugins = part.get("allOf", [])
        if not plugins:
            yield from of_table(table, None, "", part)
        for one in plugins:
            yield from of_table(table, one["if"]["properties"]["plugin"]["const"], "", one["then"])

    for name, value in schema["properties"].items():
        if value.get("type") == "array":
            yield from of_part(f"[[{name}]]", value.get("items", {}))
        elif "properties" in value:
            yield from of_part(f"[{name}]", value)


def told(found, table, plugin, key):
    """The row that says what a key means, or None: one of the plugin's own before one of its table, and that before one of
    what the table is like."""
    like = [plugin, table, f"[{table.strip('[]').split('.')[-1]}]", "differential" if table == "[drive]" else None,
            "[[body]]" if table.endswith("body]]") else None]
    outer, last = key.split(".")[0], key.split(".")[-1]
    for of in filter(None, like):
        for row in found:
            if of in row["of"] and last in row["keys"] and (
                    outer in row["inner"] if row["inner"] and outer != last else outer in row["keys"] and not row["inner"]):
                return row
    # What all sensors have, within the table of one of their features.
    return next((row for row in found if row["heading"] == "`[[sensor]]`" and last in row["keys"]), None)


def moved(text, page):
    """Links of a row as seen from reference/keys.md."""
    def link(match):
        target, _, place = match[1].partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(page), target)) if target else page
        return "](" + os.path.relpath(path, "reference") + ("#" + place if place else "") + ")"
    return re.sub(r"\]\((?!https?:)([^)]*)\)", link, text)


def holds(value):
    """What a key may hold, and its default, as the schema says them: ("a number in [0, 1]", "0.5")."""
    what, _, default = value.get("description", "").partition("; default: ")
    return what, f"{float(default):.4g}" if re.fullmatch(r"-?[\d.]+", default) else default


def page(root, program):
    found = [row for name in PAGES for row in rows(root, name)]
    merged, untold = {}, []
    for kind in KINDS:
        schema = json.loads(subprocess.run([program, "check", "--schema", kind], check=True, capture_output=True,
                                           text=True).stdout)
        for table, plugin, key, value in entries(schema):
            row = told(found, table, plugin, key)
            if row and "." in key and row is told(found, table, plugin, key.rpartition(".")[0]):
                continue  # told with the table that it is in
            if not row or not row["meaning"]:
                untold.append(f"{key} of {table}" + (f" of {plugin}" if plugin else ""))
                continue
            what, default = holds(value)
            line = (key, what, default or row["default"], row["meaning"], row["page"], row["heading"])
            merged.setdefault(line, {}).setdefault(table, []).append(plugin)
    if untold:
        raise sources.SiteError("keys whose meaning stands in no table of " + ", ".join(PAGES) + ": " + ", ".join(untold))
    lines = ["# All keys, A to Z", "",
             "Every key of [robot files](../docs/robots.md), [worlds](../docs/worlds.md) and [scenes](../docs/simulation.md#scenes) "
             "with what it may hold and its default, as the program and its plugins say them. A file with a key that is not here is "
             "refused with its line and the nearest known key; `ortung check FILE` looks at a file without running anything, and "
             "`ortung check --schema robot` prints the same for editors.", "",
             "| key | holds | meaning |", "|---|---|---|"]
    for (key, what, default, meaning, name, heading), tables in sorted(merged.items(), key=lambda item: item[0][0].lower()):
        of = "; ".join(f"`{table}`" + (": " + ", ".join(filter(None, plugins)) if any(plugins) else "")
                       for table, plugins in tables.items())
        value = "; ".join(filter(None, (what, default and (default if default == "must be there" else f"default: {default}"))))
        place = f"[{heading.replace('`', '')}](../{name}#{slug(heading)})"
        lines.append(f"| `{key}` of {of} | {value} | {moved(meaning, name)} ({place}) |")
    return "\n".join(lines) + "\n"
