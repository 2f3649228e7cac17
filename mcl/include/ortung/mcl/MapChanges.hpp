#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A cell of the field where readings have found something else than what was learned.
struct MapChange {
  enum class Kind : std::uint8_t {
    kGone,  ///< a wall was learned here, and beams go on behind it
    kNew    ///< beams end here, in front of what was learned
  };
  Kind kind = Kind::kGone;
  std::int32_t column = 0;  ///< it covers [column, column + 1) cells in x from the field's origin
  std::int32_t row = 0;     ///< likewise in y
  /// Middle of what was found in it, field frame [m]: of where the wall was learned, or of where
  /// beams end.
  double x = 0.0;
  double y = 0.0;
  std::uint32_t passes = 0;   ///< passes of the robot in which it was found so
  std::uint32_t lately = 0;   ///< how many of them came last, without one in which it was not
  std::uint32_t against = 0;  ///< passes in which it was found as learned
  std::uint32_t days = 0;     ///< days on which it was found so
  std::int64_t lastDay = 0;   ///< the last of them, by the readings' clock [days since its zero]
  /// Whether passes enough say so, and for other cells around it, too. Only then readings are
  /// weighed without the beams that meet it.
  bool isSure = false;

  bool operator==(const MapChange&) const = default;
};

/// Where the map no longer fits, as found by beams while tracking (docs/mcl.md, "Where the map no
/// longer fits").
struct ORTUNG_API MapChanges {
  static constexpr double kCell = 0.1;  ///< edge of a cell [m]
  static constexpr std::size_t kMost = 100'000;

  std::vector<MapChange> cells;  ///< by kind, row, column; each one once

  /// Returns the column or row of the cells that hold a coordinate. @param at [m], within 1e6
  static std::int32_t numberOf(double at) {
    return static_cast<std::int32_t>(std::floor(at / kCell));
  }
  /// Returns how many cells are sure to have changed so.
  std::size_t sure(MapChange::Kind kind) const;
  /// @throws std::invalid_argument naming the wrong cell: more than kMost, unordered or twice the
  ///   same, farther than 1e6 m away, a middle outside of the cell, counts that don't fit together
  void check() const;
};

}  // namespace ortung
