#pragma once

#include <memory>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {

/// Whether a feature is of a format (FormatNames.hpp).
ORTUNG_API bool isOf(const SensorData& feature, const char* format);

/// A feature that reads words of a format, as far as its parameters tell how: what to learn, noise
/// and the like are as usual. Null for formats of other rooms and of plugins.
/// @param words of readings to come, from which lists of landmarks take their identities
/// @throws std::invalid_argument for parameters that are missing or that no such feature has
ORTUNG_API std::unique_ptr<SensorData> featureOf(const SensorId& id, const Pose2& mount,
                                                 const Format& format,
                                                 std::span<const std::uint32_t> words = {});

/// Beams and ranges of a `scan`. @throws std::invalid_argument for parameters that no scan has
ORTUNG_API ScanData::Config scanOf(const Format& format);

/// The first feature of the container that is of a format, or null.
ORTUNG_API const SensorData* firstOf(std::span<const std::unique_ptr<SensorData>> features,
                                     const char* format);

}  // namespace ortung
