#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Distance from the centre of each cell of a grid to the centre of the nearest marked one, exact:
/// the lower envelope of parabolas (P. Felzenszwalb, D. Huttenlocher, "Distance Transforms of
/// Sampled Functions", 2012). Not thread-safe.
class ORTUNG_API DistanceTransform {
 public:
  /// @param marked row by row; not 0: marked. Is not kept
  /// @pre marked.size() == columns * rows
  DistanceTransform(int columns, int rows, std::span<const std::uint8_t> marked);

  /// Squared distances of a row's cells, in cells; infinity if nothing is marked. Valid until the
  /// next call.
  std::span<const double> squaredOf(int row);

 private:
  void build(const int* height);
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_;
  int rows_;
  int far_;                    ///< more than any distance: nothing is marked in the column
  std::vector<int> inColumn_;  ///< of each cell, to the nearest marked one in its column
  std::vector<int> place_;     ///< column of each parabola
  std::vector<double> from_;   ///< where it begins to be the lowest
  std::size_t count_ = 0;      ///< of the parabolas
  std::vector<double> squared_;
};

}  // namespace ortung
