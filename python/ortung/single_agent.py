"""Environments with one agent by Gymnasium's rules: a single one (Env) and many at a time (VectorEnv)."""
import numpy as np

from ._base import (
    GymEnv, GymVectorEnv, autoreset_mode, batch_space, box_of, check_action, check_seed, describe, end_record,
    gymnasium, learning, record_into, refuse_pictures, reset_options,
)


def _single(env_id):
    info = describe(env_id)
    if len(info["agents"]) != 1:
        raise ValueError(f"{env_id} has several agents: ortung.parallel_env('{env_id}')")
    return info


class Env(GymEnv):
    """An environment with one agent.

    reset(seed=S) begins the episodes (S, 0), (S, 1), ...: each is a function of the id, the options,
    the seed and its number alone. reset() without a seed begins the next one; if there was no seed
    yet, the seed is random. reset(options={...}) overrides options that the environment was made with,
    for all further episodes; it warns of names that the environment does not know.

    record: file of a record of what the agent's robot reads, with its true pose, which `ortung view FILE` shows:
    it has the latest episode, or each one its own if the name has "{seed}" and "{number}". It is whole when the
    episode is over.
    """

    metadata = {"render_modes": [], "render_fps": 10}

    def __init__(self, id="goalkeeper-v0", *, render_mode=None, record=None, **options):
        refuse_pictures(id, render_mode, "record=FILE writes records of episodes, which `ortung view FILE` shows")
        info = _single(id)
        self._description = info
        self.id = id
        self.render_mode = None
        self.metadata = {**type(self).metadata, "name": id}
        self.observation_space = box_of(info["observation"])
        self.action_space = box_of(info["actions"][info["agents"][0]])
        self._shape = self.action_space.shape
        self._batch = learning().Batch(id, options, autoreset=learning().Autoreset.DISABLED)
        self._records = record_into(self._batch, record)
        self._is_seeded = False
        self._is_running = False

    def _need_open(self):
        if self._batch is None:
            raise RuntimeError(f"{self.id} is closed")

    def _info(self):
        return {"seed": int(self._seeds[0]), "number": int(self._numbers[0])}

    def reset(self, *, seed=None, options=None):
        """Begins an episode; returns its first observation, and info with its seed and number."""
        self._need_open()
        seed = check_seed(self.id, seed)
        options = reset_options(self._description, options)
        super().reset(seed=seed)
        batch = self._batch
        if options:
            batch.set_options(options)
        if seed is None and not self._is_seeded:
            seed = int(self.np_random.integers(2**63))
        batch.reset_one(0, seed)
        self._is_seeded = self._is_running = True
        self._observation = batch.observations[0, 0]  # views of arrays that each step changes
        self._rewards, self._endings = batch.rewards[0], batch.endings
        self._terminated, self._truncated = batch.terminated, batch.truncated
        self._seeds, self._numbers = batch.seeds, batch.numbers
        return self._observation.copy(), self._info()

    def step(self, action):
        """Acts; returns observation, reward, terminated, truncated and info."""
        self._need_open()
        if not self._is_running:
            raise RuntimeError(f"{self.id} must be reset before it is stepped"
                               + (" again: its episode is over" if self._is_seeded else ""))
        action = check_action(self.id, action, self._shape)
        self._batch.step(action.reshape(1, 1, -1))
        terminated, truncated = bool(self._terminated[0]), bool(self._truncated[0])
        info = self._info()
        if terminated or truncated:
            self._is_running = False
            info["ending"] = learning().ending_name(int(self._endings[0]))
        return self._observation.copy(), float(self._rewards[0]), terminated, truncated, info

    def state(self):
        """Returns the complete state of the world, 12 numbers: see Batch.states."""
        self._need_open()
        return self._batch.states[0].copy()

    def close(self):
        """Gives the episode up; nothing can be called afterwards."""
        end_record(self._batch, self._records)
        self._batch = None
        self._is_running = False


