"""Checks that environments keep the rules of Gymnasium (alone and as vectors) and of PettingZoo's parallel
API. Farama's checkers check the same, but are not Debian packages; these checks run everywhere."""
import copy
import warnings

import numpy as np


def check_unknown_options(env):
    """Checks what checkers do first: a reset with an option that no environment has, which must warn the caller."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        first = env.reset(seed=0, options={"options": 1})
    assert len(told) == 1 and issubclass(told[0].category, UserWarning) and told[0].filename == __file__, told
    assert "unknown option 'options'" in str(told[0].message), told[0]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert equivalent(env.reset(seed=0, options={}), first)


def equivalent(a, b):
    if type(a) is not type(b):
        return False
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(equivalent(a[k], b[k]) for k in a)
    if isinstance(a, (tuple, list)):
        return len(a) == len(b) and all(equivalent(x, y) for x, y in zip(a, b))
    if isinstance(a, np.ndarray):
        if a.dtype == object:
            return a.shape == b.shape and all(equivalent(x, y) for x, y in zip(a, b))
        return a.dtype == b.dtype and np.array_equal(a, b, equal_nan=True)
    return a == b


def _check_space(space):
    assert np.all(np.isfinite(space.low)) and np.all(np.isfinite(space.high))
    assert np.all(space.low < space.high)
    space.seed(3)
    first = space.sample()
    space.seed(3)
    assert np.array_equal(first, space.sample()) and first in space
    assert first.dtype == np.float32 and first.shape == space.shape


def check_env(make):
    """Checks Gymnasium's rules for one environment."""
    env = make()
    _check_space(env.observation_space)
    _check_space(env.action_space)
    assert np.all(env.action_space.low == -1) and np.all(env.action_space.high == 1)
    assert env.unwrapped is env
    result = env.reset()
    assert isinstance(result, tuple) and len(result) == 2 and isinstance(result[1], dict)
    one = env.reset(seed=123)
    random = copy.deepcopy(env.np_random)
    assert equivalent(env.reset(seed=123), one)
    assert env.np_random.bit_generator.state == random.bit_generator.state
    assert one[0] in env.observation_space
    other = env.reset(seed=456)
    assert not equivalent(other[0], one[0])
    assert env.np_random.bit_generator.state != random.bit_generator.state
    env.reset(seed=123)
    after = env.reset()  # no seed: another episode, and the random numbers are not seeded anew
    assert not equivalent(after[0], one[0])
    assert env.np_random.bit_generator.state == random.bit_generator.state
    env.reset(seed=123)
    assert equivalent(env.reset(), after)
    assert not equivalent(make().reset()[0], make().reset()[0])  # the first seed is random
    check_unknown_options(env)

    twin = make()
    env.action_space.seed(1)
    assert equivalent(env.reset(seed=5), twin.reset(seed=5))
    ended = False
    for _ in range(300):
        action = env.action_space.sample()
        results = env.step(action), twin.step(action)
        assert equivalent(*results)
        observation, reward, terminated, truncated, info = results[0]
        assert observation in env.observation_space and observation.dtype == np.float32
        assert type(reward) is float and np.isfinite(reward)
        assert type(terminated) is bool and type(truncated) is bool and isinstance(info, dict)
        if terminated or truncated:
            ended = True
            assert info["ending"] in ("goal", "saved", "out", "time")
            break
    assert ended
    env.close()
    env.close()


