#pragma once

#include <cstdint>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// The coarse grid of positions with which a search of the field begins. It takes some time in a
/// large field, so it is made once, before anything is searched.
struct ORTUNG_API FieldCover {
  static constexpr double kSpacing = 0.3;  ///< usual distance of neighbours [m]

  /// Divides the floor into square blocks of cells, and takes from each the standable cell nearest
  /// to its centre, so that narrow places are covered, too.
  /// @param metres edge of the blocks; rounded to cells
  explicit FieldCover(const FieldRegion& region, double metres = kSpacing);

  double spacing = 0.0;              ///< edge of the blocks [m]
  std::vector<std::uint32_t> cells;  ///< of the region
};

}  // namespace ortung
