#pragma once

#include <cstddef>

#include "Constant.hpp"
#include "ortung/base/Time.hpp"

/// Constants of the folder filter: the update itself. Each comment says what the constant is, its
/// unit, and where its value comes from; docs/constants.md shows what changes on recordings if it
/// is halved or doubled.
namespace ortung::tuning {

/// Mcl: the public functions of the filter.
namespace present {

/// [s] Least time that counts as usual between two readings, so that the status does not flicker
/// with fast devices.
ORTUNG_CONSTANT(present, kLeastSilence, 0.5);
/// [share] Least ratio of the usual interval between readings to its last value, so that it falls
/// over a hundred updates: a camera that sees a landmark four times a second, then none for ten, is
/// not silent whenever it sees none. Chosen by hand.
ORTUNG_CONSTANT(present, kUsualKept, 0.99);
/// [us] Age up to which readings are of the present place. Chosen by hand: a typical robot travels
/// a metre in this time.
ORTUNG_CONSTANT(present, kPresent, Timestamp{500'000});

}  // namespace present

/// MclCorrection: weighing.
namespace correction {

/// Approximate number of times that annealing weighs each initial sample: once, and then a quarter
/// of them in two steps at each of eight exponents. Cost.
ORTUNG_CONSTANT(correction, kTimesWeighed, 5.0);
/// Effective sample size below which readings are far sharper than the belief, and are annealed.
/// Chosen by hand.
ORTUNG_CONSTANT(correction, kFewLeft, 25.0);

}  // namespace correction

/// MclPrediction: motion.
namespace prediction {

/// Least number of samples that are moved without odometry, if maxSamples permits it. Cost.
ORTUNG_CONSTANT(prediction, kSpreadSamples, std::size_t{4000});

}  // namespace prediction

}  // namespace ortung::tuning
