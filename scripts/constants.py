"""The filter's constants, as the Tuning headers of its rooms declare them, and the page that shows what each one changes."""
import glob
import os
import re
import typing

DECLARED = re.compile(r"((?:^///[^\n]*\n)+)ORTUNG_CONSTANT\((\w+), (\w+),\s*([^;]+)\);", re.M)
ROW = re.compile(r"^(\| `(\w+)` \| ([^|]+?) \|.*)$", re.M)
FITTED = re.compile(r"<!-- confidence was fitted with: (.*?) -->", re.S)
PART = re.compile(r"^### `(\w+)`", re.M)


class Constant(typing.NamedTuple):
    """`part.name` with the number and the text that stand in the header."""
    room: str
    part: str
    name: str
    value: float
    unit: str
    what: str

    @property
    def key(self):
        return self.part + "." + self.name

    @property
    def shown(self):
        return ("%g" % self.value) + (" " + self.unit if self.unit and self.unit != "share" else "")

    def times(self, factor):
        """So many times the value; of a share the odds, so that it stays one."""
        if self.unit == "share":
            odds = factor * self.value / (1.0 - self.value)
            return odds / (1.0 + odds)
        return factor * self.value


def declared(root):
    """All constants, room by room in the order of their headers; raises ValueError where one says nothing of itself."""
    found = []
    for header in sorted(glob.glob(os.path.join(root, "mcl/src/*/*Tuning.hpp"))):
        with open(header) as file:
            text = file.read()
        named = DECLARED.findall(text)
        if len(named) != text.count("ORTUNG_CONSTANT("):
            raise ValueError("%s: %d of %d constants have a comment with `///`" %
                             (header, len(named), text.count("ORTUNG_CONSTANT(")))
        for comment, part, name, value in named:
            what = " ".join(line[3:].strip() for line in comment.strip().split("\n"))
            unit = re.match(r"\[([^\]]+)\] ", what)
            number = re.search(r"-?[\d'.]+(?:e-?\d+)?", value.replace("std::size_t", "")).group().replace("'", "")
            found.append(Constant(os.path.basename(os.path.dirname(header)), part, name, float(number),
                                  unit.group(1) if unit else "", what[unit.end():] if unit else what))
    return found


def rows_of(page):
    """{part.name: (line, value as it is shown)} of a page."""
    rows = {}
    pieces = PART.split(page)
    for part, text in zip(pieces[1::2], pieces[2::2]):
        for line, name, value in ROW.findall(text):
            rows[part + "." + name] = line, value
    return rows


def unmeasured(constants, page):
    rows = rows_of(page)
    return [c.key for c in constants if c.key not in rows]


def with_fit(page, constants):
    """The page that says with which constants, beside its own, confidence was fitted."""
    values = " ".join("%s=%g" % (c.key, c.value) for c in constants if c.part != "confidence")
    return FITTED.sub("<!-- confidence was fitted with: %s -->" % values, page)


def since_the_fit(constants, page):
    """A sentence on what has changed since confidence was fitted; "" if nothing has."""
    fitted = dict(word.split("=") for word in FITTED.search(page).group(1).split() if "=" in word)
    if not fitted:
        return "confidence was fitted before its constants were noted: scripts/fit-confidence.py"
    now = {c.key: "%g" % c.value for c in constants if c.part != "confidence"}
    changed = sorted(key for key in now.keys() | fitted.keys() if now.get(key) != fitted.get(key))
    if not changed:
        return ""
    return "confidence was fitted with other values of %s: scripts/fit-confidence.py" % ", ".join(changed)


def differences(constants, page):
    """Sentences on what the page has with another value, or has too much of. What was never measured is told by unmeasured()."""
    shown = {key: value for key, (_, value) in rows_of(page).items()}
    trouble = ["%s is %s in the code and was %s when it was measured" % (c.key, c.shown, shown[c.key])
               for c in constants if shown.get(c.key, c.shown) != c.shown]
    return trouble + ["%s is in the page alone" % key for key in shown if key not in {c.key for c in constants}]
