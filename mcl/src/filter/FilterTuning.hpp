#pragma once

#include <cstddef>

#include "Constant.hpp"
#include "ortung/base/Time.hpp"

/// Constants of the room filter: the update itself.
/// What each one is, its unit, and where its value comes from; docs/constants.md has what half of
/// it and twice as much change on recordings.
namespace ortung::tuning {

/// Mcl: what is asked of the filter.
namespace present {

/// [s] Least time that counts as usual between two readings: status does not flicker with fast
/// devices.
ORTUNG_CONSTANT(present, kLeastSilence, 0.5);
/// [us] What was read so shortly ago is of the present place. By hand: a robot of the field goes a
/// metre in it.
ORTUNG_CONSTANT(present, kPresent, Timestamp{500'000});

}  // namespace present

/// MclCorrection: weighing.
namespace correction {

/// That a sample is weighed until annealed readings are in, about: a quarter of them climbs eight
/// times in two steps. Cost.
ORTUNG_CONSTANT(correction, kTimesWeighed, 5.0);
/// Effective samples below which readings are far sharper than the belief, and are annealed. By
/// hand.
ORTUNG_CONSTANT(correction, kFewLeft, 25.0);

}  // namespace correction

/// MclPrediction: motion.
namespace prediction {

/// [share] Share of the average interval between updates that is kept: over ten updates.
ORTUNG_CONSTANT(prediction, kIntervalKept, 0.9);
/// Least number of samples where nobody knows how the robot moved, if the set may be so large.
/// Cost.
ORTUNG_CONSTANT(prediction, kSpreadSamples, std::size_t{4000});

}  // namespace prediction

}  // namespace ortung::tuning
