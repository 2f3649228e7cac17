import multiprocessing
import os
import pathlib
import sys
import tempfile
import threading
import unittest

try:
    import numpy as np
except ImportError:
    print("test_environments.py: Skipped\nnumpy is not there (python3-numpy)")
    sys.exit(77)

import ortung
import rules
from forks import in_child, in_children_while, unless_thread_sanitizer

SINGLE = [one["id"] for one in ortung.environments() if len(one["agents"]) == 1]


class Rules(unittest.TestCase):
    def test_gymnasium(self):
        for name in SINGLE:
            with self.subTest(name):
                rules.check_env(lambda: ortung.make(name))

    def test_gymnasiums_own_checker(self):
        try:
            from gymnasium.utils.env_checker import check_env
        except ImportError:
            self.skipTest("gymnasium is not there")
        for name in SINGLE:
            with self.subTest(name):
                check_env(ortung.make(name))

    def test_vectors(self):
        for mode, text in (("NEXT_STEP", "NextStep"), ("SAME_STEP", "SameStep"),
                           ("DISABLED", "Disabled")):
            with self.subTest(mode):
                rules.check_vector(
                    lambda n: ortung.make_vec("goalkeeper-v0", n, autoreset=text, threads=2), mode)

    def test_pettingzoo(self):
        rules.check_parallel(ortung.parallel_env)
        rules.check_parallel(lambda: ortung.parallel_env("goalkeeper-v0"))
        rules.check_in_turns(ortung.parallel_env())


class Views(unittest.TestCase):
    def test_a_batch_gives_views_and_the_same_as_one_environment(self):
        batch = ortung.Batch("striker-v0", {"keeper": "random"}, episodes=3, seed=10, threads=2)
        observations = batch.observations
        self.assertTrue(np.shares_memory(observations, batch.observations))
        env = ortung.make("striker-v0", keeper="random")
        self.assertTrue(np.array_equal(env.reset(seed=11)[0], observations[1, 0]))
        random = np.random.default_rng(1)
        for _ in range(20):
            actions = random.uniform(-1, 1, (3, 1, 3)).astype(np.float32)
            batch.step(actions)
            one = env.step(actions[1, 0])
            self.assertTrue(np.array_equal(one[0], observations[1, 0]))
            self.assertEqual(one[1], batch.rewards[1, 0])
            if one[2] or one[3]:
                break
        del batch
        observations.sum()  # a view keeps its array alive

    def test_vectors_give_views_on_demand(self):
        env = ortung.make_vec("goalkeeper-v0", 4, copy=False)
        first, _ = env.reset(seed=1)
        second = env.step(np.zeros((4, 2), np.float32))[0]
        self.assertTrue(np.shares_memory(first, second))
        env = ortung.make_vec("goalkeeper-v0", 4)
        first, _ = env.reset(seed=1)
        self.assertFalse(np.shares_memory(first, env.step(np.zeros((4, 2), np.float32))[0]))

    def test_one_thread_or_several_make_no_difference(self):
        def play(threads):
            env = ortung.make_vec("goalkeeper-v0", 8, threads=threads)
            observations = [env.reset(seed=3)[0]]
            for _ in range(60):
                actions = ortung.heuristic("goalkeeper-v0", 0, observations[-1])
                observations.append(env.step(actions)[0])
            return np.array(observations)
        self.assertTrue(np.array_equal(play(1), play(3)))


    def test_views_can_not_be_written(self):
        batch = ortung.Batch("goalkeeper-v0", episodes=2)
        for name in ("observations", "final_observations", "rewards", "terminated", "truncated",
                     "endings", "seeds", "numbers", "states"):
            with self.subTest(name):
                view = getattr(batch, name)
                with self.assertRaisesRegex(ValueError, "read-only"):
                    view[0] = 1
        env = ortung.make_vec("goalkeeper-v0", 2, copy=False)
        with self.assertRaisesRegex(ValueError, "read-only"):
            env.reset(seed=1)[0][0] = 1


