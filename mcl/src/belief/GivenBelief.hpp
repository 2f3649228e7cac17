#pragma once

#include <cstddef>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/mcl/SampleSet.hpp"

namespace ortung {

/// Draws samples of a pose that the caller gives as a normal distribution.
/// @param covariance it may be singular, and rounded to six digits
/// @throws std::invalid_argument saying what is wrong: a number that is not finite, a negative
///   variance, a matrix that is not symmetric, or correlations that no distribution can have
ORTUNG_API SampleSet normalSamples(const Pose2& pose, const PoseCovariance& covariance,
                                   std::size_t n, Random random);

/// Applies the same change of pose to all samples, each in its own frame.
ORTUNG_API void shift(SampleSet& samples, const Pose2& change);

}  // namespace ortung
