"""The page of the Python package's functions and classes, in reStructuredText: their signatures from the stubs that type checkers
read (python/tests/test_stubs.py compares them with what is compiled), their words from the package itself, if it is there."""
import ast
import importlib
import inspect
import re
import sys

import sources

MODULES = (("ortung", "_core.pyi", "Robots, tables, records and localization"),
           ("ortung", "_sim.pyi", "Worlds, simulations and learning"),
           ("ortung.draw", "draw.pyi", "Pictures"),
           ("ortung.sweep", "sweep.py", "Sweeps"),
           ("ortung", "_learning.pyi", "Environments in batches"),
           ("ortung", "single_agent.pyi", "Gymnasium's interface"),
           ("ortung", "multi_agent.pyi", "PettingZoo's interface"))


def without_signatures(text):
    """Words of a docstring: pybind11 puts the signatures of a function before them."""
    blocks = re.split(r"\n\s*\n", inspect.cleandoc(text))
    return [block for block in blocks if not re.match(r"(\d+\. )?\w+\(.*\) -> |Overloaded function", block)]


def words(text):
    """A docstring as paragraphs in which nothing is markup but code between backticks."""
    def plain(part):
        return re.sub(r"(\w)_(?!\w)", r"\1\\_", re.sub(r"([\\*|])", r"\\\1", part))

    for block in without_signatures(text):
        parts = re.split(r"`+([^`]*)`+", " ".join(block.split()))
        yield "".join(f"``{part}``" if i % 2 else plain(part) for i, part in enumerate(parts))


class Words:
    """What the package says of its names; nothing if it is not there."""

    def __init__(self, folder):
        self.is_there = folder is not None
        self.missing = []
        if self.is_there:
            sys.path.insert(0, str(folder))

    def of(self, module, name, indent):
        if not self.is_there:
            return []
        thing = importlib.import_module(module)
        for part in name.split("."):
            thing = getattr(thing, part, None)
        # What a class has from `object` says nothing of it.
        text = getattr(thing, "__doc__", None) or ""
        if not text or text == getattr(object, name.split(".")[-1], type).__doc__:
            if not name.endswith(("__init__", ".value", ".name")):  # as of every enumeration
                self.missing.append(f"{module}.{name}")
            return []
        return [line for block in words(text) for line in (indent + block, "")]


def signature(function):
    arguments = ast.unparse(function.args)
    names = arguments.removeprefix("self").removeprefix("cls").removeprefix(", ")
    returns = f" -> {ast.unparse(function.returns)}" if function.returns else ""
    return f"({names}){returns}"


def member(node, indent, told):
    """A method, property or attribute of a class. @param told what the package says of a name of the class, indented"""
    if isinstance(node, ast.FunctionDef):
        decorators = [ast.unparse(d) for d in node.decorator_list]
        if "property" in decorators:
            lines = [f"{indent}.. py:property:: {node.name}", f"{indent}   :type: {ast.unparse(node.returns)}"]
        elif any(d.endswith(".setter") for d in decorators):
            return []
        else:
            lines = [f"{indent}.. py:method:: {node.name}{signature(node)}"]
            lines += [f"{indent}   :{d}:" for d in decorators if d in ("staticmethod", "classmethod")]
        return lines + [""] + told(node.name, indent + "   ")
    if isinstance(node, ast.AnnAssign) and not node.target.id.startswith("_"):
        return [f"{indent}.. py:attribute:: {node.target.id}", f"{indent}   :type: {ast.unparse(node.annotation)}", ""]
    return []


def symbol(node, module, package):
    """A function or a class of a module."""
    if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
        return [f".. py:function:: {node.name}{signature(node)}", ""] + package.of(module, node.name, "   ")
    if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
        begin = next((n for n in node.body if isinstance(n, ast.FunctionDef) and n.name == "__init__"), None)
        kind = "exception" if any(ast.unparse(b).endswith("Error") for b in node.bases) or node.name == "WorldMismatch" else "class"
        head = f".. py:{kind}:: {node.name}{signature(begin).split(' -> ')[0] if begin else ''}"

        def told(name, indent):
            return package.of(module, f"{node.name}.{name}", indent)

        body = [line for n in node.body if not getattr(n, "name", "").startswith("__") for line in member(n, "   ", told)]
        beginning = told("__init__", "   ") if begin else []
        return [head, "", *package.of(module, node.name, "   "), *beginning, *body]
    return []


def page(root, folder):
    """@param folder where the package is that was built; None: its words are left out"""
    package = Words(folder)
    public = ast.parse((root / "python/ortung/__init__.pyi").read_text(encoding="utf-8")).body[-1].value
    public = {name.value for name in public.elts}
    told = {"__version__"}
    lines = ["Python API", "==========", "",
             "All names of the package ``ortung``, with the signatures that type checkers read. What they are for is in",
             ":doc:`../docs/python` (containers, robots, tables, localization) and :doc:`../docs/learning` (environments).", ""]
    for module, file, title in MODULES:
        tree = ast.parse((root / "python/ortung" / file).read_text(encoding="utf-8"))
        lines += [title, "-" * len(title), "", f".. py:currentmodule:: {module}", ""]
        for node in tree.body:
            if module != "ortung" or getattr(node, "name", "") in public:
                lines += symbol(node, module, package)
                told.add(getattr(node, "name", ""))
    if public - told:
        raise sources.SiteError("no stub has the public names " + ", ".join(sorted(public - told)))
    if package.missing:
        raise sources.SiteError("the Python package says nothing of " + ", ".join(package.missing))
    return "\n".join(lines) + "\n"
