"""The figures of docs/results.md: their numbers are read from tables of pages, as docs/results/figures.toml says."""
import os
import re
import statistics
import tomllib

import results_charts

FILE = "docs/results/figures.toml"
NUMBER = re.compile(r"[+-]?\d[\d,]*(?:\.\d+)?")
MEASURED = re.compile(r"Measured at commit `(\w+)` of (\d{4}-\d\d-\d\d)")
END = """
## Everything else

- [How to read the tables](results/tables.md), and the command that makes all of them
- On real logs: [lasers](results/laser.md), [landmarks](results/landmarks.md), [beacons](results/beacons.md),
  [wake-ups, kidnaps and teleports](results/recovery.md), [constructed faults](results/faults.md)
- In simulation: [against what is possible, and what sensors and learned models are worth](results/simulated.md),
  [one robot, three ways](results/three-ways.md), [goalkeepers](results/goalkeepers.md)
- [The recordings](results/data.md): where they are, and their licences
- [Performance](performance.md) and [what was tried to break it](reliability.md)

This page and its charts are made by `scripts/results_page.py` of the tables and `docs/results/figures.toml`.
"""


class FigureError(Exception):
    """What is wrong with a figure: where, what was found, what was expected."""


def cells(line):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip()[1:-1])]


def tables(text):
    """[(names, measured, head, rows)] of all tables of a page. Names: its mark's and the heading above it; measured: (commit, date)
    that stands between mark or heading and table, or None."""
    found, mark, heading, measured, rows = [], None, None, None, []
    for line in [*text.splitlines(), ""]:
        if line.startswith("|"):
            rows.append(cells(line))
            continue
        if len(rows) > 2:
            found.append(({mark, heading} - {None}, measured, rows[0], rows[2:]))
            mark = measured = None
        rows = []
        if told := re.match(r"<!-- table: (.*) -->", line):
            mark, measured = told[1], None
        elif told := re.match(r"#+ (.*)", line):
            heading, mark, measured = told[1], None, None
        elif told := MEASURED.match(line):
            measured = told.groups()
    return found


def numbers_of(cell):
    """All numbers in a cell; commas part thousands."""
    return [float(number.replace(",", "")) for number in NUMBER.findall(cell)]


def fits(cell, wanted):
    """Whether a cell is what a series asks for."""
    if isinstance(wanted, str):
        return cell == wanted
    numbers = numbers_of(cell)
    for word, value in wanted.items():
        if word in ("least", "most") and not numbers:
            return False
        if not {"starts": lambda: cell.startswith(value), "unlike": lambda: cell != value,
                "least": lambda: numbers[0] >= value, "most": lambda: numbers[0] <= value}[word]():
            return False
    return True


