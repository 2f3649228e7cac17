#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "EndPointWeigher.hpp"
#include "ScanCost.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {

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
  EndPointWeigher endPoints;    ///< against an end-point field
};

}  // namespace ortung
