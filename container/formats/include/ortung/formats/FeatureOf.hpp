#pragma once

#include <memory>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// Returns whether a feature has a format of this name (FormatNames.hpp).
ORTUNG_API bool isOf(const SensorData& feature, const char* format);

/// Makes a feature that reads words of a format, see makeAs() (core/ReadingAs.hpp). Returns null
/// for formats of other rooms and of plugins.
/// @throws std::invalid_argument for parameters that are missing or that no such feature has
ORTUNG_API std::unique_ptr<SensorData> featureOf(const SensorId& id, const Pose2& mount,
                                                 const Format& format,
                                                 std::span<const std::uint32_t> words = {});

/// Returns the first of the features that has this format, or null.
ORTUNG_API const SensorData* firstOf(std::span<const std::unique_ptr<SensorData>> features,
                                     const char* format);

}  // namespace ortung
