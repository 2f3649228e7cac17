#!/usr/bin/env python3
"""A small learner: cross-entropy search for a better goalkeeper than one that blocks.

The keeper goes to a place on its line: a weighted sum of four numbers that it makes of what its camera
has seen (features()). It begins with the weights (1, 0, 0, 0), which are the policy "blocking". Each
generation draws candidates around the mean, plays the same episodes with all of them, and takes mean and
spread of the best.

    python3 cross_entropy.py --curve curve.json --picture curve.png
"""
import argparse
import json

import numpy as np

import curves
import ortung

LINE, REACH, SPEED, TURN = 0.5, 0.75, 1.5, 3.0  # [m], [m], [m/s], [rad/s], see docs/learning.md
START = np.array([1.0, 0.0, 0.0, 0.0])
SPREAD = np.array([0.5, 0.3, 0.3, 0.5])


def features(o):
    """Returns (N, 4): the y at which a straight line from the ball to the goal's middle crosses the keeper's
    line; the ball's y; its velocity in y; how far it moves in y until it is at the line. [m], [m/s]"""
    ball = o[:, 8:23].reshape(-1, 5, 3)  # newest first: x, y, age
    x, y, age = ball[:, 0].T
    seen = (ball[:, :, 2] < 1.0).astype(float)
    t = -ball[:, :, 2] * seen
    n = np.maximum(seen.sum(1), 1.0)
    mean_t = (t * seen).sum(1) / n
    spread = np.maximum((seen * (t - mean_t[:, None]) ** 2).sum(1), 1e-3)
    v = [(seen * (t - mean_t[:, None]) * ball[:, :, k]).sum(1) / spread for k in (0, 1)]
    blocking = y * LINE / np.maximum(x, LINE)
    comes = (v[0] < -0.7) & (x > LINE) & (age < 1.0)
    lead = np.where(comes, (LINE - x) / np.minimum(v[0], -0.7) * v[1], 0.0)
    return np.stack([blocking, y, np.clip(v[1], -5, 5), np.clip(lead, -2, 2)], 1) * (age < 1.0)[:, None]


def act(o, weights):
    """Returns actions (N, 2) of a keeper that drives along its line. weights: (N, 4)"""
    wanted = np.clip((features(o) * weights).sum(1), -REACH, REACH)
    away = wanted - o[:, 1]
    across = np.where(o[:, 3] >= 0, 1.0, -1.0)
    fast = np.minimum(np.sqrt(3.5 * np.abs(away)), 8 * np.abs(away))
    tilt = np.clip(LINE - o[:, 0], -0.2, 0.2) * np.where(away * across > 0, 1, -1)
    error = across * (np.pi / 2 - tilt) - np.arctan2(o[:, 3], o[:, 2])
    error = (error + np.pi) % (2 * np.pi) - np.pi
    forward = np.clip(np.sign(away) * fast * across / SPEED, -1, 1)
    return np.stack([forward, np.clip(4 * error / TURN, -1, 1)], 1).astype(np.float32)


def play(env, weights, seeds):
    """Plays an episode in each environment. Returns its result: 1 saved, -1 goal, 0 neither."""
    o, _ = env.reset(seed=seeds)
    result = np.zeros(env.num_envs)
    running = np.ones(env.num_envs, bool)
    while running.any():
        o, rewards, terminated, truncated, _ = env.step(act(o, weights))
        result += rewards * running
        running &= ~(terminated | truncated)
    return result


def evaluate(env, weights, first):
    results = play(env, np.tile(weights, (env.num_envs, 1)), list(range(first, first + env.num_envs)))
    return {"goals": float((results < 0).mean()), "saved": float((results > 0).mean())}


def train(striker="shot", generations=15, candidates=32, episodes=64, test=1000, seed=1, quiet=False):
    random = np.random.default_rng(seed)
    mean, spread = START.copy(), SPREAD.copy()
    env = ortung.make_vec("goalkeeper-v0", candidates * episodes, striker=striker)
    judge = ortung.make_vec("goalkeeper-v0", test, striker=striker)
    history = {"striker": striker, "seed": seed, "weights": [], "goals": [], "saved": [], "score": []}
    for generation in range(generations + 1):
        found = evaluate(judge, mean, 10**9)  # episodes that the search never sees
        history["weights"].append([round(float(w), 4) for w in mean])
        history["goals"].append(found["goals"])
        history["saved"].append(found["saved"])
        history["score"].append(found["saved"] - found["goals"])
        if not quiet:
            print(f"generation {generation}: goals {100 * found['goals']:.1f} %, saved "
                  f"{100 * found['saved']:.1f} %, weights {np.round(mean, 2)}", flush=True)
        if generation == generations:
            break
        drawn = mean + spread * random.standard_normal((candidates, len(mean)))
        # All candidates play the same episodes, each generation others.
        seeds = [seed * 10**6 + generation * episodes + e for e in range(episodes)] * candidates
        scores = play(env, np.repeat(drawn, episodes, 0), seeds).reshape(candidates, episodes).mean(1)
        best = drawn[np.argsort(-scores)[:max(candidates // 4, 2)]]
        mean, spread = best.mean(0), best.std(0) + 0.02
    return history


def picture(history, file):
    levels = [(f"blocking, {key}: {100 * history[key][0]:.0f} %", colour, history[key][0])
              for key, colour in (("goals", "#c03030"), ("saved", "#2060b0"))]
    curves.picture(file, f"goalkeeper-v0 against '{history['striker']}', shares of {history['test']} episodes it was not "
                   "trained in", range(len(history["goals"])), "generation",
                   [("goals", "#c03030", history["goals"]), ("saved", "#2060b0", history["saved"])], levels)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--striker", default="shot")
    parser.add_argument("--generations", type=int, default=15)
    parser.add_argument("--candidates", type=int, default=32)
    parser.add_argument("--episodes", type=int, default=64, help="of each candidate in a generation")
    parser.add_argument("--test", type=int, default=1000, help="episodes that measure the mean")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--curve", help="JSON file with the curve")
    parser.add_argument("--picture", help="PNG file with the curve (needs python3-pil)")
    options = vars(parser.parse_args())
    curve, file = options.pop("curve"), options.pop("picture")
    history = train(**options)
    history["test"] = options["test"]
    if curve:
        with open(curve, "w", encoding="utf-8") as out:
            json.dump(history, out, indent=1)
    if file:
        picture(history, file)


if __name__ == "__main__":
    main()
