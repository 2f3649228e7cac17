#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

/// Words of shares and probabilities [1/10000].
namespace ortung {

inline constexpr std::uint32_t kWholeShare = 10'000;

/// Returns the word of a share, limited to [0, 1]; 0 for NaN.
inline std::uint32_t shareWord(double share) {
  if (std::isnan(share)) return 0;
  return static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * kWholeShare));
}

inline double shareOf(std::uint32_t word) { return static_cast<double>(word) / kWholeShare; }

/// @throws std::invalid_argument for a word above the greatest
inline void checkAtMost(const char* what, std::uint32_t word, std::uint32_t most) {
  if (word <= most) return;
  throw std::invalid_argument("found the " + std::string(what) + " " + std::to_string(word) +
                              ", expected 0 to " + std::to_string(most));
}

}  // namespace ortung
