"""test_wheel.py PROJECT BUILD VERSION  a wheel of what is built works by itself: in an environment of its own, wherever
it lies, and without the simulator's libraries until an environment is asked for."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import venv

PROJECT, BUILD, VERSION = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
del sys.argv[1:]
for needed, package in (("numpy", "python3-numpy"), ("pip", "python3-pip"), ("wheel", "python3-wheel"),
                        ("build", "python3-build")):
    if subprocess.run([sys.executable, "-c", f"import {needed}"], cwd="/", capture_output=True).returncode != 0:
        print(f"test_wheel.py: Skipped\n{needed} is not there ({package})")
        sys.exit(77)

# Prints the libraries of Ortung and of the simulator that a program has loaded.
LOADED = ("print(*sorted({line.split()[-1] for line in open('/proc/self/maps') "
          "if '.so' in line and any(one in line for one in ('ortung', 'embree', 'box2d'))}), sep='\\n')")
ENVIRONMENT = {key: value for key, value in os.environ.items()
               if key not in ("PYTHONPATH", "LD_LIBRARY_PATH", "ORTUNG_PLUGIN_PATH", "ORTUNG_MAPS_PATH")}
OFFLINE = {**ENVIRONMENT, "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PIP_NO_CACHE_DIR": "1"}


def run(*command, cwd, **variables):
    """Returns the command's output. Raises AssertionError with all its output if it fails."""
    done = subprocess.run(list(map(str, command)), cwd=cwd, env={**OFFLINE, **variables}, capture_output=True,
                          text=True)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}\n{done.stderr}")
    return done.stdout


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="ortung-wheel-")
        cls.folder = pathlib.Path(cls.temporary.name)
        run(sys.executable, "-B", "-m", "pip", "wheel", PROJECT, "--no-build-isolation", "--no-deps",
            "--config-settings", f"build-dir={BUILD}", "-w", cls.folder / "dist", cwd=cls.folder, PYTHONDONTWRITEBYTECODE="1")
        cls.wheel, = (cls.folder / "dist").glob("*.whl")
        venv.create(cls.folder / "robot", system_site_packages=True, symlinks=True)  # numpy and pip are the system's
        cls.python = cls.folder / "robot" / "bin" / "python"
        run(cls.python, "-m", "pip", "install", "--no-deps", "--no-index", cls.wheel, cwd=cls.folder)
        cls.package = pathlib.Path(cls.in_wheel("import ortung; print(ortung.__file__)").strip()).parent

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def in_wheel(cls, program, python=None, **variables):
        return run(python or cls.python, "-c", program, cwd=cls.folder, **variables)

    def test_is_named_after_version_and_interpreter(self):
        tag = f"cp{sys.version_info[0]}{sys.version_info[1]}"
        self.assertRegex(self.wheel.name, rf"^ortung-{re.escape(VERSION)}-{tag}-{tag}-linux_\w+\.whl$")
        self.assertEqual(self.in_wheel("import ortung; print(ortung.__version__)").strip(), VERSION)
        self.assertTrue(self.package.is_relative_to(self.folder))
        shown = run(self.python, "-m", "pip", "show", "-f", "ortung", cwd=self.folder)
        for part in (f"Version: {VERSION}", "Requires: numpy", "ortung/_core.pyi", "ortung/py.typed"):
            self.assertIn(part, shown)
        self.assertEqual([one for one in self.package.rglob("*") if one.is_symlink()], [])

    def test_the_front_end_of_packaging_makes_the_same(self):
        run(sys.executable, "-B", "-m", "build", "--wheel", "--no-isolation", f"-Cbuild-dir={BUILD}",
            "--outdir", self.folder / "again", PROJECT, cwd=self.folder, PYTHONDONTWRITEBYTECODE="1")
        self.assertEqual((self.folder / "again" / self.wheel.name).stat().st_size, self.wheel.stat().st_size)

    def test_programs_of_the_page_need_nothing_else(self):
        programs = re.findall(r"```python\n(.*?)```", (PROJECT / "docs" / "python.md").read_text(), re.DOTALL)
        shortest = next(one for one in programs if "A corridor of 4 m" in one)
        self.assertEqual(self.in_wheel(shortest), "p at x = 2.5 m: 1.000, at x = 1 m: 0.050\n")
        whole = programs[0].replace('"maps/fields/arena.toml"', 'ortung.shipped_file("fields", "arena.toml")')
        whole = whole.replace('"maps/robots/pioneer.toml"', 'ortung.shipped_file("robots", "pioneer.toml")')
        self.assertRegex(self.in_wheel(whole), r"^EvaluatedRun\('record:run.rec', 14.9 s, position_rmse_m=0\.0")

    def test_robots_need_no_simulator(self):
        program = ("import ortung\n"
                   "print(ortung.Robot(ortung.shipped_file('robots', 'pioneer.toml')).container.features)\n" + LOADED)
        features, *files = self.in_wheel(program).splitlines()
        self.assertIn("/LRF/", features)
        self.assertTrue(any("/plugins/ortung_lrf_data" in one for one in files))
        for one in files:
            self.assertTrue(one.startswith(str(self.package)), one)
            self.assertNotRegex(one, r"embree|box2d|libortung_sim\.so")

    def test_environments_play(self):
        program = ("import ortung\n"
                   "env = ortung.make('localize-and-score-v0')\n"
                   "print(*(float(x).hex() for x in env.reset(seed=3)[0]))\n"
                   "print(env.step([1, 0, 0])[1:4])\n" + LOADED)
        first, step, *files = self.in_wheel(program).splitlines()
        self.assertEqual(step, "(0.0, False, False)")
        for one in files:
            if "ortung" in one:
                self.assertTrue(one.startswith(str(self.package)), one)
        built = self.in_wheel(program, sys.executable, PYTHONPATH=str(BUILD / "lib" / "python")).splitlines()
        self.assertEqual(built[0], first)

    def test_works_wherever_it_is_moved(self):
        there = self.folder / "moved here"
        shutil.copytree(self.package, there / "ortung")
        program = ("import ortung\n"
                   "print(ortung.Robot(ortung.shipped_file('robots', 'pioneer.toml')).name)\n"
                   "ortung.make('goalkeeper-v0').reset(seed=1)\n" + LOADED)
        name, *files = self.in_wheel(program, sys.executable, PYTHONPATH=str(there)).splitlines()
        self.assertTrue(name)
        for one in files:
            self.assertNotIn(str(self.package), one)

    def test_says_which_packages_environments_lack(self):
        there = self.folder / "bare"
        shutil.copytree(self.package, there / "ortung")
        for library in (there / "ortung" / "lib").glob("libortung_sim.so*"):
            library.unlink()  # as if a library were not installed
        program = ("import ortung\n"
                   "print(len(ortung.Robot(ortung.shipped_file('robots', 'pioneer.toml')).container.features))\n"
                   "try:\n"
                   "    ortung.make('goalkeeper-v0')\n"
                   "except ImportError as error:\n"
                   "    print(error)\n")
        features, error = self.in_wheel(program, sys.executable, PYTHONPATH=str(there)).splitlines()
        self.assertGreater(int(features), 1)
        for part in ("libembree3-3", "libbox2d2", "libortung_sim.so"):
            self.assertIn(part, error)

    def test_a_build_for_another_interpreter_is_refused(self):
        other = self.folder / "other build"
        other.mkdir()
        (other / "CMakeCache.txt").write_text("CMAKE_PROJECT_VERSION:STATIC=1.2.3\n")
        (other / "cmake_install.cmake").write_text("")
        with self.assertRaisesRegex(AssertionError, r"other build has no ortung\._core for"):
            run(sys.executable, "-B", "-m", "build", "--wheel", "--no-isolation", f"-Cbuild-dir={other}",
                "--outdir", self.folder / "none", PROJECT, cwd=self.folder, PYTHONDONTWRITEBYTECODE="1")
        self.assertFalse((self.folder / "none").exists() and list((self.folder / "none").glob("*.whl")))


if __name__ == "__main__":
    unittest.main()
