"""Base classes of environments: those of Gymnasium and PettingZoo if they are installed, else small ones
with the same behaviour."""
import difflib
import enum
import os
import warnings

import numpy as np

from . import _compiled

try:
    import gymnasium
    from gymnasium.spaces import Box
    from gymnasium.vector.utils import batch_space

    GymEnv = gymnasium.Env
    GymVectorEnv = gymnasium.vector.VectorEnv
    try:
        from gymnasium.vector import AutoresetMode
    except ImportError:  # before 1.1
        AutoresetMode = None
except ImportError:
    gymnasium = None
    AutoresetMode = None

    class Box:
        """A space of arrays of one shape, with bounds for each element."""

        def __init__(self, low, high, shape=None, dtype=np.float32, seed=None):
            self.dtype = np.dtype(dtype)
            self._shape = tuple(shape) if shape is not None else np.shape(low)
            self.low = np.broadcast_to(np.asarray(low, self.dtype), self._shape).copy()
            self.high = np.broadcast_to(np.asarray(high, self.dtype), self._shape).copy()
            self._random = np.random.default_rng(seed)

        @property
        def shape(self):
            return self._shape

        def seed(self, seed=None):
            self._random = np.random.default_rng(seed)
            return seed

        def sample(self):
            return self._random.uniform(self.low, self.high).astype(self.dtype)

        def contains(self, x):
            return (isinstance(x, np.ndarray) and x.shape == self._shape
                    and np.can_cast(x.dtype, self.dtype)
                    and bool(np.all(x >= self.low)) and bool(np.all(x <= self.high)))

        __contains__ = contains

        def __eq__(self, other):
            return (isinstance(other, Box) and self._shape == other.shape
                    and self.dtype == other.dtype and np.array_equal(self.low, other.low)
                    and np.array_equal(self.high, other.high))

        __hash__ = None

        def __repr__(self):
            return f"Box({self.low.min()}, {self.high.max()}, {self._shape}, {self.dtype})"

    def batch_space(space, n=1):
        repeats = (n,) + (1,) * len(space.shape)
        return Box(np.tile(space.low, repeats), np.tile(space.high, repeats), dtype=space.dtype)

    class _Seeded:
        _np_random = None
        _np_random_seed = None

        @property
        def np_random(self):
            if self._np_random is None:
                self._seed_random(None)
            return self._np_random

        @np_random.setter
        def np_random(self, value):
            self._np_random = value
            self._np_random_seed = -1

        @property
        def np_random_seed(self):
            if self._np_random_seed is None:
                self._seed_random(None)
            return self._np_random_seed

        def _seed_random(self, seed):
            if seed is None:
                seed = int.from_bytes(os.urandom(8), "little")
            self._np_random = np.random.default_rng(seed)
            self._np_random_seed = seed

        def reset(self, *, seed=None, options=None):
            if seed is not None:
                self._seed_random(seed)

        @property
        def unwrapped(self):
            return self

        def __enter__(self):
            return self

        def __exit__(self, *_):
            self.close()
            return False

    class GymEnv(_Seeded):
        metadata = {"render_modes": []}
        render_mode = None
        spec = None

        def get_wrapper_attr(self, name):
            return getattr(self, name)

        def render(self):
            raise NotImplementedError("environments can't be rendered")

    class GymVectorEnv(_Seeded):
        metadata = {}
        spec = None
        render_mode = None
        closed = False

        def close(self, **kwargs):
            if not self.closed:
                self.closed = True
                self.close_extras(**kwargs)

try:
    from pettingzoo import ParallelEnv as ZooParallelEnv
except ImportError:

    class ZooParallelEnv:
        metadata = {}

        @property
        def num_agents(self):
            return len(self.agents)

        @property
        def max_num_agents(self):
            return len(self.possible_agents)

        @property
        def unwrapped(self):
            return self


if AutoresetMode is None:

    class AutoresetMode(enum.Enum):
        NEXT_STEP = "NextStep"
        SAME_STEP = "SameStep"
        DISABLED = "Disabled"


