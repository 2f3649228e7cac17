#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "FaintLines.hpp"

namespace ortung {

/// Pixels of a scan line, and of the scan lines on both sides of it.
struct ScanLine {
  const std::uint8_t* first;   ///< red, green, blue of its first pixel
  const std::uint8_t* before;  ///< first pixel of the line before it
  const std::uint8_t* after;   ///< first pixel of the line after it
  std::size_t step;            ///< distance of pixels [bytes]
  int count;                   ///< number of pixels
};

/// Finds what is a little whiter than the floor on both sides, along one scan line. Floors are
/// green, so paint shows in red and blue. Their sum over three scan lines has little of the false
/// colours that a camera makes of thin lines. Not thread-safe: it keeps its buffers.
class FaintScan {
 public:
  /// @param floorSum number of pixels of the floor's colour before each pixel, size count + 1
  /// @return crossings, valid until the next call
  std::span<const FaintCrossing> find(const ScanLine& line, std::span<const std::int32_t> floorSum);

 private:
  struct Valley {
    int at;      ///< index at which the floor is darkest
    int values;  ///< its value there
  };
  void read(const ScanLine& line);
  std::optional<Valley> valleyBeside(int peak, int way) const;
  std::optional<FaintCrossing> crossingAt(int peak, std::span<const std::int32_t> floorSum) const;
  double sigmaOf(int from, int to) const;

  std::vector<std::int32_t> red_, green_,
      blue_;                        ///< sums over three lines, smoothed: 12 times a channel
  std::vector<std::int32_t> both_;  ///< red_ + blue_
  std::vector<std::uint8_t> isGreenish_;
  std::vector<std::int32_t> greenish_;  ///< number of greenish pixels before each pixel
  std::vector<std::int32_t> sum_;       ///< sum of both_ over these
  std::vector<std::int32_t> pairs_;     ///< number of pairs of them before each pixel
  std::vector<std::int32_t> changes_;   ///< sum of the differences of both_ within pairs
  std::vector<FaintCrossing> found_;
};

}  // namespace ortung
