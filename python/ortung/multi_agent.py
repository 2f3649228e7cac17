"""Environments by the rules of PettingZoo's parallel API."""
import numpy as np

from ._base import (
    Box, ZooParallelEnv, box_of, check_action, check_seed, describe, end_record, learning, record_into, refuse_pictures,
    reset_options,
)


class ParallelEnv(ZooParallelEnv):
    """An environment in which all agents act at the same time, until the episode ends for all.

    record: file of a record of what the first agent's robot reads, as of Env."""

    metadata = {"render_modes": [], "name": "keeper-vs-striker-v0", "is_parallelizable": True}

    def __init__(self, id="keeper-vs-striker-v0", *, render_mode=None, record=None, **options):
        refuse_pictures(id, render_mode, "record=FILE writes records of episodes, which `ortung view FILE` shows")
        info = describe(id)
        self._description = info
        self.id = id
        self.render_mode = None
        self.metadata = {**type(self).metadata, "name": id}
        self.possible_agents = list(info["agents"])
        self.agents = []
        self.observation_spaces = {a: box_of(info["observation"]) for a in self.possible_agents}
        self.action_spaces = {a: box_of(info["actions"][a]) for a in self.possible_agents}
        self.state_space = Box(-1000.0, 1000.0, (12,), np.float32)
        self._batch = learning().Batch(id, options, autoreset=learning().Autoreset.DISABLED)
        self._records = record_into(self._batch, record)
        width = max(space.shape[0] for space in self.action_spaces.values())
        self._actions = np.zeros((1, len(self.possible_agents), width), np.float32)
        self._is_seeded = False

    def observation_space(self, agent):
        """Returns the space of an agent's observations."""
        return self.observation_spaces[agent]

    def action_space(self, agent):
        """Returns the space of an agent's actions."""
        return self.action_spaces[agent]

    def _need_open(self):
        if self._batch is None:
            raise RuntimeError(f"{self.id} is closed")

    def _observations(self):
        return {a: self._batch.observations[0, i].copy()
                for i, a in enumerate(self.possible_agents)}

    def _infos(self):
        seed, number = int(self._batch.seeds[0]), int(self._batch.numbers[0])
        return {a: {"seed": seed, "number": number} for a in self.possible_agents}

    def reset(self, seed=None, options=None):
        """Begins an episode; returns observations and infos by agent. It warns of unknown options."""
        self._need_open()
        seed = check_seed(self.id, seed)
        options = reset_options(self._description, options)
        if options:
            self._batch.set_options(options)
        if seed is None and not self._is_seeded:
            seed = int(np.random.SeedSequence().generate_state(1, np.uint64)[0])
        self._batch.reset_one(0, seed)
        self._is_seeded = True
        self.agents = self.possible_agents[:]
        return self._observations(), self._infos()

    def step(self, actions):
        """Acts; returns observations, rewards, terminations, truncations and infos by agent."""
        self._need_open()
        if not self.agents:
            raise RuntimeError(f"{self.id} must be reset before it is stepped"
                               + (" again: its episode is over" if self._is_seeded else ""))
        if not isinstance(actions, dict) or set(actions) != set(self.agents):
            found = sorted(map(str, actions)) if isinstance(actions, dict) else type(actions).__name__
            raise ValueError(f"{self.id}: actions of {found}, expected of {self.agents}")
        for i, agent in enumerate(self.possible_agents):
            shape = self.action_spaces[agent].shape
            self._actions[0, i, :shape[0]] = check_action(f"{self.id}, {agent}", actions[agent], shape)
        batch = self._batch
        batch.step(self._actions)
        infos = self._infos()
        terminated, truncated = bool(batch.terminated[0]), bool(batch.truncated[0])
        if terminated or truncated:
            for info in infos.values():
                info["ending"] = learning().ending_name(int(batch.endings[0]))
            self.agents = []
        rewards = {a: float(batch.rewards[0, i]) for i, a in enumerate(self.possible_agents)}
        return (self._observations(), rewards, dict.fromkeys(self.possible_agents, terminated),
                dict.fromkeys(self.possible_agents, truncated), infos)

    def state(self):
        """Returns the true state of time, ball, keeper and striker, e.g. for a critic: see Batch.states."""
        self._need_open()
        return self._batch.states[0].copy()

    def render(self):
        """Raises NotImplementedError: there are no pictures."""
        raise NotImplementedError("environments can't be rendered")

    def close(self):
        """Gives the episode up; nothing can be called afterwards."""
        end_record(self._batch, self._records)
        self._batch = None
        self.agents = []


def parallel_env(id="keeper-vs-striker-v0", **options):
    """Makes a ParallelEnv; PettingZoo's modules have a function of this name."""
    return ParallelEnv(id, **options)