def learning():
    """Returns the module of environments. It is loaded on first use, since it needs the simulator's
    libraries, without which the rest of the package works."""
    return _compiled("_learning")


def describe(env_id):
    """Returns the description of an environment. Raises ValueError for an unknown id."""
    known = {one["id"]: one for one in learning().environments()}
    if env_id not in known:
        near = difflib.get_close_matches(str(env_id), known, 1)
        meant = f" (did you mean '{near[0]}'?)" if near else ""
        raise ValueError(f"there is no environment '{env_id}', expected {', '.join(known)}{meant}")
    return known[env_id]


def reset_options(info, options, others=()):
    """Returns the options of a reset that an environment knows. It warns of the others, which wrappers and checkers
    pass to all environments alike. Raises TypeError for what is no dict.

    others: further names that the caller takes"""
    if options is not None and not isinstance(options, dict):
        raise TypeError(f"{info['id']}: options are {options!r}, expected a dict or None")
    names = [*others, *(option[0] for option in info["options"])]
    known = {}
    for name, value in (options or {}).items():
        if name in names:
            known[name] = value
            continue
        near = difflib.get_close_matches(str(name), names, 1)
        meant = f"did you mean '{near[0]}'?" if near else f"it knows {', '.join(names)}"
        warnings.warn(f"{info['id']}: reset() passes over the unknown option {name!r}; {meant}", stacklevel=3)
    return known


def box_of(quantities):
    return Box(np.array([q[2] for q in quantities], np.float32),
               np.array([q[3] for q in quantities], np.float32), dtype=np.float32)


def autoreset_mode(env_id, autoreset):
    """Returns the AutoresetMode of one, or of its value. Raises ValueError that names those that there are."""
    try:
        return AutoresetMode(autoreset)
    except ValueError:
        names = [mode.value for mode in AutoresetMode]
        near = difflib.get_close_matches(str(autoreset), names, 1, 0.5)
        names.sort(key=lambda name: name not in near)
        raise ValueError(f"{env_id}: autoreset is {autoreset!r}, expected {', '.join(map(repr, names))}") from None


def record_into(batch, file):
    """Lets a batch write records. Returns whether it does. Raises TypeError for what names no file, ValueError for
    several places with one file."""
    if file is None:
        return False
    if not isinstance(file, (str, os.PathLike)):
        raise TypeError(f"{batch.id}: record is {file!r}, expected the name of a file, or None")
    name = os.fspath(file)
    if len(batch) > 1 and "{place}" not in name and "{seed}" not in name:
        raise ValueError(f"{batch.id}: record is {name!r} for {len(batch)} environments, expected a name with "
                         "'{place}' or '{seed}', so that each has a file of its own")
    for place in range(len(batch)):
        batch.record(place, name.replace("{place}", str(place)))
    return True


def end_record(batch, records):
    """Ends the records of episodes that are given up. Arrays that somebody has may keep the batch itself."""
    if batch is not None and records:
        for place in range(len(batch)):
            batch.record(place, "")


def refuse_pictures(env_id, render_mode, instead):
    """Raises ValueError for any render_mode, which says what there is instead."""
    if render_mode is not None:
        raise ValueError(f"{env_id}: render_mode is {render_mode!r}, but environments draw no pictures; {instead}")


def check_seed(env_id, seed):
    """Returns the seed as an int of 64 bits, or None. Raises TypeError, ValueError for other values."""
    if seed is None:
        return None
    if isinstance(seed, (bool, np.bool_)) or not isinstance(seed, (int, np.integer)):
        raise TypeError(f"{env_id}: the seed is {seed!r}, expected a whole number or None")
    if not 0 <= seed < 2**64:
        raise ValueError(f"{env_id}: the seed is {seed}, expected 0 to 2**64 - 1")
    return int(seed)


def check_action(where, action, shape):
    """Returns the action as float32. Raises TypeError, ValueError, which name the environment."""
    array = np.asarray(action)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{where}: the action is of {array.dtype}, expected real numbers")
    if array.shape != shape:
        raise ValueError(f"{where}: the action has the shape {array.shape}, expected {shape}")
    return array.astype(np.float32, copy=False)
