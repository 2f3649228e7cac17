#!/usr/bin/env python3
"""Trains a goalkeeper from scratch by proximal policy optimization (PPO), with numpy alone.

The policy is a network of two hidden layers. It sees the 26 numbers of an observation of goalkeeper-v0 and knows
nothing else: no policy of ours, no model of the ball. The reward is the environment's: 1 for a saved ball, -1 for a
goal. See J. Schulman, F. Wolski, P. Dhariwal, A. Radford, O. Klimov: Proximal policy optimization algorithms, 2017
(arXiv:1707.06347); advantages are those of J. Schulman, P. Moritz, S. Levine, M. Jordan, P. Abbeel: High-dimensional
continuous control using generalized advantage estimation, 2016 (arXiv:1506.02438).

    python3 train_keeper.py --policy keeper.npz --curve curve.json --picture curve.png
    python3 train_keeper.py --evaluate keeper.npz
"""
import argparse
import json
import time

import numpy as np

import curves
import ortung

# What observations are divided by: own x, y, heading, velocities, time left; five sights of the ball; the other robot.
SCALE = np.array([1, 1, 1, 1, 1.5, 1.5, 3, 10] + [4, 2, 0.5] * 5 + [4, 2, 0.5], np.float32)
MOST = 3.0  # what a scaled number is at most: the age of what was never seen is 10 s


class Network:
    """Layers of weights with tanh between them, and the moments of Adam (Kingma and Ba, 2015)."""

    def __init__(self, sizes, random, last):
        self.parameters = []
        for i, (n, m) in enumerate(zip(sizes, sizes[1:])):
            gain = last if i == len(sizes) - 2 else 1.0
            weights = random.standard_normal((n, m)) * gain / np.sqrt(n)
            self.parameters += [weights.astype(np.float32), np.zeros(m, np.float32)]
        self.start_adam()

    def start_adam(self):
        self.moments = [(np.zeros_like(p), np.zeros_like(p)) for p in self.parameters]
        self.steps = 0

    def forward(self, x):
        """Returns the outputs (N, m), and the inputs of each layer, which backward() needs."""
        inputs = [x]
        layers = len(self.parameters) // 2  # a parameter behind those of the layers is none of theirs
        for i in range(layers):
            x = x @ self.parameters[2 * i] + self.parameters[2 * i + 1]
            if i < layers - 1:
                x = np.tanh(x)
                inputs.append(x)
        return x, inputs

    def backward(self, inputs, gradient):
        """Returns the gradient of each parameter. gradient: of the outputs, (N, m)"""
        found = [None] * (2 * len(inputs))
        for i in reversed(range(len(inputs))):
            found[2 * i] = inputs[i].T @ gradient
            found[2 * i + 1] = gradient.sum(0)
            if i > 0:
                gradient = (gradient @ self.parameters[2 * i].T) * (1 - inputs[i] ** 2)
        return found

    def adam(self, gradients, rate, most=0.5):
        """Goes a step against the gradients, whose norm is limited."""
        norm = np.sqrt(sum(float((g * g).sum()) for g in gradients))
        shrink = min(1.0, most / (norm + 1e-8))
        self.steps += 1
        for p, g, (m, v) in zip(self.parameters, gradients, self.moments):
            g = g * shrink
            m += 0.1 * (g - m)
            v += 0.001 * (g * g - v)
            away = m / (1 - 0.9 ** self.steps)
            p -= (rate * away / (np.sqrt(v / (1 - 0.999 ** self.steps)) + 1e-8)).astype(np.float32)


def scaled(observations):
    return np.clip(observations / SCALE, -MOST, MOST)


class Keeper:
    """A policy with normally distributed actions, and what it expects to win."""

    def __init__(self, random, hidden=64):
        self.policy = Network([len(SCALE), hidden, hidden, 2], random, 0.01)
        self.policy.parameters.append(np.full(2, -0.5, np.float32))  # logarithms of the standard deviations
        self.policy.start_adam()
        self.value = Network([len(SCALE), hidden, hidden, 1], random, 1.0)

    @property
    def spread(self):
        return np.exp(self.policy.parameters[-1])

    def act(self, observations):
        """Returns the actions (N, 2) that it thinks best."""
        return np.clip(self.policy.forward(scaled(observations))[0], -1, 1)

    def save(self, file):
        names = [f"p{i}" for i in range(len(self.policy.parameters))]
        np.savez(file, scale=SCALE, most=MOST, **dict(zip(names, self.policy.parameters)))


