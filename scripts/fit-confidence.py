#!/usr/bin/env python3
"""Fits the coefficients by which an estimate's quality is made (mcl/src/belief/BeliefTuning.hpp), and says how good they are.

  cmake --preset dev -B build/sweep -DORTUNG_SWEEP=ON -DORTUNG_TESTS=OFF && cmake --build build/sweep
  scripts/fit-confidence.py build/sweep/bin/ortung ../shared/data [--write docs/constants.md]

Logistic regression of "the position is less than kRight off" on what the filter knows, over the moments of recordings as they are,
with constructed faults and with kidnaps, where one place has nearly all of the belief (quality is that times the place's share). The
area under the curve, and how far claim and outcome of each disturbance are apart, are of each recording by coefficients of the
others. With --write the page says with which constants this was done. It takes some minutes.
"""
import argparse
import concurrent.futures
import os
import sys
import tempfile

import numpy

import constants
import evaluate
import results_page
import sweep

NAMES = ("kConstant", "kOfBelief", "kOfFitLately", "kOfLead", "kOfUnconfirmed", "kOfUnusual")
RECORDINGS = ("intel", "aces", "belgioioso", "freiburg-101", "freiburg-079", "fhw", "sena_telecom", "jarvis", "ds1", "ds2", "ds3", "ds6")
DISTURBANCES = ([], ["--teleport", "0.01"], ["--fault", "odometry=slip@100-105"], ["--fault", "readings=random:0.5"],
                ["--fault", "odometry=none@60-90"], ["--fault", "odometry=scale:1.2"])
LASER_ONLY = (["--fault", "readings=crowd@20-60"],)
WEIGHED = 2000  # moments that each run counts as, so that long ones are not all that counts
LEAST_SHARE = 0.99  # of the place in the belief
LONGEST_GAP, FASTEST = 2.5, 3.0  # [s], [m/s]: the truth between two moments is not known beyond


def truth_of(lines):
    """Stamps [us] and positions of the ground truth in a record's lines."""
    rows = [line.split() for line in lines if " reference/groundTruth/pose " in line and not line.startswith("#")]
    stamps = numpy.array([int(r[0]) for r in rows], dtype=float)
    places = numpy.array([[(int(w) - 2 ** 31) / 1000.0 for w in r[3:5]] for r in rows])
    return stamps, places


def errors(signs, stamps, places):
    """Of the moments whose truth is known: rows of signs, and by how much each is off [m]."""
    after = numpy.clip(numpy.searchsorted(stamps, signs[:, 0]), 1, len(stamps) - 1)
    span = 1e-6 * (stamps[after] - stamps[after - 1])
    share = numpy.clip(1e-6 * (signs[:, 0] - stamps[after - 1]) / numpy.maximum(span, 1e-6), 0.0, 1.0)[:, None]
    between = places[after - 1] + share * (places[after] - places[after - 1])
    way = numpy.linalg.norm(places[after] - places[after - 1], axis=1)
    known = (signs[:, 0] >= stamps[0]) & (signs[:, 0] <= stamps[-1]) & (span < LONGEST_GAP) & (way < FASTEST * numpy.maximum(span, 0.1))
    return signs[known], numpy.linalg.norm(signs[known, 1:3] - between[known], axis=1)


def kinds(name):
    """The disturbances of a recording, as options of `ortung eval`."""
    return DISTURBANCES + (LASER_ONLY if name in evaluate.LASER else ())


def moments(bench, name, options, reach):
    """Signs and outcomes of a run: columns as NAMES, the first one 1; and whether the position was less than `reach` off."""
    with tempfile.TemporaryDirectory() as folder:
        noted, record = os.path.join(folder, "signs"), os.path.join(folder, "run.txt")
        bench.evaluate(name, ["--record", record, *options], {"ORTUNG_SIGNS": noted})
        signs = numpy.loadtxt(noted, ndmin=2)
        with open(record) as file:
            truth = truth_of(file)
    # Of several estimates of a moment the last one counts.
    signs = signs[numpy.unique(signs[::-1, 0], return_index=True)[1] * -1 + len(signs) - 1]
    signs, off = errors(signs[signs[:, -1] > LEAST_SHARE], *truth)
    return numpy.column_stack([numpy.ones(len(signs)), signs[:, 3:2 + len(NAMES)]]), off < reach


