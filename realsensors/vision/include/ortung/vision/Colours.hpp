#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/camera/ImageData.hpp"

namespace ortung {

/// A colour as a painter names it.
struct Hsv {
  double hue = 0.0;         ///< [degrees], in [0, 360)
  double saturation = 0.0;  ///< in [0, 1]
  double value = 0.0;       ///< brightness, in [0, 1]
};
ORTUNG_API Hsv toHsv(std::uint8_t red, std::uint8_t green, std::uint8_t blue);

/// Which colours belong to one kind of thing.
struct ColourRange {
  double hue = 0.0;           ///< middle [degrees]
  double hueTolerance = 0.0;  ///< to either side [degrees]
  double minSaturation = 0.0;
  double minValue = 0.0;
  double maxValue = 1.0;

  bool has(const Hsv& colour) const;
};

/// Colours of a place in its light. The floor is that of most pixels; lines are what is whiter than
/// the floor beside it, so they need no colour of their own.
struct Colours {
  ColourRange floor{.hue = 130.0, .hueTolerance = 50.0, .minSaturation = 0.2, .minValue = 0.08};
  ColourRange ball{.hue = 48.0, .hueTolerance = 16.0, .minSaturation = 0.35, .minValue = 0.3};
};

/// The colours of one or more pictures of a field: the floor's green is looked for in their lower
/// halves. What it can't find stays as it is by default.
ORTUNG_API Colours findColours(std::span<const ImageView> images);

/// Reads the table `colours` of a [[sensor]]. @throws ConfigError
ORTUNG_API Colours readColours(const Parameters& colours);
/// The table's lines that make them again.
ORTUNG_API std::string toToml(const Colours& colours);

/// Kinds of things that a pixel's colour may mean, as bits.
enum class ColourClass : std::uint8_t { kNone = 0, kFloor = 1, kBall = 2 };

/// The classes of all colours, 32 steps a channel: one look-up a pixel.
class ORTUNG_API ColourTable {
 public:
  explicit ColourTable(const Colours& colours);
  /// Bits of ColourClass. @param rgb three bytes
  std::uint8_t at(const std::uint8_t* rgb) const {
    return table_[static_cast<std::size_t>(((rgb[0] >> 3) << 10) | ((rgb[1] >> 3) << 5) |
                                           (rgb[2] >> 3))];
  }
  bool isFloor(const std::uint8_t* rgb) const { return (at(rgb) & 1U) != 0; }
  bool isBall(const std::uint8_t* rgb) const { return (at(rgb) & 2U) != 0; }

 private:
  std::array<std::uint8_t, 32 * 32 * 32> table_{};
};

}  // namespace ortung