def load(file):
    keeper = Keeper(np.random.default_rng(0))
    with np.load(file) as found:
        keeper.policy.parameters = [found[f"p{i}"] for i in range(len(keeper.policy.parameters))]
    return keeper


def log_likelihood(actions, means, log_spread):
    away = (actions - means) / np.exp(log_spread)
    return -0.5 * (away * away).sum(1) - log_spread.sum()


def play(env, keeper, state, steps, random):
    """Plays some steps in each environment. state: observations and whether a place's episode has just ended. Returns
    what happened, arrays (steps, N, ...), and the state after it."""
    observations, fresh = state
    n = env.num_envs
    seen = np.empty((steps, n, len(SCALE)), np.float32)
    actions = np.empty((steps, n, 2), np.float32)
    likely, rewards = np.empty((steps, n), np.float32), np.empty((steps, n), np.float32)
    ends, counts = np.empty((steps, n), bool), np.empty((steps, n), bool)
    for t in range(steps):
        seen[t] = scaled(observations)
        means, _ = keeper.policy.forward(seen[t])
        actions[t] = means + keeper.spread * random.standard_normal(means.shape, np.float32)
        likely[t] = log_likelihood(actions[t], means, keeper.policy.parameters[-1])
        observations, rewards[t], terminated, truncated, _ = env.step(np.clip(actions[t], -1, 1))
        counts[t] = ~fresh  # the step that begins an episode takes no action
        ends[t] = fresh = terminated | truncated
    return (seen, actions, likely, rewards, ends, counts), (observations, fresh)


def advantages_of(keeper, played, last, gamma=0.99, decay=0.95):
    """Returns advantages and returns, (steps, N). The time that is left is seen, so an episode's end has no future."""
    seen, _, _, rewards, ends, _ = played
    values = keeper.value.forward(seen.reshape(-1, len(SCALE)))[0].reshape(rewards.shape)
    after = keeper.value.forward(scaled(last))[0][:, 0]
    advantages = np.empty_like(rewards)
    sum_ = np.zeros_like(after)
    for t in reversed(range(len(rewards))):
        goes_on = ~ends[t]
        sum_ = rewards[t] + goes_on * gamma * after - values[t] + goes_on * gamma * decay * sum_
        advantages[t], after = sum_, values[t]
    return advantages, advantages + values


def improve(keeper, batch, rate, clip=0.2, entropy=0.001):
    """Goes a step with a part of what was played."""
    seen, actions, likely, advantages, returns = batch
    n = len(seen)
    means, inputs = keeper.policy.forward(seen)
    log_spread = keeper.policy.parameters[-1]
    ratio = np.exp(np.clip(log_likelihood(actions, means, log_spread) - likely, -10, 10))
    a = (advantages - advantages.mean()) / (advantages.std() + 1e-6)
    # The clipped objective has no gradient where the ratio has gone too far into the better direction.
    pulls = np.where(((a > 0) & (ratio > 1 + clip)) | ((a < 0) & (ratio < 1 - clip)), 0.0, -a * ratio)[:, None] / n
    away = (actions - means) / np.exp(log_spread)
    gradients = keeper.policy.backward(inputs, (pulls * away / np.exp(log_spread)).astype(np.float32))
    gradients.append((pulls * (away * away - 1)).sum(0) - entropy)
    keeper.policy.adam(gradients, rate)
    values, inputs = keeper.value.forward(seen)
    keeper.value.adam(keeper.value.backward(inputs, (values - returns[:, None]) / n), rate)


