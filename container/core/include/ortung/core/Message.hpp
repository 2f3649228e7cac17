#pragma once

#include <cstdint>
#include <vector>

#include "ortung/base/Time.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// One reading in transit: what a record holds in a line and the server sends.
struct Message {
  Timestamp stamp = 0;               ///< time at which it was taken [us]
  SensorId id;                       ///< feature that it is a reading of
  std::vector<std::uint32_t> words;  ///< content, as the feature's format() says

  bool operator==(const Message&) const = default;
};

}  // namespace ortung
