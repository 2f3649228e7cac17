#pragma once

#include <cstdint>
#include <vector>

#include "ortung/base/Time.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// One reading on its way: what a record holds in a line and the server sends.
struct Message {
  Timestamp stamp = 0;
  SensorId id;
  std::vector<std::uint32_t> words;

  bool operator==(const Message&) const = default;
};

}  // namespace ortung