def check_vector(make, mode):
    """Checks the rules of Gymnasium's vector API. @param make makes a vector of so many environments"""
    n = 6
    env = make(n)
    assert env.metadata["autoreset_mode"].name == mode
    assert env.num_envs == n
    assert env.observation_space.shape == (n,) + env.single_observation_space.shape
    assert env.action_space.shape == (n,) + env.single_action_space.shape
    first, infos = env.reset(seed=7)
    assert first in env.observation_space and isinstance(infos, dict)
    assert list(infos["seed"]) == list(range(7, 7 + n))
    again, _ = env.reset(seed=list(range(7, 7 + n)))
    assert np.array_equal(first, again)
    env.reset()
    check_unknown_options(env)
    env.reset(seed=7)
    env.action_space.seed(2)
    dead = np.zeros(n, bool)
    ends = 0
    for _ in range(250):
        previous = dead
        observations, rewards, terminated, truncated, infos = env.step(env.action_space.sample())
        assert observations in env.observation_space
        assert rewards.shape == terminated.shape == truncated.shape == (n,)
        assert terminated.dtype == truncated.dtype == bool and rewards.dtype == np.float64
        for key in infos:
            if not key.startswith("_") and not isinstance(infos[key], dict):
                assert len(infos[key]) == n and infos["_" + key].dtype == bool
        dead = terminated | truncated
        ends += dead.sum()
        if mode == "NEXT_STEP":  # the step behind the end begins the next one
            assert not np.any(dead & previous) and not np.any(rewards[previous])
        if mode == "SAME_STEP" and dead.any():
            assert np.array_equal(infos["_final_obs"], dead)
            for i in np.flatnonzero(dead):
                assert infos["final_obs"][i] in env.single_observation_space
                assert not np.array_equal(infos["final_obs"][i], observations[i])
        if mode == "DISABLED" and dead.any():
            kept = observations.copy()
            kept_infos = infos
            observations, infos = env.reset(options={"reset_mask": dead})
            assert np.array_equal(observations[~dead], kept[~dead])
            assert np.all(infos["number"][dead] == kept_infos["number"][dead] + 1)
            dead = np.zeros(n, bool)
    assert ends > n
    env.close()
    env.close()


def check_parallel(make):
    """Checks PettingZoo's rules as its parallel_api_test and parallel_seed_test do."""
    env = make()
    assert env.metadata["name"].endswith("-v0")
    for agent in env.possible_agents:
        assert env.observation_space(agent) is env.observation_space(agent)
        assert env.action_space(agent) is env.action_space(agent)
        _check_space(env.observation_space(agent))
        _check_space(env.action_space(agent))
    check_unknown_options(env)
    for _ in range(3):
        observations, infos = env.reset()
        alive = set(env.possible_agents)
        assert set(env.agents) == alive == set(observations) == set(infos)
        gone = set()
        while env.agents:
            actions = {a: env.action_space(a).sample() for a in env.agents}
            results = env.step(actions)
            assert len(results) == 5
            for one in results:
                assert set(one) == alive
            observations, rewards, terminated, truncated, infos = results
            for agent in alive:
                assert observations[agent] in env.observation_space(agent)
                assert np.isscalar(rewards[agent]) and isinstance(terminated[agent], bool)
            gone |= {a for a in alive if terminated[a] or truncated[a]}
            alive -= gone
            assert set(env.agents) == alive and not gone & alive
            assert env.state().shape == env.state_space.shape and env.state() in env.state_space
        assert gone == set(env.possible_agents)
    twin = make()
    assert equivalent(env.reset(seed=42), twin.reset(seed=42))
    for agent in env.possible_agents:
        env.action_space(agent).seed(1)
    while env.agents:
        actions = {a: env.action_space(a).sample() for a in env.agents}
        assert equivalent(env.step(actions), twin.step(actions))
        assert env.agents == twin.agents
    env.close()
    env.close()


def check_in_turns(env):
    """Checks what PettingZoo's api_test does with an environment whose agents act in turns: it collects their actions,
    steps when it has those of all, begins anew in the middle of an episode, and gives actions of zeros twice."""
    check_unknown_options(env)
    for length in (2, 1000):
        observations, _ = env.reset()
        owed = dict.fromkeys(env.possible_agents, 0.0)
        for _ in range(length):
            if not env.agents:
                break
            actions = {}
            for agent in env.agents:
                space = env.observation_space(agent)
                assert observations[agent] in space and observations[agent].dtype == space.dtype
                assert owed.pop(agent) is not None
                actions[agent] = env.action_space(agent).sample()
            acted = env.agents[:]
            observations, owed, terminated, truncated, infos = env.step(actions)
            assert env.num_agents == len(env.agents) <= env.max_num_agents
            for agent in acted:
                assert isinstance(owed[agent], float) and isinstance(infos[agent], dict)
                assert type(terminated[agent]) is bool and type(truncated[agent]) is bool
    for _ in range(2):
        env.reset(seed=0)
        env.step({agent: np.zeros_like(env.action_space(agent).low) for agent in env.agents})
    env.close()
