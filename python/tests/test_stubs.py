"""Tests that the stubs agree with the package: names, members, properties, arguments, and what these are if left out."""
import ast
import importlib
import inspect
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy  # noqa: F401, what the package needs
except ImportError:
    print("test_stubs.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

import ortung

FOLDER = pathlib.Path(ortung.__file__).parent
DUNDERS = {"__init__", "__iter__", "__len__", "__next__", "__version__"}  # that a stub has to have


def is_public(name):
    return not name.startswith("_") or name in DUNDERS


def arguments_of_text(text):
    """Reads pybind11's signature: [(name, its default as Python writes it, or None)]."""
    inside = text[text.index("(") + 1:text.rindex(") ->")]
    depth, parts = 0, [""]
    for letter in inside:
        depth += (letter in "[({<") - (letter in "])}>")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    found = [re.match(r"\s*(\w+)[^=]*(?:= (.*))?", part) for part in parts if part.strip()]
    return [(one[1], one[2] and re.sub(r"<(.*): \d+>", r"\1", one[2])) for one in found if one[1] != "self"]


def arguments_of(function):
    """Reads the signature of a function at run time."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except ValueError:  # of C++
        return arguments_of_text(function.__doc__.splitlines()[0])
    kinds = {inspect.Parameter.VAR_KEYWORD: "**", inspect.Parameter.KEYWORD_ONLY: "*"}
    if [one.name for one in parameters] == ["self", "args", "kwargs"]:  # pybind11's methods
        return arguments_of_text(function.__doc__.splitlines()[0])
    return [(kinds.get(one.kind, "") + one.name, None if one.default is one.empty else repr(one.default))
            for one in parameters if one.name != "self"]


def arguments_of_stub(node):
    places = node.args.posonlyargs + node.args.args
    defaults = [None] * (len(places) - len(node.args.defaults)) + node.args.defaults
    found = [(one.arg, default and ast.unparse(default)) for one, default in zip(places, defaults) if one.arg != "self"]
    found += [("*" + one.arg, default and ast.unparse(default))
              for one, default in zip(node.args.kwonlyargs, node.args.kw_defaults)]
    if node.args.kwarg:
        found.append(("**" + node.args.kwarg.arg, None))
    return found


def describe_stub(nodes):
    """Returns {name: definition} of the statements of a stub or of one of its classes."""
    found = {}
    for node in nodes:
        if isinstance(node, ast.ClassDef):
            found[node.name] = describe_stub(node.body)
        elif isinstance(node, ast.FunctionDef):
            is_property = any(getattr(one, "id", "") == "property" for one in node.decorator_list)
            found[node.name] = "property" if is_property else arguments_of_stub(node)
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = "value"
    return {name: one for name, one in found.items() if is_public(name)}


def describe_class(kind):
    found = {}
    for name, one in vars(kind).items():
        if not is_public(name) or name == "__init__" and isinstance(one, type(object.__init__)):
            continue  # what can't be made by hand has object's own
        if isinstance(one, property):
            found[name] = "property"
        elif callable(one):
            found[name] = arguments_of(one)
        else:
            found[name] = "value"
    return found


def describe_module(module):
    found = {}
    for name, one in vars(module).items():
        if not is_public(name) or inspect.ismodule(one):
            continue
        if getattr(one, "__module__", module.__name__) != module.__name__:
            continue  # of another module
        if inspect.isclass(one):
            found[name] = describe_class(one)
        elif callable(one):
            found[name] = arguments_of(one)
        elif name == "__version__":
            found[name] = "value"
    return found


def set_by_init(source, kind):
    """Returns the public attributes that a class written in Python sets."""
    return set(re.findall(r"self\.([a-z]\w*)\b[^=\n(]*=[^=]", source)) | set(vars(kind))


class Stubs(unittest.TestCase):
    maxDiff = None

    def test_of_what_is_compiled(self):
        for name in ("_core", "_learning", "_sim"):
            with self.subTest(name):
                module = importlib.import_module(f"ortung.{name}")
                self.assertEqual(describe_stub(ast.parse((FOLDER / f"{name}.pyi").read_text()).body),
                                 describe_module(module))

    def test_of_what_is_python(self):
        for name in ("draw", "single_agent", "multi_agent"):
            module = importlib.import_module(f"ortung.{name}")
            stub = describe_stub(ast.parse((FOLDER / f"{name}.pyi").read_text()).body)
            for one, found in describe_module(module).items():
                with self.subTest(f"{name}.{one}"):
                    if not isinstance(found, dict):
                        self.assertEqual(stub.pop(one), found)
                        continue
                    members = stub.pop(one)
                    attributes = {key for key, what in members.items() if what == "value"}
                    self.assertLessEqual(attributes, set_by_init(inspect.getsource(module), getattr(module, one)))
                    self.assertEqual({key: what for key, what in members.items() if what != "value"},
                                     {key: what for key, what in found.items() if what != "value"})
            self.assertEqual(stub, {})

    def test_of_the_package(self):
        tree = ast.parse((FOLDER / "__init__.pyi").read_text())
        names = {one.asname for node in tree.body if isinstance(node, ast.ImportFrom) and node.module
                 for one in node.names}
        self.assertEqual(sorted(names), sorted(ortung.__all__))
        for name in names:
            self.assertIsNotNone(getattr(ortung, name))
        listed = next(ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign))
        self.assertEqual(listed, ortung.__all__)
        self.assertTrue((FOLDER / "py.typed").exists())

    def test_a_type_checker_understands_them(self):
        if subprocess.run([sys.executable, "-c", "import mypy"], capture_output=True).returncode != 0:
            self.skipTest("mypy is not there (mypy)")
        with tempfile.TemporaryDirectory(prefix="ortung-stubs-") as folder:
            right, wrong = pathlib.Path(folder, "right.py"), pathlib.Path(folder, "wrong.py")
            right.write_text("import ortung\n"
                             "for one in ortung.Localization('r.toml', 't.ortung', source='record:r', seed=3):\n"
                             "    x: float = one.x\n"
                             "a, b, c, d, e = ortung.make('goalkeeper-v0').step([0.5, 0.0])\n"
                             "ortung.Robot('r.toml').container.set(1, 'a/b/c', [1])\n"
                             "run = ortung.evaluate('record:r', 'r.toml', 't.ortung', progress=lambda share: None)\n"
                             "ortung.draw.run(run, ortung.World('w.toml'))\n"
                             "ortung.Simulation('w.toml').add_robot('r.toml', start=(0, 0, 0)).drive(0.3)\n")
            wrong.write_text("import ortung\n"
                             "ortung.Localization('r.toml')\n"
                             "ortung.Robot('r.toml').container.set('1', 'a/b/c', [1])\n"
                             "ortung.Robot('r.toml').nme\n"
                             "ortung.Batch('goalkeeper-v0', number=3)\n")
            command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", folder + "/cache"]
            environment = {"MYPYPATH": str(FOLDER.parent), "PATH": "/usr/bin:/bin"}
            result = subprocess.run([*command, right], env=environment, cwd=folder, capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
            result = subprocess.run([*command, wrong], env=environment, cwd=folder, capture_output=True, text=True)
            lines = {int(line.split(":")[1]) for line in result.stdout.splitlines() if ": error:" in line}
            self.assertEqual(lines, {2, 3, 4, 5}, result.stdout)


if __name__ == "__main__":
    unittest.main()
