#pragma once

#include <cstddef>

#include "ortung/core/SensorData.hpp"
#include "ortung/mcl_served/LocalizedRobots.hpp"
#include "ortung/run/Localization.hpp"

namespace ortung {

/// The feature that is made only for who asks for it.
SensorId samplesId();

constexpr std::size_t kMostOrders = 64;  ///< that may wait for a filter; the oldest is dropped

/// How a localization that publishes is, by what it has published. Thread-safe.
LocalizationState stateOf(Localization& localization);

/// Tells a localization that it may be anywhere, or at a place; all else it ignores.
void obey(const LocalizationOrder& order, Localization& localization);

}  // namespace ortung
