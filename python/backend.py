"""Builds the wheel of the Python package (PEP 517):

    /usr/bin/pip wheel . --no-build-isolation --no-deps
    /usr/bin/python3 -m build --wheel --no-isolation

It compiles in build/wheel by CMake. Settings (-C of build, --config-settings of pip): build-dir=DIR uses the build in
DIR, which may have any options; cmake-args=ARGUMENTS is passed to CMake.
"""
import os
import pathlib
import re
import shlex
import subprocess
import sys
import sysconfig
import tempfile

from wheel.wheelfile import WheelFile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TAG = f"cp{sys.version_info[0]}{sys.version_info[1]}"
PLATFORM = re.sub("[^a-zA-Z0-9]", "_", sysconfig.get_platform())


def _cmake(*arguments):
    print("+", shlex.join(["cmake", *map(str, arguments)]), flush=True)
    subprocess.run(["cmake", *arguments], check=True)


def _compile(settings):
    """Builds the package's targets for the interpreter that runs this, and returns the build folder."""
    if "build-dir" in settings:
        return pathlib.Path(settings["build-dir"]).resolve()
    folder = ROOT / "build" / "wheel"
    _cmake("-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DORTUNG_PYTHON=ON",
           f"-DPython_EXECUTABLE={sys.executable}", "-DORTUNG_APP=OFF", "-DORTUNG_SERVER=OFF", "-DORTUNG_MRPT=OFF",
           "-DORTUNG_TESTS=OFF", *shlex.split(settings.get("cmake-args", "")))
    _cmake("--build", folder, "--target", "ortung_wheel")
    return folder


def _version(build):
    cache = (build / "CMakeCache.txt").read_text()
    return re.search(r"^CMAKE_PROJECT_VERSION:\w+=(.+)$", cache, re.MULTILINE)[1]


def _without_links(folder):
    """Renames each library to the name by which others load it, since a wheel has no links."""
    for link in [path for path in folder.rglob("*") if path.is_symlink()]:
        target = link.resolve()
        link.unlink()
        target.rename(link)


def _write_metadata(folder, version):
    folder.mkdir()
    (folder / "METADATA").write_text(f"""Metadata-Version: 2.1
Name: ortung
Version: {version}
Summary: Robots that localize themselves with whatever sensors they have, and environments to learn in
License: BSD-3-Clause
Requires-Python: >=3.9
Requires-Dist: numpy
Description-Content-Type: text/markdown

""" + (ROOT / "README.md").read_text())
    (folder / "WHEEL").write_text("Wheel-Version: 1.0\nGenerator: ortung\nRoot-Is-Purelib: false\n"
                                  f"Tag: {TAG}-{TAG}-{PLATFORM}\n")
    (folder / "LICENSE").write_bytes((ROOT / "LICENSE").read_bytes())


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build = _compile(config_settings or {})
    version = _version(build)
    with tempfile.TemporaryDirectory(prefix="ortung-wheel-") as name:
        stage = pathlib.Path(name)
        _cmake("--install", build, "--prefix", stage, "--component", "wheel", "--strip")
        for module in ("_core", "_learning"):
            if not (stage / "ortung" / (module + sysconfig.get_config_var("EXT_SUFFIX"))).exists():
                raise SystemExit(f"{build} has no ortung.{module} for {sys.executable}: build it with "
                                 f"-DORTUNG_PYTHON=ON -DPython_EXECUTABLE={sys.executable} and shared libraries")
        _without_links(stage)
        _write_metadata(stage / f"ortung-{version}.dist-info", version)
        wheel = f"ortung-{version}-{TAG}-{TAG}-{PLATFORM}.whl"
        with WheelFile(os.path.join(wheel_directory, wheel), "w") as file:
            file.write_files(stage)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("ortung: there is no source distribution of the Python package alone; build the wheel in the "
                     "project's folder (python3 -m build --wheel --no-isolation)")
