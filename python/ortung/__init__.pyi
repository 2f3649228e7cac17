from . import draw as draw
from ._core import (
    ConfigError as ConfigError,
    EvaluatedRun as EvaluatedRun,
    FieldRegion as FieldRegion,
    Localization as Localization,
    PluginError as PluginError,
    PoseEstimate as PoseEstimate,
    Readings as Readings,
    RecordWriter as RecordWriter,
    Robot as Robot,
    SensorContainer as SensorContainer,
    TableError as TableError,
    Tables as Tables,
    WorldMismatch as WorldMismatch,
    __version__ as __version__,
    evaluate as evaluate,
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
from ._sim import (
    SimulatedRobot as SimulatedRobot,
    Simulation as Simulation,
    World as World,
    learn as learn,
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
    "Autoreset", "Batch", "ConfigError", "Env", "EvaluatedRun", "FieldRegion", "Localization", "ParallelEnv",
    "PluginError", "PoseEstimate", "Readings", "RecordWriter", "Robot", "SensorContainer", "SimulatedRobot",
    "Simulation", "TableError", "Tables", "VectorEnv", "World", "WorldMismatch", "__version__", "blocking",
    "environments", "evaluate", "heuristic", "learn", "make", "make_vec", "parallel_env", "readings", "register",
    "shipped_file",
]