class Episodes(unittest.TestCase):
    def test_options_and_resets_are_of_one_or_of_all(self):
        def batch(options={}):
            return ortung.Batch("striker-v0", options, episodes=3, seed=10)

        changed = {"keeper": "random"}
        plain, random, one, all_of_them = batch(), batch(changed), batch(), batch()
        one.set_options(changed, 1)
        all_of_them.set_options(changed)
        actions = np.zeros((3, 1, 3), np.float32)
        for each in (plain, random, one, all_of_them):
            each.reset([7, 8, 9])
            for _ in range(5):
                each.step(actions)
        self.assertTrue((plain.states != random.states).any(axis=1).all())  # each episode shows the keeper
        np.testing.assert_array_equal(all_of_them.states, random.states)
        np.testing.assert_array_equal(one.states[[0, 2]], plain.states[[0, 2]])
        np.testing.assert_array_equal(one.states[1], random.states[1])
        plain.reset_one(2, 5)
        self.assertEqual(plain.seeds.tolist(), [7, 8, 5])
        for call in (lambda: plain.reset_one(3), lambda: plain.set_options(changed, 3)):
            with self.assertRaisesRegex(IndexError, "no such episode"):
                call()

    def test_heuristics_act_row_by_row(self):
        batch = ortung.Batch("goalkeeper-v0", episodes=4, seed=3)
        batch.step(np.zeros((4, 1, 2), np.float32))
        seen = batch.observations[:, 0]
        for act in (lambda rows: ortung.heuristic("goalkeeper-v0", 0, rows), ortung.blocking):
            actions = act(seen)
            self.assertEqual((actions.shape, actions.dtype), ((4, 2), np.float32))
            np.testing.assert_array_equal(actions, np.concatenate([act(row[None]) for row in seen]))
            self.assertTrue((np.abs(actions) <= 1).all() and actions.any())
            self.assertEqual(act(seen[:0]).shape, (0, 2))


class PartialResets(unittest.TestCase):
    def env(self, n=4):
        env = ortung.make_vec("goalkeeper-v0", n, threads=2, autoreset="Disabled")
        env.reset(seed=20)
        for _ in range(3):
            env.step(np.ones((n, 2), np.float32))
        return env

    def test_begin_the_episodes_of_a_mask(self):
        env = self.env()
        before = env.states()
        observations, infos = env.reset(seed=70, options={"reset_mask": np.array([True, False, True, False])})
        self.assertEqual(infos["seed"].tolist(), [70, 21, 72, 23])
        np.testing.assert_array_equal(env.states()[[1, 3]], before[[1, 3]])
        alone = ortung.make("goalkeeper-v0")
        np.testing.assert_array_equal(observations[2], alone.reset(seed=72)[0])
        observations, infos = env.reset(options={"reset_mask": [False, False, True, False]})
        self.assertEqual(infos["number"].tolist(), [0, 0, 1, 0])
        np.testing.assert_array_equal(observations[2], alone.reset()[0])

    def test_begin_the_episodes_of_some_places(self):
        env = self.env()
        before = env.states()
        observations, infos = env.reset_places([3, 0], seed=[5, 6], options={"striker": "roll"})
        self.assertEqual(infos["seed"].tolist(), [6, 21, 22, 5])
        np.testing.assert_array_equal(env.states()[1:3], before[1:3])
        np.testing.assert_array_equal(observations[3], ortung.make("goalkeeper-v0", striker="roll").reset(seed=5)[0])
        self.assertEqual(env.reset_places(1)[1]["number"].tolist(), [0, 1, 0, 0])
        self.assertEqual(env.reset_places([2], seed=30)[1]["seed"].tolist(), [6, 21, 32, 5])

    def test_refuse_what_is_no_place(self):
        env = self.env()
        for call, kind, words in (
                (lambda: env.reset_places([4]), ValueError, r"places are \[4\], expected different ones from 0 to 3"),
                (lambda: env.reset_places([1, 1]), ValueError, "different"),
                (lambda: env.reset_places([]), TypeError, "numbers of environments"),
                (lambda: env.reset_places([0.5]), TypeError, "numbers of environments"),
                (lambda: env.reset_places([1, 2], seed=[3]), ValueError, "1 seeds for 2 places"),
                (lambda: env.reset(options={"reset_mask": np.ones(3, bool)}), ValueError, "4 flags"),
                (lambda: env.reset(options={"reset_mask": np.zeros(4, bool)}), ValueError, "at least one"),
                (lambda: ortung.make_vec("goalkeeper-v0", 2).reset_places(1), RuntimeError, "as a whole"),
                (lambda: ortung.Batch("goalkeeper-v0").reset(mask=[1]), TypeError, "flags")):
            with self.assertRaisesRegex(kind, words):
                call()


