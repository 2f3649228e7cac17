"""Places where a source can be changed so that it does something else: found with libclang, written behind a switch."""

import json
import os
import re
import shlex
from dataclasses import asdict, dataclass, field
from pathlib import Path

from clang.cindex import CursorKind as K, Index, TypeKind as T

NUMBERS = {T.BOOL, T.CHAR_U, T.UCHAR, T.CHAR_S, T.SCHAR, T.USHORT, T.UINT, T.ULONG, T.ULONGLONG, T.SHORT, T.INT, T.LONG,
           T.LONGLONG, T.FLOAT, T.DOUBLE, T.LONGDOUBLE, T.ENUM}
FRACTIONS = {T.FLOAT, T.DOUBLE, T.LONGDOUBLE}
# Between fractions a boundary is met by chance only, so "<" for "<=" would nearly always be the same program.
COMPARED = {"<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"), "==": ("!=", "!="), "!=": ("==", "==")}
COMPUTED = {"+": "-", "-": "+", "*": "/", "/": "*"}
FUNCTIONS = {K.FUNCTION_DECL, K.CXX_METHOD, K.CONSTRUCTOR, K.DESTRUCTOR, K.CONVERSION_FUNCTION, K.FUNCTION_TEMPLATE}
# What is thrown is a message; what must be known to the compiler can't wait for a switch.
LEFT_OUT = {K.CXX_THROW_EXPR, K.STATIC_ASSERT, K.ENUM_DECL, K.TEMPLATE_NON_TYPE_PARAMETER}
# No literals of a user's, like 5ms.
PLAIN_NUMBER = re.compile(r"(0[xX][0-9a-fA-F']+|[0-9][0-9']*(\.[0-9']*)?([eE][-+]?[0-9]+)?)[uUlLfFzZ]*")
# Calls whose absence costs time alone, or that only tell somebody.
NO_EFFECT = ("reserve", "shrink_to_fit", "notify", "progress", "warn", "log", "print")


@dataclass
class Site:
    """One change: the pieces to replace (offset, length, text with {id}), and what people read about it."""
    file: str
    line: int
    function: str
    kind: str
    original: str
    change: str
    edits: list = field(default_factory=list)

    def key(self):
        return f"{self.file}: {self.function}: {self.change}: {self.original}"

    def to_json(self):
        return asdict(self)


def compile_commands(build):
    """(source, arguments) of every translation unit that the build knows."""
    seen = set()
    for entry in json.loads((build / "compile_commands.json").read_text()):
        source = entry["file"]
        if source in seen or not source.endswith(".cpp"):
            continue
        seen.add(source)
        arguments = [a for a in shlex.split(entry["command"])[1:] if a not in ("-c", source)]
        if "-o" in arguments:
            at = arguments.index("-o")
            del arguments[at:at + 2]
        yield source, arguments


