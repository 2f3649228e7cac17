"""Ortung: robots that localize themselves, and environments in which they learn to play.

Environments: make(), make_vec(), parallel_env(), Batch; see docs/learning.md.
For notebooks: Robot, Localization, Tables, readings().
Errors of files and options (ConfigError, TableError, PluginError) name file, line and key.
"""
from ._core import (
    Autoreset,
    Batch,
    ConfigError,
    Localization,
    PluginError,
    PoseEstimate,
    Readings,
    Robot,
    SensorContainer,
    TableError,
    Tables,
    WorldMismatch,
    blocking,
    environments,
    heuristic,
    readings,
)
from .single_agent import Env, VectorEnv, make, make_vec, register
from .multi_agent import ParallelEnv, parallel_env

__all__ = [
    "Autoreset", "Batch", "ConfigError", "Env", "Localization", "ParallelEnv", "PluginError",
    "PoseEstimate", "Readings", "Robot", "SensorContainer", "TableError", "Tables", "VectorEnv",
    "WorldMismatch", "blocking", "environments", "heuristic", "make", "make_vec", "parallel_env",
    "readings", "register",
]
