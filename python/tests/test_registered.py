"""What Gymnasium and PettingZoo do with the environments that they find: by the originals where they are installed, and
in any case by a stand-in that passes arguments on as Gymnasium does."""
import importlib
import multiprocessing
import pickle
import sys
import types
import unittest

try:
    import numpy as np
except ImportError:
    print("test_registered.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

import ortung
from ortung import single_agent


def installed(name):
    """Returns a module of the originals, or leaves the test out."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise unittest.SkipTest(f"{name.split('.')[0]} is not there") from None


class StandIn(types.SimpleNamespace):
    """A registry from which environments are made. The arguments of an environment go through functions that have
    arguments "id", "num_envs" and so on of their own."""

    def __init__(self):
        super().__init__(registry={})

    def register(self, id, entry_point, vector_entry_point=None, kwargs=None):
        self.registry[id] = types.SimpleNamespace(id=id, entry_point=entry_point, vector_entry_point=vector_entry_point,
                                                  kwargs=kwargs or {})

    @staticmethod
    def load(name):
        module, _, attribute = name.partition(":")
        return getattr(importlib.import_module(module), attribute)

    def make(self, id, max_episode_steps=None, disable_env_checker=None, **kwargs):
        spec = id if not isinstance(id, str) else self.registry[id]
        return self.load(spec.entry_point)(**{**spec.kwargs, **kwargs})

    def makers(self, id, num_envs, **kwargs):
        """Returns what makes the single environments of a vector, each in a process of its own or not."""
        spec = self.registry[id]
        bare = types.SimpleNamespace(id=spec.id, entry_point=spec.entry_point, kwargs={})
        kwargs = {**spec.kwargs, **kwargs}
        return [lambda: self.make(pickle.loads(pickle.dumps(bare)), **kwargs.copy()) for _ in range(num_envs)]

    def make_vec(self, id, num_envs=1, vectorization_mode=None, vector_kwargs=None, wrappers=None, **kwargs):
        spec = self.registry[id]
        return self.load(spec.vector_entry_point)(num_envs=num_envs, **{**spec.kwargs, **kwargs})


def play_in_process(make, seed, results):
    env = make()
    first, _ = env.reset(seed=seed)
    results.put((seed, [first, env.step(np.zeros(2, np.float32))[0]]))


class Registered(unittest.TestCase):
    def setUp(self):
        self.before, single_agent.gymnasium = single_agent.gymnasium, StandIn()
        ortung.register()
        self.gym = single_agent.gymnasium

    def tearDown(self):
        single_agent.gymnasium = self.before

    def expected(self, seed):
        env = ortung.make("goalkeeper-v0", striker="roll")
        return [env.reset(seed=seed)[0], env.step(np.zeros(2, np.float32))[0]]

    def test_are_made_by_their_names(self):
        self.assertEqual(len(self.gym.registry), 3)
        for name in self.gym.registry:
            self.assertEqual(f"ortung/{self.gym.make(name).id}", name)

    def test_are_made_as_vectors_in_all_ways(self):
        vector = self.gym.make_vec("ortung/goalkeeper-v0", 2, striker="roll")
        self.assertEqual((type(vector), vector.num_envs), (ortung.VectorEnv, 2))
        both = [vector.reset(seed=5)[0], vector.step(np.zeros((2, 2), np.float32))[0]]
        makers = self.gym.makers("ortung/goalkeeper-v0", 2, striker="roll")
        context = multiprocessing.get_context("fork")
        results = context.SimpleQueue()
        for i, make in enumerate(makers):
            expected = self.expected(5 + i)
            np.testing.assert_array_equal([one[i] for one in both], expected)
            env = make()
            np.testing.assert_array_equal(env.reset(seed=5 + i)[0], expected[0])
            process = context.Process(target=play_in_process, args=(make, 5 + i, results))
            process.start()
            seed, found = results.get()
            process.join()
            self.assertEqual((seed, process.exitcode), (5 + i, 0))
            np.testing.assert_array_equal(found, expected)


class Originals(unittest.TestCase):
    def test_gymnasium_makes_vectors(self):
        gymnasium = installed("gymnasium")
        for mode in ("sync", "async", "vector_entry_point"):
            with self.subTest(mode):
                env = gymnasium.make_vec("ortung/goalkeeper-v0", 2, vectorization_mode=mode, striker="roll")
                first, _ = env.reset(seed=5)
                np.testing.assert_array_equal(first[1], ortung.make("goalkeeper-v0", striker="roll").reset(seed=6)[0])
                env.step(env.action_space.sample())
                env.close()

    def test_gymnasium_checks(self):
        gymnasium = installed("gymnasium")
        checker = installed("gymnasium.utils.env_checker")
        checker.check_env(gymnasium.make("ortung/goalkeeper-v0").unwrapped)

    def test_pettingzoo_checks(self):
        tests, conversions = installed("pettingzoo.test"), installed("pettingzoo.utils.conversions")
        for name in ("keeper-vs-striker-v0", "goalkeeper-v0"):
            with self.subTest(name):
                tests.parallel_api_test(ortung.parallel_env(name), num_cycles=200)
                tests.parallel_seed_test(lambda name=name: ortung.parallel_env(name), num_cycles=20)
                tests.api_test(conversions.parallel_to_aec(ortung.parallel_env(name)), num_cycles=100)


if __name__ == "__main__":
    unittest.main()