class VectorEnv(GymVectorEnv):
    """N environments of one id, which are stepped by one call on several threads.

    threads: number of threads; 0: as many as the machine has. autoreset: "NextStep", "SameStep" or
    "Disabled", see Gymnasium's AutoresetMode. copy=False returns views of arrays that the next call
    changes. record: as of Env; "{place}" in the name stands for the number of the environment, and
    with several of them the name has it or "{seed}".
    """

    metadata = {"render_modes": []}

    def __init__(self, id="goalkeeper-v0", num_envs=1, *, threads=0, autoreset="NextStep",
                 copy=True, render_mode=None, record=None, **options):
        refuse_pictures(id, render_mode, "record=FILE writes records of episodes, which `ortung view FILE` shows")
        info = _single(id)
        self._description = info
        self._mode = autoreset_mode(id, autoreset)
        self.id = id
        self.num_envs = num_envs
        self.metadata = {**type(self).metadata, "name": id, "autoreset_mode": self._mode}
        self.single_observation_space = box_of(info["observation"])
        self.single_action_space = box_of(info["actions"][info["agents"][0]])
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.render_mode = None
        self.closed = False
        self._copy = copy
        self._batch = learning().Batch(id, options, episodes=num_envs, threads=threads,
                                       autoreset=learning().Autoreset.__members__[self._mode.name])
        self._records = record_into(self._batch, record)
        self._is_seeded = False

    def _out(self, array):
        return array.copy() if self._copy else array

    def _need_open(self):
        if self._batch is None:
            raise RuntimeError(f"{self.id} is closed")

    def _mask(self, options):
        mask = options.pop("reset_mask", None)
        if mask is None:
            return None
        mask = np.asarray(mask)
        if mask.dtype != bool or mask.shape != (self.num_envs,) or not mask.any():
            raise ValueError(f"{self.id}: reset_mask must be {self.num_envs} flags, at least one set")
        if not self._is_seeded and not mask.all():
            raise RuntimeError(f"{self.id} must be reset as a whole before a part of it")
        return None if mask.all() else mask

    def _seeds(self, seed):
        if seed is None and not self._is_seeded:
            seed = int(self.np_random.integers(2**62))
        if seed is None or isinstance(seed, (int, np.integer)):
            first = check_seed(self.id, seed)
            return [None if first is None else first + i for i in range(self.num_envs)]
        seeds = [check_seed(self.id, one) for one in seed]
        if len(seeds) != self.num_envs:
            raise ValueError(f"{self.id}: {len(seeds)} seeds, expected {self.num_envs}")
        return seeds

    def reset(self, *, seed=None, options=None):
        """Begins episodes: all, or those whose flag in options["reset_mask"] is set; the others stay where they are.
        Returns observations and infos, those of all. seed: place i has the seed seed + i; or a list of seeds, in which
        None means the next episode. The other options are as of Env, for these places."""
        self._need_open()
        options = reset_options(self._description, options, ["reset_mask"])
        mask = self._mask(options)
        if seed is None or isinstance(seed, (int, np.integer)):
            super().reset(seed=check_seed(self.id, seed))
        seeds = self._seeds(seed)
        batch = self._batch
        if options:
            for i in range(self.num_envs):
                if mask is None or mask[i]:
                    batch.set_options(options, i)
        batch.reset(seeds, mask)
        self._is_seeded = True
        return self._out(batch.observations[:, 0]), self._infos(batch)

    def reset_places(self, places, *, seed=None, options=None):
        """Begins the episodes of some places, given by their numbers, e.g. reset_places([3, 7], seed=[1, 2]), as
        reset() does. seed: one for each of these places, or a number: place i has the seed seed + i."""
        places = np.atleast_1d(np.asarray(places))
        if places.dtype.kind not in "iu" or places.ndim != 1 or len(places) == 0:
            raise TypeError(f"{self.id}: places are {places!r}, expected numbers of environments")
        if places.min() < 0 or places.max() >= self.num_envs or len(np.unique(places)) < len(places):
            raise ValueError(f"{self.id}: places are {places.tolist()}, expected different ones from 0 to "
                             f"{self.num_envs - 1}")
        mask = np.zeros(self.num_envs, bool)
        mask[places] = True
        if seed is not None and not isinstance(seed, (int, np.integer)):
            if len(seed) != len(places):
                raise ValueError(f"{self.id}: {len(seed)} seeds for {len(places)} places")
            given, seed = seed, [None] * self.num_envs
            for place, one in zip(places, given):
                seed[place] = one
        return self.reset(seed=seed, options={**(options or {}), "reset_mask": mask})

    def _infos(self, batch):
        everywhere = np.ones(self.num_envs, bool)
        return {"seed": batch.seeds.copy(), "_seed": everywhere,
                "number": batch.numbers.copy(), "_number": everywhere.copy()}

    def step(self, actions):
        """Acts in all; returns observations, rewards, terminated, truncated, (N, ...), and infos."""
        self._need_open()
        if not self._is_seeded:
            raise RuntimeError(f"{self.id} must be reset before it is stepped")
        actions = check_action(self.id, actions, self.action_space.shape)
        batch = self._batch
        batch.step(actions[:, None, :])
        infos = self._infos(batch)
        endings = batch.endings
        if endings.any():
            ended = endings != 0
            infos["ending"], infos["_ending"] = endings.copy(), ended
            if self._mode.name == "SAME_STEP":
                final = np.full(self.num_envs, None, object)
                for i in np.flatnonzero(ended):
                    final[i] = batch.final_observations[i, 0].copy()
                infos["final_obs"], infos["_final_obs"] = final, ended.copy()
                infos["final_info"] = {"ending": endings.copy(), "_ending": ended.copy()}
                infos["_final_info"] = ended.copy()
        return (self._out(batch.observations[:, 0]), self._out(batch.rewards[:, 0]),
                self._out(batch.terminated), self._out(batch.truncated), infos)

    def states(self):
        """Returns the complete state of each world, (N, 12)."""
        self._need_open()
        return self._out(self._batch.states)

    def close_extras(self, **kwargs):
        """Gives the episodes up; close() calls it."""
        end_record(self._batch, self._records)
        self._batch = None


