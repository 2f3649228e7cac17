#!/usr/bin/env python3
"""promises_test.py PROGRAM PROJECT [--write]  whether what a release promised still holds (STABILITY.md).

tests/data/promises has a folder for each minor version: files of maps/ as they were with what `ortung check` said of
them, the keys of files, the commands with their options, and the stubs of the Python package. All of it must be there
still; more may be. --write makes the folder of the present minor version anew, which is right before its release alone.
"""
import ast
import itertools
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, PROJECT = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
IS_WRITTEN = "--write" in sys.argv
del sys.argv[1:]
PROMISES = PROJECT / "tests" / "data" / "promises"
KINDS = ("fields", "robots", "scenes", "rules")


def ortung(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout, done.stderr


def commands(path=()):
    """{command: its options}, with those of commands below commands."""
    code, text, error = ortung(*path, "--help")
    assert code == 0, error
    found = {" ".join(path): sorted(set(re.findall(r"^  (?:-\w,)?(--[a-z][\w-]*)", text, re.MULTILINE)))}
    has_commands = re.search(r"^Usage: .* SUBCOMMAND$", text, re.MULTILINE)
    listed = text.split("\nExample:")[0]
    for name in re.findall(r"^  ([a-z][\w-]*) ", listed, re.MULTILINE) if has_commands else []:
        found.update(commands((*path, name)))
    return found


def plugins(kind):
    return sorted(set(re.findall(rf"^  {kind} +(\w+)$", ortung("plugins")[1], re.MULTILINE)))


ROBOT = '[robot]\nradius_m = 0.2\n[[sensor]]\nplugin = "odometry"\n'
BOX = "center_m = [0, 0]\nsize_m = [1, 1]\n"
WORLD = f"[world]\nname = 'promises'\n[[rectangle]]\n{BOX}"
ZZZ = "zzz = 1\n"  # a key that nobody knows, so that the program says which it does
# Keys without which plugins do not get as far as looking for those that they do not know.
NEEDED = {
    "camera": 'camera = { size_px = [64, 48], focal_px = [40, 40] }\n',
    "lrf_cylinders": 'reads = "*/LRF/*"\nradius_m = 0.1\n',
    "neural": f'network_file = "{PROJECT / "tests" / "data" / "network1.json"}"\n',
}


def questions(scene_world, robot):
    """{section: a file whose error says which keys the section has}."""
    scene = f'[scene]\nworld = "{scene_world}"\n'
    player = f'[[robot]]\nfile = "{robot}"\nname = "bert"\nstart = {{ x_m = 0, y_m = 0, theta_deg = 0 }}\n'
    asked = {
        "robot": f'[robot]\nradius_m = 0.2\n{ZZZ}[[sensor]]\nplugin = "odometry"\n',
        "robot mcl": ROBOT + f"[mcl]\n{ZZZ}",
        "robot devices": ROBOT + f"[devices]\n{ZZZ}",
        "robot body": ROBOT + f'[[body]]\nshape = "rectangle"\n{BOX}{ZZZ}',
        "robot manipulator": ROBOT + f'[[manipulator]]\nname = "kicker"\n{ZZZ}[[manipulator.state]]\nname = "in"\n',
        "robot manipulator state": ROBOT + f'[[manipulator]]\nname = "kicker"\n[[manipulator.state]]\nname = "in"\n{ZZZ}',
        "world": WORLD.replace("\n[[", f"\n{ZZZ}[["),
        "world physics": WORLD + f"[physics]\n{ZZZ}",
        "world rectangle": WORLD + ZZZ,
        "world ellipse": WORLD + f"[[ellipse]]\n{BOX}{ZZZ}",
        "world triangle": WORLD + f"[[triangle]]\ncorners_m = [0, 0, 1, 0, 0, 1]\n{ZZZ}",
        "world landmark": WORLD + f'[[landmark]]\nkind = "post"\nidentity = 1\nposition_m = [0, 0]\n{ZZZ}',
        "world grid": WORLD + f'[[grid]]\nmap = "hall.yaml"\n{ZZZ}',
        "scene": scene + ZZZ + player,
        "scene robot": scene + player + ZZZ,
        "scene player": scene + f'[[player]]\nplugin = "wander"\nrobot = "{robot}"\nname = "anna"\n{ZZZ}',
    }
    for plugin in plugins("MotionModel"):
        asked[f"robot motion {plugin}"] = ROBOT + f'[motion]\nplugin = "{plugin}"\n{NEEDED.get(plugin, "")}{ZZZ}'
    for plugin in plugins("Drive"):
        asked[f"robot drive {plugin}"] = ROBOT + f'[drive]\nplugin = "{plugin}"\n{NEEDED.get(plugin, "")}{ZZZ}'
    for plugin in plugins("SensorData"):
        asked[f"robot sensor {plugin}"] = f'[robot]\nradius_m = 0.2\n[[sensor]]\nplugin = "{plugin}"\n{NEEDED.get(plugin, "")}{ZZZ}'
    return asked


def known_keys(text):
    found = re.search(r"zzz is not known here; known are ([\w, ]+)", text)
    return found[1].strip().split(", ") if found else None


def keys():
    """{section: its keys}, of all kinds of files that people write."""
    found, silent = {}, {}
    with tempfile.TemporaryDirectory(prefix="ortung-promises-") as folder:
        file = pathlib.Path(folder, "asked.toml")
        pathlib.Path(folder, "hall.yaml").write_text("image: hall.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n"
                                                     "occupied_thresh: 0.65\nfree_thresh: 0.2\n")
        pathlib.Path(folder, "hall.pgm").write_bytes(b"P5 4 4 255\n" + bytes([254] * 15 + [0]))
        maps = PROJECT / "maps"
        for section, text in questions(maps / "fields" / "arena.toml", maps / "robots" / "pioneer.toml").items():
            file.write_text(text)
            said = ortung("check", file)[2]
            found[section] = known_keys(said)
            if found[section] is None:
                silent[section] = said.strip()
        rules = (maps / "rules" / "f2000.toml").read_text()
        for section in re.findall(r"^\[(\w+)\]", rules, re.MULTILINE):
            file.write_text(rules.replace(f"[{section}]\n", f"[{section}]\n{ZZZ}"))
            said = ortung(*play_with(file))[2]
            found[f"rules {section}"] = known_keys(said)
            if found[f"rules {section}"] is None:
                silent[f"rules {section}"] = said.strip()
    return {section: those for section, those in found.items() if those}, silent


def play_with(rules):
    return ("sim", PROJECT / "maps" / "fields" / "f2000.toml", "--referee", f"soccer:rules={rules}",
            "--duration", "0.1", "--free-run")


def what_check_says(folder):
    """{file: what `ortung check` says of it}, without the folder's name and what is for people: a feature's and a
    drive's help."""
    said = {}
    for kind in ("fields", "robots", "scenes"):
        for file in sorted((folder / kind).glob("*.toml")):
            code, text, error = ortung("check", file, *["--wire"] * (kind == "robots"))
            text = (text if code == 0 else error).replace(str(folder) + "/", "")
            text = re.sub(r"^(  \w[^/ ]*/[^/ ]+/[^/ ]+) +(localizes; )?.*$", r"\1 \2", text, flags=re.MULTILINE)
            said[f"{kind}/{file.name}"] = re.sub(r"^(  drive '\w+'), commands .*; ", r"\1; ", text, flags=re.MULTILINE)
    return said


def functions_of_stub(file):
    """{name: [(argument, whether it may be left out)]}, {name: None} of what takes none."""
    found = {}

    def walk(nodes, where):
        for node in nodes:
            if isinstance(node, ast.ClassDef):
                found[where + node.name] = None
                walk(node.body, where + node.name + ".")
            elif isinstance(node, ast.FunctionDef):
                places = node.args.posonlyargs + node.args.args
                first = len(places) - len(node.args.defaults)
                found[where + node.name] = ([(one.arg, i >= first) for i, one in enumerate(places)],
                                            [(one.arg, default is not None) for one, default
                                             in zip(node.args.kwonlyargs, node.args.kw_defaults)])
            elif isinstance(node, ast.AnnAssign):
                found[where + node.target.id] = None
            elif isinstance(node, ast.ImportFrom):
                for one in node.names:
                    if one.asname:
                        found[where + one.asname] = None

    walk(ast.parse(file.read_text()).body, "")
    return {name: one for name, one in found.items() if not re.search(r"(^|\.)_[a-zA-Z]", name)}


def calls_that_break(old, new):
    """Of two functions of stubs: why a call that was right may be wrong now, or None."""
    if old is None or new is None:
        return None if old == new else "is of another kind"
    (places, named), (new_places, new_named) = old, new
    if [one for one, _ in new_places[:len(places)]] != [one for one, _ in places]:
        return "has other arguments"
    all_new = dict(new_places + new_named)
    for one, is_optional in places + named:
        if one not in all_new or is_optional and not all_new[one]:
            return f"has no optional {one}" if is_optional else f"has no {one}"
    for one, is_optional in new_places[len(places):] + new_named:
        if not is_optional and one not in dict(named):
            return f"needs {one}"
    return None


def lacking(old, new):
    """What of {name: [...]} is not there any more."""
    return [f"{name}: {one}" for name in old for one in (old[name] if name in new else ["all of it"])
            if one not in new.get(name, ())]


class Promises(unittest.TestCase):
    maxDiff = None
    folders = sorted(PROMISES.glob("*.*"))

    @classmethod
    def setUpClass(cls):
        cls.commands = commands()
        cls.keys, cls.silent = keys()

    def each(self):
        self.assertGreater(len(self.folders), 0)
        for folder in self.folders:
            with self.subTest(folder.name):
                yield folder

    def test_every_section_was_asked(self):
        self.assertEqual(self.silent, {})

    def test_commands_have_their_options(self):
        for folder in self.each():
            self.assertEqual(lacking(json.loads((folder / "commands.json").read_text()), self.commands), [])

    def test_files_have_their_keys(self):
        for folder in self.each():
            self.assertEqual(lacking(json.loads((folder / "keys.json").read_text()), self.keys), [])

    def test_files_are_read_as_they_were(self):
        for folder in self.each():
            self.assertEqual(what_check_says(folder), json.loads((folder / "check.json").read_text()))

    def test_games_have_their_rules(self):
        for folder in self.each():
            for rules in sorted((folder / "rules").glob("*.toml")):
                code, _, error = ortung(*play_with(rules))
                self.assertEqual((code, error), (0, ""), rules)

    def test_python_has_its_names_and_arguments(self):
        for folder in self.each():
            for stub in sorted((folder / "python").glob("*.pyi")):
                old = functions_of_stub(stub)
                new = functions_of_stub(PROJECT / "python" / "ortung" / stub.name)
                self.assertGreater(len(old), 5)
                self.assertEqual([name for name in old if name not in new], [], stub.name)
                for name in old:
                    self.assertIsNone(calls_that_break(old[name], new[name]), f"{stub.name}: {name}")


class Comparisons(unittest.TestCase):
    """That the comparisons above find what they are for."""

    def test_of_lists(self):
        self.assertEqual(lacking({"a": ["x", "y"], "b": ["z"]}, {"a": ["y", "w"]}), ["a: x", "b: all of it"])

    def test_of_calls(self):
        with tempfile.TemporaryDirectory(prefix="ortung-promises-") as folder:
            def function(arguments):
                file = pathlib.Path(folder, "x.pyi")
                file.write_text(f"def f({arguments}) -> None: ...\n")
                return functions_of_stub(file)["f"]
            old = function("a, b=1, *, c=2")
            for same in ("a, b=1, *, c=2", "a, b=1, d=3, *, c=2", "a, b=1, c=2", "a=1, b=1, *, c=2, d=1"):
                self.assertIsNone(calls_that_break(old, function(same)), same)
            for other in ("a, *, c=2", "b=1, a=2, *, c=2", "a, b, *, c=2", "a, b=1", "a, b=1, *, c", "a, b=1, *, c=2, d",
                          "a, x=1, *, c=2"):
                self.assertIsNotNone(calls_that_break(old, function(other)), other)


def write(folder):
    shutil.rmtree(folder, ignore_errors=True)
    for kind in KINDS:
        (folder / kind).mkdir(parents=True)
        for file in (PROJECT / "maps" / kind).glob("*.toml"):
            shutil.copy(file, folder / kind)
    (folder / "python").mkdir()
    for stub in (PROJECT / "python" / "ortung").glob("*.pyi"):
        shutil.copy(stub, folder / "python")
    found, silent = keys()
    if silent:
        sys.exit("\n".join(itertools.chain(*silent.items())))
    for name, content in (("commands", commands()), ("keys", found), ("check", what_check_says(folder))):
        (folder / f"{name}.json").write_text(json.dumps(content, indent=0, sort_keys=True, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    if IS_WRITTEN:
        version = re.search(r"project\(ortung VERSION (\d+\.\d+)", (PROJECT / "CMakeLists.txt").read_text())[1]
        write(PROMISES / version)
    else:
        unittest.main()
