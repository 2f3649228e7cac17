from ._core import (
    ConfigError as ConfigError,
    FieldRegion as FieldRegion,
    Localization as Localization,
    PluginError as PluginError,
    PoseEstimate as PoseEstimate,
    Readings as Readings,
    Robot as Robot,
    SensorContainer as SensorContainer,
    TableError as TableError,
    Tables as Tables,
    WorldMismatch as WorldMismatch,
    __version__ as __version__,
    readings as readings,
    shipped_file as shipped_file,
)
from ._learning import (
    Autoreset as Autoreset,
    Batch as Batch,
    blocking as blocking,
    environments as environments,
    heuristic as heuristic,
)
from .multi_agent import ParallelEnv as ParallelEnv, parallel_env as parallel_env
from .single_agent import (
    Env as Env,
    VectorEnv as VectorEnv,
    make as make,
    make_vec as make_vec,
    register as register,
)

__all__ = [
    "Autoreset", "Batch", "ConfigError", "Env", "FieldRegion", "Localization", "ParallelEnv",
    "PluginError", "PoseEstimate", "Readings", "Robot", "SensorContainer", "TableError", "Tables",
    "VectorEnv", "WorldMismatch", "__version__", "blocking", "environments", "heuristic", "make",
    "make_vec", "parallel_env", "readings", "register", "shipped_file",
]
