#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Format.hpp"

namespace ortung {

/// What a word of a reading means; each comment gives its text in the parameter `row`.
enum class ValueKind : std::uint8_t {
  kOther,     ///< other, or an unknown text
  kIdentity,  ///< identity
  kRange,     ///< range_mm
  kBearing,   ///< bearing_cdeg: 1/100 degree + 18000, in the sensor's frame
  kX,         ///< x_mm: mm + 2^31, in the robot frame
  kY,         ///< y_mm
  kHeading,   ///< heading_cdeg: 1/100 degree + 18000
  kRadius,    ///< radius_mm
  kColour,    ///< colour: 0xRRGGBB, or 2^24 for none
};

/// Returns whether a word of this kind is an angle.
inline bool isAngle(ValueKind kind) {
  return kind == ValueKind::kBearing || kind == ValueKind::kHeading;
}
/// Returns whether a word of this kind is a length.
inline bool isLength(ValueKind kind) {
  return kind == ValueKind::kRange || kind == ValueKind::kX || kind == ValueKind::kY ||
         kind == ValueKind::kRadius;
}

/// One value in the words of a reading.
struct WordValue {
  std::size_t word = 0;   ///< index of the word in the reading
  std::size_t entry = 0;  ///< number of the beam, sighting or row that it belongs to
  ValueKind kind = ValueKind::kOther;
  /// [m], [rad], or a number; NaN: not valid; infinite: nothing within range.
  double value = 0.0;
  double least = 0.0;  ///< least value that such a sensor can read
  double most = 0.0;   ///< greatest value it can read, or a kind's count; least == most: not known
};

/// How finely a feature's expectation resolves poses.
enum class ExpectationGrain : std::uint8_t {
  kCells,               ///< it is constant within a cell, or interpolated between centres
  kCellsAndDirections,  ///< it is the same within a cell and within a direction of the tables
  kExact,               ///< finer than that
};

/// Returns what each word of a row means, by the parameter `row` of a format; empty if it has none.
ORTUNG_API std::vector<ValueKind> rowOf(const Format& format);
/// Returns the values of all rows, row by row; none if the format has no `row`. Words of a last row
/// that is not complete are left out. Ranges are up to the parameter `max_m`, or 20 m.
ORTUNG_API std::vector<WordValue> valuesOfRows(const Format& format,
                                               std::span<const std::uint32_t> words);
/// Returns whether the value at @p index of lengthsAndAngles() is an angle.
ORTUNG_API bool isAngleOfRow(const Format& format, std::size_t index);
/// Returns those values that are lengths [m] or angles [rad], in their order.
ORTUNG_API std::vector<double> lengthsAndAngles(std::span<const WordValue> values);
/// Returns the word of a value in a row. @throws std::invalid_argument if it is not finite
ORTUNG_API std::uint32_t wordOf(const WordValue& value);

}  // namespace ortung
