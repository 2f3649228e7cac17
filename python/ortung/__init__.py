"""Ortung: robots that localize themselves, and environments in which they learn to play.

The job of a robot: learn() tables in a World, localize by Localization, evaluate() against ground truth, and look
at it with ortung.draw. Readings are in a SensorContainer, from readings() of any source or a Simulation, and go into
records by RecordWriter; see docs/python.md.
Environments: make(), make_vec(), parallel_env(), Batch; see docs/learning.md.
Worlds, simulations and environments need the libraries of the simulator, which are loaded with the first of them.
Errors of files and options (ConfigError, TableError, PluginError) name file, line and key.
"""
import importlib
import importlib.util
import sys

from ._core import (
    ConfigError,
    EvaluatedRun,
    FieldRegion,
    Localization,
    PluginError,
    PoseEstimate,
    Readings,
    RecordWriter,
    Robot,
    SensorContainer,
    TableError,
    Tables,
    WorldMismatch,
    __version__,
    evaluate,
    readings,
    shipped_file,
)

# What is loaded with its first use, since it takes time or needs more libraries: names by module.
_LATER = {
    "_learning": ("Autoreset", "Batch", "blocking", "environments", "heuristic"),
    "_sim": ("SimulatedRobot", "Simulation", "World", "learn"),
    "multi_agent": ("ParallelEnv", "parallel_env"),
    "single_agent": ("Env", "VectorEnv", "make", "make_vec", "register"),
}
_MODULE_OF = {name: module for module, names in _LATER.items() for name in names}
_SUBMODULES = ("draw", "multi_agent", "single_agent", "sweep")

__all__ = [
    "Autoreset", "Batch", "ConfigError", "Env", "EvaluatedRun", "FieldRegion", "Localization", "ParallelEnv",
    "PluginError", "PoseEstimate", "Readings", "RecordWriter", "Robot", "SensorContainer", "SimulatedRobot",
    "Simulation", "TableError", "Tables", "VectorEnv", "World", "WorldMismatch", "__version__", "blocking",
    "environments", "evaluate", "heuristic", "learn", "make", "make_vec", "parallel_env", "readings", "register",
    "shipped_file",
]

# Debian 12's packages of the libraries that the simulator links. They are not part of this package.
_SIMULATOR_PACKAGES = ("libembree3-3", "libbox2d2", "libboost-iostreams1.74.0", "libpng16-16", "libyaml-cpp0.7")


def _compiled(name):
    """Returns a module that needs the simulator's libraries, without which the rest of the package works."""
    try:
        return importlib.import_module(f".{name}", __name__)
    except ImportError as error:
        from ._needs import needs
        what = {"_learning": "environments", "_sim": "worlds and simulations"}[name]
        raise ImportError(needs(what, "the libraries of the simulator", _SIMULATOR_PACKAGES, error)) from error


def __getattr__(name):
    if name in _SUBMODULES:
        return importlib.import_module(f".{name}", __name__)
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'ortung' has no attribute {name!r}")
    module = _MODULE_OF[name]
    found = _compiled(module) if module.startswith("_") else importlib.import_module(f".{module}", __name__)
    globals()[name] = getattr(found, name)  # asked for once
    return globals()[name]


def __dir__():
    return sorted({*__all__, *_SUBMODULES, *(name for name in globals() if name.startswith("__"))})


if "gymnasium" in sys.modules or importlib.util.find_spec("gymnasium") is not None:
    try:
        from .single_agent import register
        register()  # Gymnasium finds environments by their ids once this package is imported
    except ImportError:
        pass  # without the simulator's libraries there are no environments
