#pragma once

#include <cstddef>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

/// Samples of a normal distribution that somebody else knows the pose by.
/// @param covariance what six digits of it leave is enough
/// @throws std::invalid_argument saying what is wrong: a number that is not finite, a variance
///   below zero, no symmetry, or errors that depend on each other more than can be
ORTUNG_API SampleSet normalSamples(const Pose2& pose, const PoseCovariance& covariance,
                                   std::size_t n, Random random);

/// Moves all samples alike, each in its own frame.
ORTUNG_API void shift(SampleSet& samples, const Pose2& change);

}  // namespace ortung
