#!/usr/bin/env python3
"""schema_test.py ORTUNG MAPS  schemas of `ortung check --schema` accept what the program accepts, and see what it refuses."""
import json
import pathlib
import subprocess
import sys
import tomllib

try:
    import jsonschema
except ImportError:
    print("skipped: python3-jsonschema is not installed")
    sys.exit(77)

PROGRAM, MAPS = sys.argv[1], pathlib.Path(sys.argv[2])


def schema(kind):
    text = subprocess.run([PROGRAM, "check", "--schema", kind], capture_output=True, text=True, check=True).stdout
    made = json.loads(text)
    jsonschema.Draft7Validator.check_schema(made)
    return jsonschema.Draft7Validator(made)


def errors(validator, content):
    return [f"{list(e.absolute_path)}: {e.message[:200]}" for e in validator.iter_errors(content)]


ROBOT, WORLD, SCENE = (schema(kind) for kind in ("robot", "world", "scene"))
for validator, folder in ((ROBOT, "robots"), (WORLD, "fields"), (SCENE, "scenes")):
    files = sorted((MAPS / folder).glob("*.toml"))
    assert len(files) > 2, folder
    for file in files:
        wrong = errors(validator, tomllib.loads(file.read_text()))
        assert not wrong, f"{file}: {wrong}"

FINE = {"robot": {"name": "r"}, "sensor": [{"plugin": "lrf", "beams": 90}]}
assert not errors(ROBOT, FINE)
WALL = {"center_m": [0, 0], "size_m": [4, 0.1]}
for validator, content, what in (
    (ROBOT, {**FINE, "robto": {}}, "a section that nobody knows"),
    (ROBOT, {**FINE, "robot": {"radius_m": "wide"}}, "a text for a number"),
    (ROBOT, {"sensor": [{"plugin": "lrf", "baems": 90}]}, "a misspelt key of a plugin"),
    (ROBOT, {"sensor": [{"plugin": "lrf", "beams": 0}]}, "a number out of its bounds"),
    (ROBOT, {"sensor": [{"plugin": "lfr"}]}, "a plugin that is not there"),
    (ROBOT, {"sensor": [{"plugin": "sonar", "beams": 90}]}, "a key of another plugin"),
    (ROBOT, {**FINE, "drive": {"max_sped_m_s": 1}}, "a misspelt key of the default drive"),
    (ROBOT, {**FINE, "mcl": {"particles": 1.5}}, "half a sample"),
    (WORLD, {"rectangle": [{**WALL, "angel_deg": 3}]}, "a misspelt key of a shape"),
    (WORLD, {"rectangle": [{"center_m": [0, 0]}]}, "a shape without a size"),
    (WORLD, {"rectangle": [{**WALL, "size_m": [1]}]}, "one number of two"),
    (SCENE, {"scene": {}, "robot": [{"name": "a"}]}, "a scene without a world"),
):
    assert errors(validator, content), f"{what} was not seen"
print("ok")
