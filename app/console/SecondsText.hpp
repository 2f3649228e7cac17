#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "ortung/base/Time.hpp"

namespace ortung::app {

/// Returns a time in seconds with all its microseconds, e.g. "-1.500000".
inline std::string secondsText(Timestamp stamp) {
  constexpr Timestamp kSecond = 1'000'000;
  return fmt::format("{}{}.{:06}", stamp < 0 ? "-" : "", std::abs(stamp / kSecond),
                     std::abs(stamp % kSecond));
}

}  // namespace ortung::app
