#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "ortung/base/InstructionSet.hpp"

namespace ortung {

/// Two neighbours of an array of indices. Loops that look up much wait for loads, and one of these
/// takes both.
struct IndexPair {
  std::uint32_t first;
  std::uint32_t second;

  ORTUNG_INLINE static IndexPair at(const std::uint32_t* indices) {
    std::uint64_t both = 0;
    std::memcpy(&both, indices, sizeof both);
    const auto lower = static_cast<std::uint32_t>(both);
    const auto upper = static_cast<std::uint32_t>(both >> 32);
    if constexpr (std::endian::native == std::endian::little)
      return {lower, upper};
    else
      return {upper, lower};
  }
};

}  // namespace ortung
