#pragma once

#include <memory>
#include <optional>

#include "ortung/core/SensorData.hpp"

namespace ortung {

/// Returns the newest reading of a feature as the reading of the format class T, whatever the
/// feature's own class is: any feature whose format() has that name is decoded from its words and
/// parameters. Returns nothing for another format, and before the first reading. The caller holds
/// the container's read lock if other threads set readings.
template <class T>
std::optional<typename T::Reading> readingAs(const SensorData& feature) {
  if (feature.sequence() == 0) return std::nullopt;
  if (const auto* own = dynamic_cast<const T*>(&feature)) return own->reading();
  if constexpr (requires { T::like(feature); }) {
    if (const std::unique_ptr<const T> same = T::like(feature)) return same->reading();
  }
  return std::nullopt;
}

}  // namespace ortung
