"""Ortung: robots that localize themselves, and environments in which they learn to play.

Readings and their probabilities: SensorContainer, Robot, Localization, Tables, readings(), shipped_file().
Environments: make(), make_vec(), parallel_env(), Batch; see docs/learning.md. Only they need the libraries
of the simulator, which are loaded with the first environment.
Errors of files and options (ConfigError, TableError, PluginError) name file, line and key.
"""
from . import _base
from ._core import (
    ConfigError,
    FieldRegion,
    Localization,
    PluginError,
    PoseEstimate,
    Readings,
    Robot,
    SensorContainer,
    TableError,
    Tables,
    WorldMismatch,
    __version__,
    readings,
    shipped_file,
)
from .single_agent import Env, VectorEnv, make, make_vec, register
from .multi_agent import ParallelEnv, parallel_env

_OF_LEARNING = ("Autoreset", "Batch", "blocking", "environments", "heuristic")

__all__ = [
    "Autoreset", "Batch", "ConfigError", "Env", "FieldRegion", "Localization", "ParallelEnv",
    "PluginError", "PoseEstimate", "Readings", "Robot", "SensorContainer", "TableError", "Tables",
    "VectorEnv", "WorldMismatch", "__version__", "blocking", "environments", "heuristic", "make",
    "make_vec", "parallel_env", "readings", "register", "shipped_file",
]


def __getattr__(name):
    if name in _OF_LEARNING:
        return getattr(_base.learning(), name)
    raise AttributeError(f"module 'ortung' has no attribute {name!r}")


def __dir__():
    return sorted({*globals(), *__all__})


try:
    register()  # Gymnasium finds environments by their ids once this package is imported
except ImportError:
    pass  # without the simulator's libraries there are no environments