class Threads(unittest.TestCase):
    def test_they_take_turns_at_a_batch(self):
        batch = ortung.Batch("goalkeeper-v0", episodes=16, threads=2)
        actions = np.zeros((16, 1, 2), np.float32)
        failures = []

        def play(number):
            try:
                for i in range(30):
                    batch.step(actions)
                    if i % 10 == number:
                        batch.reset_one(number, i)
                        batch.set_options({"striker": "roll"}, number)
                        batch.reset()
            except BaseException as error:
                failures.append(error)

        threads = [threading.Thread(target=play, args=(i,)) for i in range(3)]
        for one in threads:
            one.start()
        for one in threads:
            one.join()
        self.assertEqual(failures, [])

    def test_they_leave_an_episode_as_one_thread_would(self):
        actions = np.zeros((4, 1, 2), np.float32)
        alone, shared = (ortung.Batch("goalkeeper-v0", episodes=4, threads=2, seed=3)
                         for _ in range(2))
        for _ in range(20):
            alone.step(actions)
        threads = [threading.Thread(target=lambda: [shared.step(actions) for _ in range(5)])
                   for _ in range(4)]
        for one in threads:
            one.start()
        for one in threads:
            one.join()
        self.assertTrue(np.array_equal(alone.observations, shared.observations))


@unless_thread_sanitizer
class Forks(unittest.TestCase):
    def test_a_child_works_on_with_its_copy(self):
        actions = np.zeros((8, 1, 2), np.float32)
        batch = ortung.Batch("goalkeeper-v0", episodes=8, threads=3, seed=5)
        batch.step(actions)

        def play():
            for _ in range(10):
                batch.step(actions)
            return batch.observations.sum()

        self.assertEqual(in_child(play), str(play()))

    def test_a_child_may_make_and_drop_batches(self):
        batches = [ortung.Batch("goalkeeper-v0", episodes=2, threads=2)]
        actions = np.zeros((2, 1, 3), np.float32)

        def play(mine):
            for _ in range(3):
                mine.step(actions)
            return mine.observations.sum()

        def work():
            batches.clear()
            return play(ortung.Batch("localize-and-score-v0", episodes=2, threads=2, seed=5))

        expected = str(play(ortung.Batch("localize-and-score-v0", episodes=2, threads=2, seed=5)))
        self.assertEqual(in_child(work), expected)

    def test_a_batch_that_was_in_use_is_refused(self):
        batch = ortung.Batch("goalkeeper-v0", episodes=256, threads=2)
        actions = np.zeros((256, 1, 2), np.float32)

        def work():
            batch.step(actions)
            return "worked"

        found = in_children_while(lambda: batch.step(actions), work)
        refused = ("RuntimeError: this Batch was in use by another thread when this process was "
                   "forked; make another one here")
        self.assertLessEqual(found, {refused, "worked"})
        self.assertIn(refused, found)

    def test_multiprocessing(self):
        context = multiprocessing.get_context("fork")
        global _shared
        _shared = ortung.make_vec("goalkeeper-v0", 4, threads=2)
        _shared.reset(seed=1)
        sums = []
        for _ in range(2):  # a process each
            with context.Pool(1) as pool:
                sums.append(pool.apply_async(_steps).get(timeout=60))
        self.assertEqual(sums, [_steps()] * 2)