def learn_from(keeper, played, last, random, rate, epochs=5, size=2048):
    advantages, returns = advantages_of(keeper, played, last)
    seen, actions, likely, _, _, counts = played
    kept = np.flatnonzero(counts.ravel())
    flat = [array.reshape(counts.size, *array.shape[2:]) for array in (seen, actions, likely, advantages, returns)]
    for _ in range(epochs):
        random.shuffle(kept)
        for part in np.array_split(kept, max(1, len(kept) // size)):
            improve(keeper, [array[part] for array in flat], rate)


def evaluate(keeper, striker="shot", seed=1, episodes=1000, cycle_ms=10, threads=0):
    """Plays the numbers 0, 1, ... of ten seeds, which with cycles of 10 ms are the situations of
    `ortung benchmark goalkeeper` for these seeds. Returns shares of goals and saves."""
    places = min(10, episodes)
    env = ortung.make_vec("goalkeeper-v0", places, striker=striker, cycle_ms=cycle_ms, threads=threads)
    observations, _ = env.reset(seed=seed)
    ended = np.zeros(places, int)
    counts = {"goal": 0, "saved": 0}
    wanted = np.full(places, episodes // places) + (np.arange(places) < episodes % places)
    while (ended < wanted).any():
        observations, rewards, terminated, truncated, _ = env.step(keeper.act(observations))
        open_ = ended < wanted
        counts["goal"] += int((open_ & (rewards < 0)).sum())
        counts["saved"] += int((open_ & (rewards > 0)).sum())
        ended += terminated | truncated
    env.close()
    return {"goals": counts["goal"] / episodes, "saved": counts["saved"] / episodes}


def train(striker="shot", iterations=200, environments=256, steps=64, seed=1, rate=1e-3, test=1000, every=10,
          threads=0, quiet=False):
    """Returns the keeper, and the curve: processor time [s], episodes, goals and saves after some iterations."""
    random = np.random.default_rng(seed)
    keeper = Keeper(random)
    env = ortung.make_vec("goalkeeper-v0", environments, striker=striker, threads=threads)
    state = env.reset(seed=10**6 * seed)[0], np.zeros(environments, bool)
    history = {"striker": striker, "seed": seed, "test": test, "cpu_s": [], "episodes": [], "goals": [], "saved": []}
    begin, episodes = time.process_time(), 0
    for iteration in range(iterations + 1):
        if iteration % every == 0 or iteration == iterations:
            spent = time.process_time() - begin
            found = evaluate(keeper, striker, 10**9, test, 20, threads)  # episodes that it is never trained in
            for key, value in (("cpu_s", round(spent, 1)), ("episodes", episodes), *found.items()):
                history[key].append(value)
            if not quiet:
                print(f"{iteration}: {spent:.0f} s of a processor, {episodes} episodes, goals {100 * found['goals']:.1f} %, "
                      f"saved {100 * found['saved']:.1f} %, spread {np.round(keeper.spread, 2)}", flush=True)
        if iteration == iterations:
            break
        played, state = play(env, keeper, state, steps, random)
        episodes += int(played[4].sum())
        learn_from(keeper, played, state[0], random, rate * (1 - iteration / iterations))
    env.close()
    return keeper, history


def picture(history, file):
    levels = [("blocking, goals: 67 %", "#c03030", 0.67)] if history["striker"] == "shot" else []
    curves.picture(file, f"goalkeeper-v0 against '{history['striker']}', shares of {history['test']} episodes it was not "
                   "trained in", history["cpu_s"], "processor time [s]",
                   [("goals", "#c03030", history["goals"]), ("saved", "#2060b0", history["saved"])], levels)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--striker", default="shot")
    parser.add_argument("--iterations", type=int, default=200)
    parser.add_argument("--environments", type=int, default=256)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rate", type=float, default=1e-3)
    parser.add_argument("--test", type=int, default=1000, help="episodes that measure it now and then")
    parser.add_argument("--policy", help="file of the weights (.npz)")
    parser.add_argument("--curve", help="JSON file with the curve")
    parser.add_argument("--picture", help="PNG file with the curve (needs python3-pil)")
    parser.add_argument("--evaluate", metavar="POLICY", help="trains nothing, but plays 1000 episodes of the benchmark")
    options = vars(parser.parse_args())
    if options["picture"] and options["evaluate"] or options["curve"] and options["evaluate"]:
        parser.error("--evaluate trains nothing, so there is no curve")
    policy, curve, file, judged = (options.pop(name) for name in ("policy", "curve", "picture", "evaluate"))
    if judged:
        keeper = load(judged)
    else:
        keeper, history = train(**options)
    if policy:
        keeper.save(policy)
    if curve:
        with open(curve, "w", encoding="utf-8") as out:
            json.dump(history, out, indent=1)
    if file:
        picture(history, file)
    found = evaluate(keeper, options["striker"])
    print(f"1000 episodes of the benchmark against {options['striker']}: goals {100 * found['goals']:.1f} of 100, "
          f"saved {100 * found['saved']:.1f}")


if __name__ == "__main__":
    main()
