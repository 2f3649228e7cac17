#pragma once

#include <memory>
#include <span>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {

/// Returns whether a feature has a format of this name (FormatNames.hpp).
ORTUNG_API bool isOf(const SensorData& feature, const char* format);

/// Makes a feature that reads words of a format, set up by the format's parameters; all other
/// settings, such as noise, have their defaults. Returns null for formats of other rooms and of
/// plugins.
/// @param words words of a typical reading, from which lists of landmarks take their identities
/// @throws std::invalid_argument for parameters that are missing or that no such feature has
ORTUNG_API std::unique_ptr<SensorData> featureOf(const SensorId& id, const Pose2& mount,
                                                 const Format& format,
                                                 std::span<const std::uint32_t> words = {});

/// Returns beams and ranges of a `scan`. @throws std::invalid_argument for parameters that no scan
/// has
ORTUNG_API ScanData::Config scanOf(const Format& format);

/// Returns the first of the features that has this format, or null.
ORTUNG_API const SensorData* firstOf(std::span<const std::unique_ptr<SensorData>> features,
                                     const char* format);

}  // namespace ortung
