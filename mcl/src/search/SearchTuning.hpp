#pragma once

#include <cstddef>

#include "Constant.hpp"

/// Constants of the room search: how poses are found all over the field.
/// What each one is, its unit, and where its value comes from; docs/constants.md has what half of
/// it and twice as much change on recordings.
namespace ortung::tuning {

/// Annealing: sharp readings come in by degrees.
namespace annealing {

/// [share] Share of the set that each rise of the exponent leaves effective, as is usual in
/// sequential Monte Carlo (Del Moral et al. 2006).
ORTUNG_CONSTANT(annealing, kWorth, 0.5);
/// Most rises of the exponent, even if 1 is not reached. Cost.
ORTUNG_CONSTANT(annealing, kMostRises, 12);
/// Most poses that say how far the exponent may rise. Cost.
ORTUNG_CONSTANT(annealing, kMostTempered, std::size_t{65536});
/// [m] Sigma of the first Metropolis step: as wide as a hill of a laser's likelihood.
ORTUNG_CONSTANT(annealing, kCoarseMetres, 0.15);
/// [m] Sigma of the second step: as wide as its peak.
ORTUNG_CONSTANT(annealing, kFineMetres, 0.05);
/// [rad] Sigma of the first step's turns.
ORTUNG_CONSTANT(annealing, kCoarseRadians, 0.08);
/// [rad] Sigma of the second step's turns.
ORTUNG_CONSTANT(annealing, kFineRadians, 0.02);
/// [m] Least sigma of a position that steps are made for. By hand.
ORTUNG_CONSTANT(annealing, kLeastMetres, 0.06);
/// [m] Greatest sigma of a position. By hand.
ORTUNG_CONSTANT(annealing, kMostMetres, 0.15);
/// [rad] Least sigma of a heading. By hand.
ORTUNG_CONSTANT(annealing, kLeastRadians, 0.03);
/// [rad] Greatest sigma of a heading. By hand.
ORTUNG_CONSTANT(annealing, kMostRadians, 0.1);

}  // namespace annealing

/// FieldSearch: places all over the field.
namespace field {

/// Standard deviation of a pose that may be anywhere between its neighbours, in spacings: 0.29 if
/// all would be alike. Less finds more where walls are near, and 0.15 to 0.3 are much the same.
ORTUNG_CONSTANT(field, kBlur, 0.2);
/// [m] Poses nearer to each other than this are not divided any more: what is finer is left to
/// annealing.
ORTUNG_CONSTANT(field, kFinest, 0.1);
/// Times the survivors: those that they are chosen from. Cost.
ORTUNG_CONSTANT(field, kCrowd, std::size_t{4});
/// [m] Least distance of two places. By hand: what a wide hill spans.
ORTUNG_CONSTANT(field, kPlaceMetres, 0.5);
/// [rad] Least turn between two places. By hand.
ORTUNG_CONSTANT(field, kPlaceRadians, 0.35);
/// Survivors for each place that is wanted, so that a wide hill is not all that is left. Cost.
ORTUNG_CONSTANT(field, kSurvivorsAPlace, std::size_t{12});
/// Poses that climb for each place that is wanted. Cost.
ORTUNG_CONSTANT(field, kClimbing, std::size_t{4});
/// Steps of a climb. Cost.
ORTUNG_CONSTANT(field, kClimbs, 8);
/// Climbs until the step gets half as long. By hand.
ORTUNG_CONSTANT(field, kClimbsAStep, 2);

}  // namespace field

/// Places that a search has found, in GlobalStart and Rivals.
namespace places {

/// [m] Radius around a place in which samples are drawn. By hand: half of field::kPlaceMetres.
ORTUNG_CONSTANT(places, kRing, 0.25);
/// [rad] Turn to either side of a place. By hand: half of field::kPlaceRadians.
ORTUNG_CONSTANT(places, kTurn, 0.17);
/// Candidates for each sample. Cost.
ORTUNG_CONSTANT(places, kCandidates, 4.0);

}  // namespace places

/// GlobalStart: the first moment.
namespace start {

/// [nats] Places that fit so much worse than the best one are none. By hand: more than two
/// readings' worth.
ORTUNG_CONSTANT(start, kNats, 10.0);
/// [nats] A hill that has lost less than this at the edge of its ring is wider than the ring: a
/// twentieth of its peak.
ORTUNG_CONSTANT(start, kEdgeNats, 3.0);
/// Samples of all places together. Cost.
ORTUNG_CONSTANT(start, kSamples, std::size_t{2000});
/// Additional samples for each place. Cost.
ORTUNG_CONSTANT(start, kSamplesAPlace, std::size_t{50});
/// [share] Least share of the belief that is not neglected. Cost.
ORTUNG_CONSTANT(start, kLeastShare, 1e-4);
/// Least number of candidates for each sample, all over the floor. Cost.
ORTUNG_CONSTANT(start, kFewestCandidates, 2.0);
/// Most candidates together, however large the building. Cost.
ORTUNG_CONSTANT(start, kMostCandidates, 1e5);
/// [ns] Of drawing a pose, beside what readings take: random numbers, choices. Cost.
ORTUNG_CONSTANT(start, kDrawNanoseconds, 150.0);

}  // namespace start

}  // namespace ortung::tuning