class Series:
    """Bars of one colour: {label: (value, low, high)}, what they come to, and what they were measured with."""

    def __init__(self, root, figure, told):
        self.name, self.figure, self.told = told["name"], figure, told
        self.share = told.get("share", figure.get("share", False))
        self.values, self.counts = {}, []
        self.measured = (told["commit"], told["date"]) if "commit" in told else None
        if "values" in told:
            self.values = {label: (float(value), None, None) for label, value in told["values"]}
        else:
            self.read(root)
        if self.measured is None:
            raise self.error("neither the table nor the series says commit and date, expected one of them to")

    def error(self, text):
        return FigureError("%s: figure '%s', series '%s': %s" % (FILE, self.figure["name"], self.name, text))

    def table(self, root):
        told = self.told
        with open(os.path.join(root, told["page"]), encoding="utf-8") as page:
            found = tables(page.read())
        wanted = [told["column"], *told.get("label", []), *told.get("where", {})]
        for names, measured, head, rows in found:
            if told.get("table", None) in (None, *names) and all(isinstance(w, int) or w in head for w in wanted):
                self.measured = self.measured or measured
                return head, [row for row in rows if all(fits(row[head.index(c)], w) for c, w in told.get("where", {}).items())]
        raise self.error("%s has no table '%s' with the columns %s" % (told["page"], told.get("table"), wanted))

    def read(self, root):
        told, scale = self.told, self.figure.get("scale", 1)
        head, rows = self.table(root)
        if "nth" in told:
            rows = rows[told["nth"]:][:1]
        column = told["column"] if isinstance(told["column"], int) else head.index(told["column"])
        for row in rows:
            numbers = numbers_of(row[column]) if column < len(row) else []
            if "of" in told and numbers:
                numbers.append(float(row[head.index(told["of"])]))
            label = told.get("label_text", "{0}").format(*[row[head.index(n)].strip("`") for n in told.get("label", [])] or [""])
            if self.share and len(numbers) > 1:
                self.counts.append(numbers[:2])
            elif len(numbers) > told.get("number", 0):
                value = scale * numbers[told.get("number", 0)]
                self.values[label] = (value, *numbers[1:3]) if told.get("interval") else (value, None, None)
        if self.counts:
            right, of = map(sum, zip(*self.counts))
            self.values = {self.name: (100 * right / of, None, None)}
        if not self.values:
            raise self.error("no row of the table fits, expected at least one")

    def aggregate(self):
        """What the headline says of it: a number, or words."""
        values = [v for v, _, _ in self.values.values()]
        kind = self.told.get("aggregate")
        if kind == "sum":
            return "%d of %d" % tuple(map(sum, zip(*self.counts)))
        if kind == "range":
            return "%g to %g" % (min(values), max(values))
        return {"median": statistics.median, "max": max, "first": lambda v: v[0], "last": lambda v: v[-1]}[kind](values)


def read(root):
    """(text above all, [(figure, its series)])
    @raises FigureError if a figure lacks what it needs, or a table what a figure asks for"""
    with open(os.path.join(root, FILE), "rb") as file:
        told = tomllib.load(file)
    for figure in told["figure"]:
        for key in ("name", "title", "headline", "unit", "text", "run", "command", "series"):
            if not figure.get(key):
                raise FigureError("%s: figure '%s' has no %s" % (FILE, figure.get("name"), key))
    return told["head"], [(figure, [Series(root, figure, s) for s in figure["series"]]) for figure in told["figure"]]


def headline(figure, series):
    """The figure itself. {0}, {1}: of the series that have an aggregate; {ratio}: of the second to the first."""
    values = [s.aggregate() for s in series if "aggregate" in s.told]
    numbers = [v for v in values if not isinstance(v, str)]
    return figure["headline"].format(*values, ratio=numbers[1] / numbers[0] if len(numbers) > 1 else 0)


def drawn(figure, series):
    """Series of one name are one, in the chart."""
    merged = {}  # name: colour, values
    for one in series:
        if one.told.get("drawn", True):
            merged.setdefault(one.name, (one.told.get("colour", len(merged)), {}))[1].update(one.values)
    return results_charts.chart("%s: %s" % (figure["title"], headline(figure, series)), figure["unit"],
                                [(name, *rest) for name, rest in merged.items()], figure.get("most"), figure.get("digits", 0))


def section(figure, series):
    """What the page says of a figure."""
    of = {}
    for one in series:
        of.setdefault(one.measured, []).append(one.name)
    words = ["%s of %s" % ("commit `%s`" % commit, date) + (" (%s)" % ", ".join(dict.fromkeys(names)) if len(of) > 1 else "")
             for (commit, date), names in of.items()]
    return "\n## %s\n\n**%s**\n\n![%s: %s](%s)\n\n%s\n\nMeasured at %s, by\n\n<!-- run: %s -->\n```sh\n%s\n```\n" % (
        figure["title"], headline(figure, series), figure["title"], figure["unit"], "pictures/results-%s.svg" % figure["name"],
        figure["text"].strip(), "; ".join(words), figure["run"], figure["command"])


def files(root):
    """{path below the root: text} of the page and its charts."""
    head, figures = read(root)
    made = {"docs/pictures/results-%s.svg" % figure["name"]: drawn(figure, series) for figure, series in figures}
    made["docs/results.md"] = "# Results\n" + head + "".join(section(*figure) for figure in figures) + END
    return made
