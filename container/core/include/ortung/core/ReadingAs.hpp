#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>

#include "ortung/core/SensorData.hpp"

namespace ortung {

/// Makes a feature of the format class Data that reads words of a format, set up by the format's
/// parameters; all other settings, such as noise, have their defaults.
/// @param words words of a typical reading, from which lists of landmarks take their identities
/// @throws std::invalid_argument for parameters that are missing or that no such feature has
template <class Data>
std::unique_ptr<Data> makeAs(const SensorId& id, const Pose2& mount, const Format& format,
                             std::span<const std::uint32_t> words) {
  if constexpr (requires { Data(id, mount, Data::configOf(format, words)); })
    return std::make_unique<Data>(id, mount, Data::configOf(format, words));
  else if constexpr (requires { Data(id, mount, typename Data::Config()); })
    return std::make_unique<Data>(id, mount, typename Data::Config());
  else if constexpr (requires { Data(id, typename Data::Config()); })
    return std::make_unique<Data>(id, typename Data::Config());
  else if constexpr (requires { Data(id, mount); })
    return std::make_unique<Data>(id, mount);
  else if constexpr (requires { Data(id); })
    return std::make_unique<Data>(id);
  else
    return std::make_unique<Data>();  // its name never changes
}

/// Makes a feature of the format class Data with the newest reading of another one that has this
/// format, whatever its class. Returns null if its format is another one, or it only claims to have
/// this one.
template <class Data>
std::unique_ptr<Data> like(const SensorData& feature) {
  const Format format = feature.format();
  if (format.name() != Data::kFormat) return nullptr;
  try {
    auto made = makeAs<Data>(feature.id(), feature.mount(), format, feature.getData());
    made->setData(feature.stamp(), feature.getData());
    return made;
  } catch (const std::invalid_argument&) {
    return nullptr;
  }
}

/// Returns the newest reading of a feature as the reading of the format class Data, whatever the
/// feature's own class is: any feature whose format() has that name is decoded from its words and
/// parameters. Returns nothing for another format, and before the first reading. The caller holds
/// the container's read lock if other threads set readings.
template <class Data>
std::optional<typename Data::Reading> readingAs(const SensorData& feature) {
  if (feature.sequence() == 0) return std::nullopt;
  if (const auto* own = dynamic_cast<const Data*>(&feature)) return own->reading();
  const std::unique_ptr<const Data> same = like<Data>(feature);
  if (!same) return std::nullopt;
  // A reading that points into words has to point into those of the feature.
  if constexpr (requires { Data::viewOf(feature.getData()); })
    return Data::viewOf(feature.getData());
  else
    return same->reading();
}

}  // namespace ortung
