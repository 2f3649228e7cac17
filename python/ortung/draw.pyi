import os
from typing import Any, List, Optional, Sequence, Union

from ._core import EvaluatedRun, Localization, Robot
from ._sim import World

__all__: List[str]

def world(world: Union[World, str, "os.PathLike[str]"], axes: Any = None) -> Any: ...
def robot(
    robot: Robot, pose: Sequence[float] = (0.0, 0.0, 0.0), axes: Any = None, reach: Optional[float] = None
) -> Any: ...
def map(
    localization: Localization,
    features: Optional[Union[str, Sequence[str]]] = None,
    *,
    log: bool = False,
    headings: Optional[Sequence[float]] = None,
    pose: Optional[Sequence[float]] = None,
    axes: Any = None,
) -> Any: ...
def run(
    run: EvaluatedRun, world: Union[World, str, "os.PathLike[str]", None] = None, axes: Any = None
) -> Any: ...
