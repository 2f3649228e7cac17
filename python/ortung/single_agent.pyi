import os
from typing import Any, Dict, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt
from gymnasium import Env as _Env  # type: ignore[import]
from gymnasium.vector import VectorEnv as _VectorEnv  # type: ignore[import]

class Env(_Env[npt.NDArray[np.float32], npt.ArrayLike]):  # type: ignore[misc]
    id: str
    metadata: Dict[str, Any]
    def __init__(
        self,
        id: str = "goalkeeper-v0",
        *,
        render_mode: None = None,
        record: Union[str, "os.PathLike[str]", None] = None,
        **options: Any,
    ) -> None: ...
    def reset(
        self, *, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None
    ) -> Tuple[npt.NDArray[np.float32], Dict[str, Any]]: ...
    def step(
        self, action: npt.ArrayLike
    ) -> Tuple[npt.NDArray[np.float32], float, bool, bool, Dict[str, Any]]: ...
    def state(self) -> npt.NDArray[np.float32]: ...
    def close(self) -> None: ...

class VectorEnv(_VectorEnv[npt.NDArray[np.float32], npt.ArrayLike, npt.NDArray[Any]]):  # type: ignore[misc]
    id: str
    metadata: Dict[str, Any]
    def __init__(
        self,
        id: str = "goalkeeper-v0",
        num_envs: int = 1,
        *,
        threads: int = 0,
        autoreset: Any = "NextStep",
        copy: bool = True,
        render_mode: None = None,
        record: Union[str, "os.PathLike[str]", None] = None,
        **options: Any,
    ) -> None: ...
    def reset(
        self,
        *,
        seed: Optional[Union[int, Sequence[Optional[int]]]] = None,
        options: Optional[Dict[str, Any]] = None,
    ) -> Tuple[npt.NDArray[np.float32], Dict[str, Any]]: ...
    def step(
        self, actions: npt.ArrayLike
    ) -> Tuple[
        npt.NDArray[np.float32],
        npt.NDArray[np.float64],
        npt.NDArray[np.bool_],
        npt.NDArray[np.bool_],
        Dict[str, Any],
    ]: ...
    def reset_places(
        self,
        places: npt.ArrayLike,
        *,
        seed: Optional[Union[int, Sequence[Optional[int]]]] = None,
        options: Optional[Dict[str, Any]] = None,
    ) -> Tuple[npt.NDArray[np.float32], Dict[str, Any]]: ...
    def states(self) -> npt.NDArray[np.float32]: ...
    def close_extras(self, **kwargs: Any) -> None: ...

def make(id: str, **options: Any) -> Env: ...
def make_vec(id: str, num_envs: int = 1, **options: Any) -> VectorEnv: ...
def register() -> None: ...