_shared = None


def _steps():
    return float(_shared.step(np.zeros((4, 2), np.float32))[0].sum())


class BadInput(unittest.TestCase):
    def fails(self, kind, words, call):
        with self.assertRaises(kind) as caught:
            call()
        for word in words.split("|"):
            self.assertIn(word, str(caught.exception))

    def test_actions(self):
        env = ortung.make("goalkeeper-v0")
        env.reset(seed=1)
        for action, kind, words in (
                (np.zeros(3), ValueError, "goalkeeper-v0|shape (3,)|expected (2,)"),
                (np.zeros((1, 2)), ValueError, "shape (1, 2)"),
                (["left", "right"], TypeError, "goalkeeper-v0|real numbers"),
                (np.array([True, False]), TypeError, "bool"),
                (np.zeros(2, complex), TypeError, "complex"),
                (None, TypeError, "object"),
                (np.array([0, np.nan]), ValueError, "goalkeeper-v0|keeper|nan|turn"),
                (np.array([np.inf, 0]), ValueError, "inf|forward")):
            self.fails(kind, words, lambda action=action: env.step(action))
        env.step([1, 0])  # integers are accepted
        zoo = ortung.parallel_env()
        zoo.reset(seed=1)
        self.fails(ValueError, "keeper|striker", lambda: zoo.step({"keeper": np.zeros(2)}))
        self.fails(ValueError, "striker|(2,)|(3,)",
                   lambda: zoo.step({"keeper": np.zeros(2), "striker": np.zeros(2)}))
        vector = ortung.make_vec("goalkeeper-v0", 3)
        vector.reset(seed=1)
        self.fails(ValueError, "(3, 3)|expected (3, 2)", lambda: vector.step(np.zeros((3, 3))))
        actions = np.zeros((3, 2))
        actions[2, 0] = np.nan
        self.fails(ValueError, "episode 2|keeper|forward", lambda: vector.step(actions))
        self.fails(ValueError, "shape (3, 1, 2)",
                   lambda: ortung.Batch("goalkeeper-v0", episodes=3).step(np.zeros((3, 2))))
        batch = ortung.Batch("goalkeeper-v0")
        for kind in (complex, bool, str):
            self.fails(TypeError, "goalkeeper-v0: actions|real numbers",
                       lambda kind=kind: batch.step(np.zeros((1, 1, 2)).astype(kind)))
            self.fails(TypeError, "observations|real numbers",
                       lambda kind=kind: ortung.blocking(np.zeros((1, 26)).astype(kind)))
        self.fails(IndexError, "no such episode", lambda: batch.set_options({}, 1))

    def test_stepped_after_the_end(self):
        env = ortung.make("goalkeeper-v0", duration_s=1.0)
        self.fails(RuntimeError, "goalkeeper-v0|reset before", lambda: env.step(np.zeros(2)))
        env.reset(seed=1)
        while not any(env.step(np.zeros(2))[2:4]):
            pass
        self.fails(RuntimeError, "goalkeeper-v0|over", lambda: env.step(np.zeros(2)))
        zoo = ortung.parallel_env(duration_s=1.0)
        self.fails(RuntimeError, "reset before", lambda: zoo.step({}))
        env.close()
        self.fails(RuntimeError, "closed", lambda: env.step(np.zeros(2)))
        self.fails(RuntimeError, "closed", env.reset)

    def test_ids_options_and_seeds(self):
        self.fails(ValueError, "goalie-v0|goalkeeper-v0", lambda: ortung.make("goalie-v0"))
        self.fails(ValueError, "parallel_env", lambda: ortung.make("keeper-vs-striker-v0"))
        self.fails(ortung.ConfigError, "goalkeeper-v0|strikr",
                   lambda: ortung.make("goalkeeper-v0", strikr="roll"))
        self.fails(ortung.ConfigError, "striker:kind=lob|yardstick-v1",
                   lambda: ortung.make("goalkeeper-v0", striker="striker:kind=lob"))
        self.fails(ortung.PluginError, "nobody",
                   lambda: ortung.make("goalkeeper-v0", striker="nobody"))
        self.fails(ortung.ConfigError, "action_s|0.07", lambda: ortung.make("striker-v0", action_s=.07))
        env = ortung.make("goalkeeper-v0")
        self.fails(ValueError, "seed is -1", lambda: env.reset(seed=-1))
        self.fails(ValueError, "2**64", lambda: env.reset(seed=2**64))
        self.fails(TypeError, "seed is 'x'", lambda: env.reset(seed="x"))
        self.fails(TypeError, "seed is 1.5", lambda: env.reset(seed=1.5))
        self.fails(TypeError, "options are", lambda: env.reset(options=3))
        self.fails(ortung.ConfigError, "striker:kind=lob", lambda: env.reset(options={"striker": "striker:kind=lob"}))
        with self.assertWarnsRegex(UserWarning, "'strikr'; did you mean 'striker'?"):
            env.reset(options={"strikr": "roll"})
        self.fails(ValueError, "3 seeds|expected 2",
                   lambda: ortung.make_vec("goalkeeper-v0", 2).reset(seed=[1, 2, 3]))
        self.fails(ValueError, "episodes is 0", lambda: ortung.make_vec("goalkeeper-v0", 0))
        self.fails(ortung.PluginError, "striker is 'shoot', expected shot, dribble, |roll|yardstick-v1|(did you mean 'shot'?)",
                   lambda: ortung.make("goalkeeper-v0", striker="shoot"))
        self.fails(ortung.PluginError, "keeper is 'blokcing', expected blocking, |still|, or a player's text",
                   lambda: ortung.make("striker-v0", keeper="blokcing"))
        self.fails(ortung.ConfigError, "observation is 'thruth'|features, truth",
                   lambda: ortung.make("striker-v0", observation="thruth"))
        self.fails(ValueError, "did you mean 'goalkeeper-v0'", lambda: ortung.make("goalkeper-v0"))
        self.fails(ValueError, "autoreset is 'same_step', expected 'SameStep', 'NextStep', 'Disabled'",
                   lambda: ortung.make_vec("goalkeeper-v0", 2, autoreset="same_step"))
        for make in (ortung.make, ortung.make_vec):
            self.fails(ValueError, "render_mode is 'rgb_array'|no pictures|record=FILE|`ortung view FILE`",
                       lambda: make("goalkeeper-v0", render_mode="rgb_array"))
        self.fails(ValueError, "no pictures|record=FILE", lambda: ortung.parallel_env(render_mode="human"))

    def test_options_of_reset_hold_from_then_on(self):
        env = ortung.make("goalkeeper-v0")
        env.reset(seed=4, options={"striker": "roll"})
        roll = ortung.make("goalkeeper-v0", striker="roll")
        self.assertTrue(np.array_equal(env.reset(seed=9)[0], roll.reset(seed=9)[0]))


