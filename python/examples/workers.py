#!/usr/bin/env python3
"""Steps of an environment in a second: by threads of one process, and in several processes.

A VectorEnv steps all its environments by one call on threads. Processes are for learners whose own Python is the
larger part of the work; each here has a VectorEnv of one thread, and gives its observations through a pipe, as
Gymnasium's AsyncVectorEnv does for single environments.

    python3 workers.py --environments 64 --workers 2
"""
import argparse
import multiprocessing
import time

import numpy as np

import ortung


def play(pipe, env_id, environments, seed):
    """A worker: takes actions and gives observations, rewards and ends, until it gets None."""
    env = ortung.VectorEnv(env_id, environments, threads=1)
    pipe.send(env.reset(seed=seed)[0])
    while (actions := pipe.recv()) is not None:
        pipe.send(env.step(actions)[:4])


class Processes:
    """Environments in processes, each with a share of them."""

    def __init__(self, env_id, environments, workers):
        shares = np.diff(np.linspace(0, environments, workers + 1).astype(int))
        self.bounds = np.cumsum(shares)[:-1]
        self.pipes, self.workers = [], []
        for i, share in enumerate(shares):
            here, there = multiprocessing.Pipe()
            self.pipes.append(here)
            seed = int(shares[:i].sum())
            self.workers.append(multiprocessing.Process(target=play, args=(there, env_id, int(share), seed), daemon=True))
            self.workers[-1].start()
        self.observations = np.concatenate([pipe.recv() for pipe in self.pipes])

    def step(self, actions):
        for pipe, share in zip(self.pipes, np.split(actions, self.bounds)):
            pipe.send(share)
        found = [pipe.recv() for pipe in self.pipes]
        self.observations = np.concatenate([one[0] for one in found])

    def close(self):
        for pipe, worker in zip(self.pipes, self.workers):
            pipe.send(None)
            worker.join()


class Threads:
    """The same by one VectorEnv on threads."""

    def __init__(self, env_id, environments, workers):
        self.env = ortung.VectorEnv(env_id, environments, threads=workers, copy=False)
        self.observations = self.env.reset(seed=0)[0]

    def step(self, actions):
        self.observations = self.env.step(actions)[0]

    def close(self):
        self.env.close()


def steps_per_second(kind, env_id, environments, workers, seconds):
    playing = kind(env_id, environments, workers)
    steps, begin = 0, time.perf_counter()
    while time.perf_counter() - begin < seconds:
        playing.step(ortung.heuristic(env_id, 0, playing.observations))
        steps += environments
    rate = steps / (time.perf_counter() - begin)
    playing.close()
    return rate


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--id", default="goalkeeper-v0")
    parser.add_argument("--environments", type=int, nargs="+", default=[64, 256])
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--seconds", type=float, default=5.0, help="of each measurement")
    options = parser.parse_args()
    print("| environments | workers | threads [steps/s] | processes [steps/s] |\n|---|---|---|---|")
    for environments in options.environments:
        for workers in sorted({min(w, environments) for w in options.workers}):
            rates = [steps_per_second(kind, options.id, environments, workers, options.seconds) for kind in (Threads, Processes)]
            print("| %d | %d | %d | %d |" % (environments, workers, *rates), flush=True)


if __name__ == "__main__":
    main()
