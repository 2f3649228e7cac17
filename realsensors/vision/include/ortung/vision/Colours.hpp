#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/camera/ImageData.hpp"

namespace ortung {

/// A colour by hue, saturation and value.
struct Hsv {
  double hue = 0.0;         ///< hue [degrees], in [0, 360); 0: red
  double saturation = 0.0;  ///< saturation, in [0, 1]; 0: grey
  double value = 0.0;       ///< brightness, in [0, 1]
};
/// Converts a colour of 8 bits a channel.
ORTUNG_API Hsv toHsv(std::uint8_t red, std::uint8_t green, std::uint8_t blue);

/// The colours that belong to one kind of thing.
struct ColourRange {
  double hue = 0.0;            ///< middle of the hues [degrees]
  double hueTolerance = 0.0;   ///< greatest difference from that hue [degrees]
  double minSaturation = 0.0;  ///< least saturation, in [0, 1]
  double minValue = 0.0;       ///< least brightness, in [0, 1]
  double maxValue = 1.0;       ///< greatest brightness, in [0, 1]
  double maxSaturation = 1.0;  ///< greatest saturation, in [0, 1]

  /// Whether the colour is in this range.
  bool has(const Hsv& colour) const;
};

/// The colours of a field in its light. Lines are what is whiter than the floor beside it, so they
/// need no range of colours.
struct Colours {
  ColourRange floor{.hue = 130.0, .hueTolerance = 50.0, .minSaturation = 0.2, .minValue = 0.08};
  /// Yellow, in any light.
  ColourRange ball{.hue = 49.0, .hueTolerance = 19.0, .minSaturation = 0.18, .minValue = 0.2};
  /// Colours that a worn ball, or one in bright light, may have besides; nothing: it has none.
  std::optional<ColourRange> paleBall = ColourRange{.hue = 40.0,
                                                    .hueTolerance = 22.0,
                                                    .minSaturation = 0.15,
                                                    .minValue = 0.2,
                                                    .maxSaturation = 0.5};
};

/// Estimates the colours of a field from pictures of it: the floor's green is searched in their
/// lower halves. Colours that are not found keep their defaults.
ORTUNG_API Colours findColours(std::span<const ImageView> images);

/// Reads the table `colours` of a [[sensor]]. @throws ConfigError for values out of range
ORTUNG_API Colours readColours(const Parameters& colours);
/// Formats colours as the lines of that table.
ORTUNG_API std::string toToml(const Colours& colours);

/// Classes of things that a pixel's colour may belong to, as bits.
enum class ColourClass : std::uint8_t { kNone = 0, kFloor = 1, kBall = 2 };

/// A look-up table of the classes of all colours, with 32 levels a channel. Immutable once made.
class ORTUNG_API ColourTable {
 public:
  /// Computes the classes of all 32768 colours.
  explicit ColourTable(const Colours& colours);
  /// Returns the classes of a colour as bits of ColourClass. @param rgb red, green, blue
  std::uint8_t at(const std::uint8_t* rgb) const {
    return table_[static_cast<std::size_t>(((rgb[0] >> 3) << 10) | ((rgb[1] >> 3) << 5) |
                                           (rgb[2] >> 3))];
  }
  /// Whether a colour is the floor's. @param rgb red, green, blue
  bool isFloor(const std::uint8_t* rgb) const { return (at(rgb) & 1U) != 0; }
  /// Whether a colour is the ball's. @param rgb red, green, blue
  bool isBall(const std::uint8_t* rgb) const { return (at(rgb) & 2U) != 0; }

 private:
  std::array<std::uint8_t, 32 * 32 * 32> table_{};
};

}  // namespace ortung
