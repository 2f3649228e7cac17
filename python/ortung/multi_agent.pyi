import os
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt
from pettingzoo import ParallelEnv as _ParallelEnv  # type: ignore[import]

class ParallelEnv(_ParallelEnv[str, npt.NDArray[np.float32], npt.ArrayLike]):  # type: ignore[misc]
    id: str
    metadata: Dict[str, Any]
    agents: List[str]
    possible_agents: List[str]
    def __init__(
        self,
        id: str = "keeper-vs-striker-v0",
        *,
        render_mode: None = None,
        record: Union[str, "os.PathLike[str]", None] = None,
        **options: Any,
    ) -> None: ...
    def observation_space(self, agent: str) -> Any: ...
    def action_space(self, agent: str) -> Any: ...
    def reset(
        self, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None
    ) -> Tuple[Dict[str, npt.NDArray[np.float32]], Dict[str, Dict[str, Any]]]: ...
    def step(
        self, actions: Dict[str, npt.ArrayLike]
    ) -> Tuple[
        Dict[str, npt.NDArray[np.float32]],
        Dict[str, float],
        Dict[str, bool],
        Dict[str, bool],
        Dict[str, Dict[str, Any]],
    ]: ...
    def state(self) -> npt.NDArray[np.float32]: ...
    def render(self) -> None: ...
    def close(self) -> None: ...

def parallel_env(id: str = "keeper-vs-striker-v0", **options: Any) -> ParallelEnv: ...
