#pragma once

#include <cstddef>

#include "Constant.hpp"

/// Constants of the folder search: how poses are found all over the field. Each comment says what
/// the constant is, its unit, and where its value comes from; docs/constants.md shows what changes
/// on recordings if it is halved or doubled.
namespace ortung::tuning {

/// Annealing: sharp readings weigh gradually more.
namespace annealing {

/// [share] Effective share of the set that each rise of the exponent leaves, as is usual in
/// sequential Monte Carlo (Del Moral et al. 2006).
ORTUNG_CONSTANT(annealing, kWorth, 0.5);
/// Greatest number of rises of the exponent, even if 1 is not reached. Cost.
ORTUNG_CONSTANT(annealing, kMostRises, 12);
/// Greatest number of poses from which the rise of the exponent is computed. Cost.
ORTUNG_CONSTANT(annealing, kMostTempered, std::size_t{65536});
/// [m] Sigma of the first Metropolis step in position: as wide as a peak of a laser's likelihood at
/// its base. Greatest sigma of a sample's kernel, too.
ORTUNG_CONSTANT(annealing, kCoarseMetres, 0.15);
/// [m] Sigma of the second step in position: as wide as that peak at its top.
ORTUNG_CONSTANT(annealing, kFineMetres, 0.05);
/// [rad] Sigma of the first step in heading.
ORTUNG_CONSTANT(annealing, kCoarseRadians, 0.08);
/// [rad] Sigma of the second step in heading.
ORTUNG_CONSTANT(annealing, kFineRadians, 0.02);
/// [m] Least sigma of a sample's kernel in position. Chosen by hand.
ORTUNG_CONSTANT(annealing, kLeastMetres, 0.06);
/// [rad] Least sigma of the kernel in heading. Chosen by hand.
ORTUNG_CONSTANT(annealing, kLeastRadians, 0.03);
/// [rad] Greatest sigma of the kernel in heading. Chosen by hand.
ORTUNG_CONSTANT(annealing, kMostRadians, 0.1);

}  // namespace annealing

/// FieldSearch: search of the whole field.
namespace field {

/// Standard deviation by which readings are blurred, in units of the spacing of poses. A uniform
/// distribution between neighbours has 0.29. A smaller value finds more where walls are near; 0.15
/// to 0.3 give about the same results.
ORTUNG_CONSTANT(field, kBlur, 0.2);
/// [m] Spacing below which poses are not divided any more: the rest is left to annealing.
ORTUNG_CONSTANT(field, kFinest, 0.1);
/// Number of candidates from which each one that is wanted is chosen: survivors, places, samples.
/// Cost.
ORTUNG_CONSTANT(field, kCandidates, std::size_t{4});
/// Greatest number of survivors per place, so that not all are from one wide peak. Cost.
ORTUNG_CONSTANT(field, kSurvivorsAPlace, std::size_t{12});
/// Number of steps of a climb. Cost.
ORTUNG_CONSTANT(field, kClimbs, 8);
/// Number of steps after which the step size is halved. Chosen by hand.
ORTUNG_CONSTANT(field, kClimbsAStep, 2);

}  // namespace field

/// Places that a search has found, in GlobalStart and Rivals.
namespace places {

/// [rad] Greatest difference in heading to either side of a place. Chosen by hand: half of
/// common::kPlaceRadians.
ORTUNG_CONSTANT(places, kTurn, 0.17);

}  // namespace places

/// GlobalStart: the first belief of a global localization.
namespace start {

/// [nats] Places that fit this much worse than the best one are dropped. Chosen by hand: more than
/// two readings can count.
ORTUNG_CONSTANT(start, kNats, 10.0);
/// [nats] If the likelihood at the edge of a ring is lower than at its centre by less than this,
/// the peak is wider than the ring: e^-3 is a twentieth.
ORTUNG_CONSTANT(start, kEdgeNats, 3.0);
/// Number of samples of all places together. Cost.
ORTUNG_CONSTANT(start, kSamples, std::size_t{2000});
/// Number of additional samples for each place. Cost.
ORTUNG_CONSTANT(start, kSamplesAPlace, std::size_t{50});
/// [share] Share of the belief below which a part is neglected. Cost.
ORTUNG_CONSTANT(start, kLeastShare, 1e-4);
/// Least number of candidates for each sample, all over the floor. Cost.
ORTUNG_CONSTANT(start, kFewestCandidates, 2.0);
/// Greatest total number of candidates, however large the building. Cost.
ORTUNG_CONSTANT(start, kMostCandidates, 1e5);
/// [ns] Time to draw a pose, without weighing it: random numbers, resampling. Cost.
ORTUNG_CONSTANT(start, kDrawNanoseconds, 150.0);

}  // namespace start

}  // namespace ortung::tuning
