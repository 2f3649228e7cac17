#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Computes the exact distance from the centre of each cell of a grid to the centre of the nearest
/// marked one, by the lower envelope of parabolas (P. Felzenszwalb, D. Huttenlocher, "Distance
/// Transforms of Sampled Functions", 2012). Not thread-safe.
class ORTUNG_API DistanceTransform {
 public:
  /// @param marked row by row; not 0: marked. Is not kept
  /// @pre marked.size() == columns * rows
  DistanceTransform(int columns, int rows, std::span<const std::uint8_t> marked);

  /// Returns the squared distances of a row's cells [cells^2]; infinity if nothing is marked. The
  /// span is valid until the next call.
  std::span<const double> squaredOf(int row);

 private:
  void build(const int* height);
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_;
  int rows_;
  int far_;  ///< more than any distance: nothing is marked in the column
  /// Distance to the nearest marked cell in the column, by cell [cells].
  std::vector<int> inColumn_;
  std::vector<int> place_;    ///< column of each parabola
  std::vector<double> from_;  ///< column where each parabola begins to be the lowest
  std::size_t count_ = 0;     ///< number of parabolas in the envelope
  std::vector<double> squared_;
};

}  // namespace ortung