def make(id, **options):
    """Makes an Env of one of Ortung's environments, e.g. make("striker-v0", keeper="intercepting").

    id: "goalkeeper-v0", "striker-v0" or "localize-and-score-v0"; options: those of the environment, such as
    striker="shot", observation="truth", duration_s=5.0. ortung.environments() lists ids, options with their values
    and defaults, actions and observations. record=FILE writes records of episodes, for `ortung view FILE`; "{seed}"
    and "{number}" in its name stand for those of the episode. Raises ValueError for an unknown id, ConfigError and
    PluginError for options. See docs/learning.md.
    """
    return Env(id, **options)


def make_vec(id, num_envs=1, **options):
    """Makes a VectorEnv: num_envs environments of one id, which one call steps, (N, ...) arrays at a time.

    threads: number of threads; 0: as many as the machine has (episodes do not depend on it). autoreset: when an episode
    that is over begins anew: "NextStep", "SameStep", or "Disabled" (by reset() with options={"reset_mask": flags}).
    copy: whether step() returns copies; False: views of arrays that the next call changes, which is faster.
    record=FILE writes records as make() does, with "{place}" or "{seed}" in the name. The other options are those of the
    environment, as make() takes them: ortung.environments() lists them, with ids, actions and observations. Raises
    ValueError for an unknown id, ConfigError and PluginError for options.
    """
    return VectorEnv(id, num_envs, **options)


def _registered(environment, **options):
    return Env(environment, **options)


def _registered_vec(environment, num_envs=1, **options):
    return VectorEnv(environment, num_envs, **options)


def register():
    """Registers the environments with one agent as "ortung/ID" at Gymnasium, if that is installed."""
    if gymnasium is None:
        return
    for info in learning().environments():
        name = f"ortung/{info['id']}"
        if len(info["agents"]) == 1 and name not in gymnasium.registry:
            # Gymnasium passes these arguments on through functions that have an "id" of their own.
            gymnasium.register(name, entry_point="ortung.single_agent:_registered",
                               vector_entry_point="ortung.single_agent:_registered_vec",
                               kwargs={"environment": info["id"]})