class Finder:
    """Walks one translation unit; remembers which headers it has been through."""

    def __init__(self, root):
        self.root = str(root) + "/"
        self.done = set()
        self.texts = {}

    def name(self, path):
        """As git has it: an include of "../common/a.hpp" is found as lrf/../common/a.hpp."""
        return os.path.normpath(path)[len(self.root):]

    def text(self, path):
        if path not in self.texts:
            self.texts[path] = Path(path).read_bytes()
        return self.texts[path]

    def sites(self, source, arguments, wanted):
        """The sites in `source` and in headers seen for the first time, of files for which wanted(path) holds."""
        unit = Index.create().parse(source, args=arguments)
        found = []
        files = set()
        for cursor in unit.cursor.get_children():
            file = cursor.location.file
            if file is None or not file.name.startswith(self.root):
                continue
            name = self.name(file.name)
            if name in self.done or not wanted(name):
                continue
            files.add(name)
            self.walk(cursor, "", False, found)
        self.done |= files
        return found

    def walk(self, cursor, function, constant, found):
        kind = cursor.kind
        if kind in LEFT_OUT:
            return
        if kind in FUNCTIONS:
            function = f"{cursor.semantic_parent.spelling}::{cursor.spelling}" if cursor.semantic_parent else cursor.spelling
            constant = self.says(cursor, b"constexpr", b"{")
        elif kind == K.VAR_DECL and self.says(cursor, b"constexpr", b"="):
            return
        self.look(cursor, function, constant, found)
        for child in cursor.get_children():
            self.walk(child, function, constant, found)

    def says(self, cursor, word, end):
        text = self.slice(cursor)
        return word in text[:text.find(end) if end in text else len(text)]

    def slice(self, cursor):
        extent = cursor.extent
        return self.text(extent.start.file.name)[extent.start.offset:extent.end.offset] if extent.start.file else b""

    def look(self, cursor, function, constant, found):
        if not function or cursor.extent.start.file is None:
            return
        name = cursor.extent.start.file.name
        if not name.startswith(self.root):
            return
        handler = {K.BINARY_OPERATOR: self.operator, K.INTEGER_LITERAL: self.number, K.FLOATING_LITERAL: self.number,
                   K.IF_STMT: self.condition, K.COMPOUND_STMT: self.statements}.get(cursor.kind)
        if handler is None:
            return
        for kind, change, edits in handler(cursor, "constant" if constant else ""):
            text = self.text(name)
            line = text.count(b"\n", 0, edits[0][0])
            original = text.splitlines()[line].decode().strip()
            found.append(Site(self.name(name), line + 1, function, kind, original, change, edits))

    def operator(self, cursor, constant):
        children = list(cursor.get_children())
        if len(children) != 2:
            return
        left, right = (c.extent for c in children)
        text = self.text(left.start.file.name)
        between = text[left.end.offset:right.start.offset]
        token = between.strip().decode(errors="replace")
        start, end, middle = left.start.offset, right.end.offset, (left.end.offset, right.start.offset)
        if token in ("&&", "||"):
            # One of the two conditions no longer counts.
            neutral, join = ("ortung_mutant::on({id}) || ", "&&") if token == "&&" else ("!ortung_mutant::on({id}) && ", "||")
            for side, (a, b) in (("right", (right.start.offset, end)), ("left", (start, left.end.offset))):
                yield ("condition left out", f"{side} of {token}",
                       [[a, 0, f"({neutral}static_cast<bool>("], [b, 0, "))"]])
            return
        types = [c.type.get_canonical().kind for c in children]
        if not all(t in NUMBERS for t in types):
            return
        if token in COMPARED:
            fractions = any(t in FRACTIONS for t in types)
            names = ("comparison",)
            others = COMPARED[token][1:] if fractions else dict.fromkeys(COMPARED[token])
        elif token in COMPUTED and not any(t in (T.ENUM, T.BOOL) for t in types):
            names, others = ("arithmetic",), (COMPUTED[token],)
        else:
            return
        for other in others:
            function = "constantBinary" if constant else "binary"
            tail = f"), [](auto a, auto b) {{ return a {token} b; }}, [](auto a, auto b) {{ return a {other} b; }})"
            yield (names[0], f"{token} -> {other}",
                   [[start, 0, f"ortung_mutant::{function}({{id}}, ("], [middle[0], middle[1] - middle[0], "), ("], [end, 0, tail]])

    def number(self, cursor, constant):
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        text = self.text(cursor.extent.start.file.name)[start:end].decode(errors="replace")
        if not PLAIN_NUMBER.fullmatch(text):
            return
        zero = text.strip("0.'fFuUlLzZ") == ""
        if cursor.kind == K.INTEGER_LITERAL:
            mutated = "1" if zero else f"({text} + 1)"
        else:
            mutated = "1.0" if zero else f"(2 * {text})"
        function = "constantValue" if constant else "value"
        yield ("number", f"{text} -> {mutated.strip('()')}",
               [[start, end - start, f"ortung_mutant::{function}<decltype({text})>({{id}}, {text}, {mutated})"]])

    def condition(self, cursor, _):
        children = list(cursor.get_children())
        start = cursor.extent.start.offset
        head = children[0].extent
        text = self.text(cursor.extent.start.file.name)
        opening = text[start:head.start.offset].split()
        if b"".join(opening) != b"if(" or children[0].kind == K.DECL_STMT:
            return
        after = text[head.end.offset:head.end.offset + 1]
        if after != b")":
            return
        yield ("condition turned round", "if (c) -> if (!c)",
               [[head.start.offset, 0, "ortung_mutant::on({id}) != static_cast<bool>("], [head.end.offset, 0, ")"]])

    def statements(self, cursor, _):
        for child in cursor.get_children():
            if child.kind not in (K.CALL_EXPR, K.BINARY_OPERATOR, K.COMPOUND_ASSIGNMENT_OPERATOR, K.UNARY_OPERATOR):
                continue
            if any(word in child.spelling.lower() for word in NO_EFFECT):
                continue
            extent = child.extent
            text = self.text(extent.start.file.name)
            if text[extent.end.offset:extent.end.offset + 1] != b";":
                continue
            words = text[extent.start.offset:extent.end.offset].decode(errors="replace").split()
            yield ("statement left out", "left out: " + " ".join(words)[:100],
                   [[extent.start.offset, 0, "if (!ortung_mutant::on({id})) { "], [extent.end.offset + 1, 0, " }"]])


def apply(text, sites):
    """`text` (bytes) with all `sites` (number, Site) of this file behind their switches."""
    edits = []
    for number, site in sites:
        for order, (offset, length, new) in enumerate(site.edits):
            edits.append((offset, length, order, new.replace("{id}", str(number))))
    for offset, length, _, new in sorted(edits, reverse=True):
        text = text[:offset] + new.encode() + text[offset + length:]
    return text


def overlapping(a, b):
    """Whether two sites of a file can't be written into it together."""
    def span(site):
        return (min(e[0] for e in site.edits), max(e[0] + e[1] for e in site.edits))
    (a0, a1), (b0, b1) = span(a), span(b)
    return a.file == b.file and a0 <= b1 and b0 <= a1