def fit(rows, right, weights):
    """Coefficients of the greatest likelihood, by Newton's method."""
    b = numpy.zeros(rows.shape[1])
    for _ in range(50):
        p = claimed(b, rows)
        curvature = (rows * (weights * p * (1.0 - p))[:, None]).T @ rows + 1e-6 * numpy.eye(len(b))
        step = numpy.linalg.solve(curvature, rows.T @ (weights * (right - p)))
        b += step
        if numpy.abs(step).max() < 1e-9:
            break
    return b


def area(score, right):
    """Under the receiver operating characteristic: how often a right moment has the higher score."""
    order = numpy.argsort(score)
    ranks = numpy.empty(len(score))
    ranks[order] = numpy.arange(1, len(score) + 1)
    positive = right.sum()
    if positive in (0, len(right)):
        return None
    return (ranks[right].sum() - positive * (positive + 1) / 2) / (positive * (len(right) - positive))


def stack(runs):
    rows = numpy.concatenate([r for r, _ in runs])
    right = numpy.concatenate([y for _, y in runs])
    weights = numpy.concatenate([numpy.full(len(y), min(1.0, WEIGHED / max(1, len(y)))) for _, y in runs])
    return rows, right, weights


def loss(b, rows, right, weights):
    """Mean of -ln p(outcome) [nats]."""
    p = numpy.clip(claimed(b, rows), 1e-9, 1 - 1e-9)
    return -(weights * numpy.where(right, numpy.log(p), numpy.log(1 - p))).sum() / weights.sum()


def claimed(b, rows):
    return 1.0 / (1.0 + numpy.exp(-rows @ b))


def tenths(p):
    """Which moments' claims are in each tenth; the last one has its end."""
    return [(p >= low) & ((p < low + 0.1) | (low > 0.89)) for low in numpy.arange(0.0, 1.0, 0.1)]


def apart(p, right, weights):
    """Mean distance of claim and outcome, over tenths of the claim."""
    return sum(abs((weights[some] * (p[some] - right[some])).sum()) for some in tenths(p)) / weights.sum()


def describe(name, b, runs):
    rows, right, weights = stack(runs)
    p = claimed(b, rows)
    print("%s: %s" % (name, ", ".join("%s %.3g" % pair for pair in zip(NAMES, b))))
    print("  loss %.4f nats, area under the curve %.3f" % (loss(b, rows, right, weights), area(p, right)))
    for some in tenths(p):
        if some.sum() >= 100:
            print("  claimed %.2f, right %.2f (%d moments)" % (p[some].mean(), right[some].mean(), some.sum()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ortung", help="of a build with ORTUNG_SWEEP")
    parser.add_argument("data", help="folder with the recordings, see docs/results/data.md")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--out", default="out/sweep", help="folder for records and tables")
    parser.add_argument("--write", metavar="FILE", help="say in this page with which constants it was done")
    arguments = parser.parse_args()
    declared = constants.declared(sweep.ROOT)
    confidence = {c.name: c.value for c in declared if c.part == "confidence"}
    os.makedirs(arguments.out, exist_ok=True)
    bench = sweep.Bench(arguments.ortung, arguments.data, arguments.out, RECORDINGS)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        asked = {name: [pool.submit(moments, bench, name, options, confidence["kRight"]) for options in kinds(name)]
                 for name in RECORDINGS}
        runs = {name: [f.result() for f in futures] for name, futures in asked.items()}
    everything = [run for some in runs.values() for run in some]
    now = numpy.array([confidence[name] for name in NAMES])
    best = fit(*stack(everything))
    describe("in the code", now, everything)
    describe("fitted", best, everything)
    groups = {}
    for name, some in runs.items():
        others = [run for other, them in runs.items() if other != name for run in them]
        of_others = fit(*stack(others))
        rows, right, _ = stack(some)
        left_out = area(rows @ of_others, right)
        print("  %-14s right %.2f of the time%s" % (name, right.mean(), "" if left_out is None else ", area %.3f" % left_out))
        for options, (rows, right) in zip(kinds(name), some):
            kind = "%s, %s" % ("laser" if name in evaluate.LASER else "landmarks", " ".join(options).split("@")[0] or "as they are")
            groups.setdefault(kind, []).append((claimed(of_others, rows), right))
    for kind, pairs in groups.items():
        p, right, weights = stack(pairs)
        print("  %-50s right %.3f, claimed %.3f, apart %.3f" % (
            kind, numpy.average(right, weights=weights), numpy.average(p, weights=weights), apart(p, right, weights)))
    if arguments.write:
        results_page.rewrite(arguments.write, lambda page: constants.with_fit(page, declared))


if __name__ == "__main__":
    sys.exit(main())
