"""The page of the Python package's functions and classes, of its stubs (python/tests/test_stubs.py compares these with what
is compiled), in reStructuredText."""
import ast

MODULES = (("ortung", "_core", "Robots, tables, records and localization"),
           ("ortung", "_learning", "Environments in batches"),
           ("ortung", "single_agent", "Gymnasium's interface"),
           ("ortung", "multi_agent", "PettingZoo's interface"))


def signature(function):
    arguments = ast.unparse(function.args)
    names = arguments.removeprefix("self").removeprefix("cls").removeprefix(", ")
    returns = f" -> {ast.unparse(function.returns)}" if function.returns else ""
    return f"({names}){returns}"


def documented(node, indent):
    text = ast.get_docstring(node)
    return [indent + line if line else "" for line in text.splitlines()] + [""] if text else []


def member(node, indent):
    if isinstance(node, ast.FunctionDef):
        decorators = [ast.unparse(d) for d in node.decorator_list]
        if "property" in decorators:
            lines = [f"{indent}.. py:property:: {node.name}", f"{indent}   :type: {ast.unparse(node.returns)}"]
        elif any(d.endswith(".setter") for d in decorators):
            return []
        else:
            lines = [f"{indent}.. py:method:: {node.name}{signature(node)}"]
            lines += [f"{indent}   :{d}:" for d in decorators if d in ("staticmethod", "classmethod")]
        return lines + [""] + documented(node, indent + "   ")
    if isinstance(node, ast.AnnAssign) and not node.target.id.startswith("_"):
        return [f"{indent}.. py:attribute:: {node.target.id}", f"{indent}   :type: {ast.unparse(node.annotation)}", ""]
    return []


def symbol(node):
    if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
        return [f".. py:function:: {node.name}{signature(node)}", ""] + documented(node, "   ")
    if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
        begin = next((n for n in node.body if isinstance(n, ast.FunctionDef) and n.name == "__init__"), None)
        kind = "exception" if any(ast.unparse(b).endswith("Error") for b in node.bases) or node.name == "WorldMismatch" else "class"
        head = f".. py:{kind}:: {node.name}{signature(begin).split(' -> ')[0] if begin else ''}"
        body = [line for n in node.body if not getattr(n, "name", "").startswith("__") for line in member(n, "   ")]
        return [head, "", *documented(node, "   "), *body]
    return []


def page(root):
    lines = ["Python API", "==========", "",
             "The names of the package ``ortung``, from the stubs that type checkers read. What they are for is in",
             ":doc:`../docs/python` (containers, robots, tables, localization) and :doc:`../docs/learning` (environments).", ""]
    lines += [".. py:currentmodule:: ortung", ""]
    for _, module, title in MODULES:
        tree = ast.parse((root / "python/ortung" / (module + ".pyi")).read_text(encoding="utf-8"))
        lines += [title, "-" * len(title), ""]
        for node in tree.body:
            lines += symbol(node)
    return "\n".join(lines) + "\n"
