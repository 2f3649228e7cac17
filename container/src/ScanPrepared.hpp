#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ScanCost.hpp"
#include "ortung/container/Formats.hpp"

namespace ortung {

inline constexpr std::size_t kRangeClasses = 8;  ///< of end points: sigma grows with range

/// A reading in the table's terms: levels, caps, end points.
struct ScanData::Prepared {
  // While learning rays.
  std::vector<std::uint8_t> levelOfWord;
  int views = 0;  ///< headings a turn; 0: not known yet
  // Against a ray table.
  std::vector<std::uint8_t> levels;  ///< by direction from the first beam on, padded
  std::vector<std::uint8_t> caps;
  std::array<std::uint8_t, kLevelDifferences> costs{};
  float nats = 0.0F;            ///< ln p of a cost of 1, exponent included (negative)
  std::uint32_t floorCost = 0;  ///< of a sample without expectation
  // Against an end-point field, in the robot frame.
  std::vector<float> endX;           ///< [m]
  std::vector<float> endY;           ///< [m]
  std::vector<const float*> endLog;  ///< entry of logByLevel for its range
  std::array<std::array<float, 256>, kRangeClasses> logByLevel{};
};

}  // namespace ortung
