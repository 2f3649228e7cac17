#pragma once

#include <cstdint>

#include "ortung/base/Export.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

/// Moves samples as a robot moves of whose motion nothing is known: anywhere, the variances growing
/// with time (driftMetres, driftRadians of @p config).
/// @param seconds since they were moved last, not negative
/// @param stream, first as of MotionModel::sampleMotion
ORTUNG_API void drift(const MclConfig& config, const MovableSamples& samples, double seconds,
                      std::uint64_t stream, std::uint64_t first);

}  // namespace ortung