class Records(unittest.TestCase):
    def play(self, env, seed=None):
        env.reset(seed=seed)
        done, states = False, [env.state()]
        while not done:
            _, _, terminated, truncated, _ = env.step(np.array([0.4, -0.1]))
            done = terminated or truncated
            states.append(env.state())
        return states

    def truth(self, file, robot):
        """Returns times [s], true poses, and where the ball was seen from there, of a record."""
        container = ortung.Robot(ortung.shipped_file("robots", robot)).container
        times, poses, balls = [], [], []
        for stamp, feature, words in ortung.readings(f"record:{file}"):
            container.set(stamp, feature, words)
            if "/groundTruth/" in feature:
                times.append(1e-6 * stamp)
                poses.append(container.get(feature))
            if feature.endswith("/ball") and len(container.get(feature)):
                balls.append((1e-6 * stamp, *container.get(feature)[0][:2]))
        return np.array(times), np.array(poses), balls

    def test_have_the_truth_of_their_episode(self):
        with tempfile.TemporaryDirectory(prefix="ortung-episode-") as folder:
            pattern = pathlib.Path(folder, "keeper-{seed}-{number}.rec")
            env = ortung.make("goalkeeper-v0", striker="roll", record=pattern)
            plain = ortung.make("goalkeeper-v0", striker="roll")
            for number, seed in enumerate((7, None)):
                states = self.play(env, seed)
                np.testing.assert_array_equal(states, self.play(plain, seed))  # who looks on changes nothing
                file = pathlib.Path(folder, f"keeper-7-{number}.rec")
                times, poses, balls = self.truth(file, "goalkeeper.toml")
                self.assertLess(times[0], 0.05)
                self.assertGreater(times[-1], states[-1][0] - 0.05)
                compared = 0
                for state in states:  # each 0.1 s: time, ball x, y, its velocity, keeper x, y, heading
                    for i in np.flatnonzero(np.abs(times - state[0]) < 1e-4):
                        np.testing.assert_allclose(poses[i][:2], state[5:7], atol=2e-3)
                        self.assertLess(abs(np.angle(np.exp(1j * (poses[i][2] - state[7])))), 2e-3)
                        compared += 1
                self.assertGreater(compared, len(states) // 2)
                self.assertGreater(len(balls), len(states) // 2)
                f2000 = ortung.World(ortung.shipped_file("fields", "f2000.toml"))
                self.assertEqual(ortung.readings(f"record:{file}").world, f2000.fingerprint)

    def test_without_places_for_numbers_have_the_latest_episode(self):
        with tempfile.TemporaryDirectory(prefix="ortung-episode-") as folder:
            file = pathlib.Path(folder, "keeper.rec")
            env = ortung.make("goalkeeper-v0", striker="roll", record=str(file))
            self.play(env, 3)
            first = file.read_bytes()
            self.play(env)
            second = file.read_bytes()
            self.assertNotEqual(first, second)
            self.play(env, 3)
            self.assertEqual(first, file.read_bytes())
            env.reset()
            for _ in range(5):
                env.step(np.zeros(2))
            env.close()  # what was played so far is there
            self.assertGreater(self.truth(file, "goalkeeper.toml")[0][-1], 0.4)
            zoo = ortung.parallel_env(record=file, duration_s=1.0)
            zoo.reset(seed=1)
            while zoo.agents:
                zoo.step({name: np.zeros(zoo.action_space(name).shape, np.float32) for name in zoo.agents})
            self.assertGreater(self.truth(file, "goalkeeper.toml")[0][-1], 0.9)  # the keeper's

    def test_of_many_have_the_number_of_their_place(self):
        with tempfile.TemporaryDirectory(prefix="ortung-episode-") as folder:
            env = ortung.make_vec("goalkeeper-v0", 3, striker="roll", record=f"{folder}/{{place}}-{{number}}.rec")
            env.reset(seed=3)
            for _ in range(5):
                env.step(np.zeros((3, 2), np.float32))
            env.close()
            alone = ortung.make("goalkeeper-v0", striker="roll", record=f"{folder}/alone.rec")
            alone.reset(seed=5)
            for _ in range(5):
                alone.step(np.zeros(2))
            alone.close()
            folder = pathlib.Path(folder)
            self.assertEqual((folder / "2-0.rec").read_bytes(), (folder / "alone.rec").read_bytes())
            self.assertEqual(len(list(folder.iterdir())), 4)
            with self.assertRaisesRegex(ValueError, "a.rec' for 2 environments, expected a name with '{place}'"):
                ortung.make_vec("goalkeeper-v0", 2, record="a.rec")

    def test_replace_records_only(self):
        with tempfile.TemporaryDirectory(prefix="ortung-episode-") as folder:
            notes = pathlib.Path(folder, "notes.txt")
            notes.write_text("mine\n")
            with self.assertRaisesRegex(RuntimeError, "notes.txt: is there already, and is no record"):
                ortung.make("goalkeeper-v0", record=notes).reset(seed=1)
            self.assertEqual(notes.read_text(), "mine\n")
            with self.assertRaisesRegex(RuntimeError, "nowhere"):
                ortung.make("goalkeeper-v0", record=pathlib.Path(folder, "nowhere", "a.rec")).reset(seed=1)
            with self.assertRaisesRegex(TypeError, "record is 3, expected the name of a file"):
                ortung.make("goalkeeper-v0", record=3)

    @unittest.skipUnless(hasattr(os, "fork"), "there is no fork")
    def test_of_a_forked_process_are_left_to_the_first_one(self):
        with tempfile.TemporaryDirectory(prefix="ortung-episode-") as folder:
            alone, forked = pathlib.Path(folder, "alone.rec"), pathlib.Path(folder, "forked.rec")
            for file in (alone, forked):
                env = ortung.make("goalkeeper-v0", striker="roll", record=file)
                env.reset(seed=4)
                for step in range(8):
                    if step == 4 and file == forked:
                        child = os.fork()
                        if child == 0:
                            env.step(np.ones(2))
                            env.close()
                            os._exit(0)
                        self.assertEqual(os.waitpid(child, 0)[1], 0)
                    env.step(np.zeros(2))
                env.close()
            self.assertEqual(alone.read_bytes(), forked.read_bytes())


class Learner(unittest.TestCase):
    def test_the_example_improves(self):
        import cross_entropy
        history = cross_entropy.train(generations=3, candidates=10, episodes=24, test=100, quiet=True)
        self.assertGreater(history["score"][-1], history["score"][0])

    def test_the_one_from_scratch_improves(self):
        import train_keeper
        keeper, history = train_keeper.train(environments=64, steps=32, iterations=12, test=200, every=100, threads=1,
                                             quiet=True)
        self.assertLess(history["goals"][-1], history["goals"][0] - 0.05)
        with tempfile.TemporaryDirectory(prefix="ortung-keeper-") as folder:
            keeper.save(f"{folder}/keeper.npz")
            again = train_keeper.load(f"{folder}/keeper.npz")
        seen = np.random.default_rng(1).uniform(-10, 10, (5, 26)).astype(np.float32)
        np.testing.assert_array_equal(again.act(seen), keeper.act(seen))
        self.assertTrue((np.abs(keeper.act(seen)) <= 1).all())

    def test_its_gradients_are_those_of_small_differences(self):
        import train_keeper
        random = np.random.default_rng(2)
        network = train_keeper.Network([3, 5, 4, 2], random, 1.0)
        network.parameters = [one.astype(np.float64) for one in network.parameters]
        x, weights = random.standard_normal((6, 3)), random.standard_normal((6, 2))
        gradients = network.backward(network.forward(x)[1], weights)
        for parameter, gradient in zip(network.parameters, gradients):
            for place in np.ndindex(parameter.shape):
                before, sums = parameter[place], []
                for step in (1e-5, -1e-5):
                    parameter[place] = before + step
                    sums.append((network.forward(x)[0] * weights).sum())
                parameter[place] = before
                self.assertAlmostEqual(gradient[place], (sums[0] - sums[1]) / 2e-5, places=6)


if __name__ == "__main__":
    unittest.main()
