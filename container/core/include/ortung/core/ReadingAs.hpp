#pragma once

#include <memory>
#include <optional>

#include "ortung/core/SensorData.hpp"

namespace ortung {

/// The newest reading of a feature of the format whose class is T, whatever its own class is: any
/// feature whose format() has that name gives it, from its words and parameters. Nothing for one of
/// another format, and before the first reading. Under the container's read lock if others set
/// readings.
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
