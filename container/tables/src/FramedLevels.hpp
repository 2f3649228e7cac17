#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/tables/EndPointField.hpp"

namespace ortung {

/// Finds cells in a copy of a grid that has one column and one row more.
class FramedLookup {
 public:
  FramedLookup() = default;
  explicit FramedLookup(const FieldGrid& grid)
      : originX_(static_cast<float>(grid.originX)),
        originY_(static_cast<float>(grid.originY)),
        perMetre_(static_cast<float>(1.0 / grid.cell)),
        columns_(static_cast<float>(grid.columns)),
        rows_(static_cast<float>(grid.rows)),
        stride_(static_cast<std::uint32_t>(grid.columns) + 1) {}

  /// The same cell as CellLookup's, or one of the frame for a place outside of the grid and for
  /// NaN. Without a branch, so that loops over it vectorize. @pre |x|, |y| < 2^31 cells, or NaN
  ORTUNG_INLINE std::uint32_t index(float x, float y) const {
    const float column = (x - originX_) * perMetre_;
    const float row = (y - originY_) * perMetre_;
    const float leftmost = column < columns_ ? column : columns_;
    const float lowest = row < rows_ ? row : rows_;
    const float lesser = column < row ? column : row;
    const std::uint32_t cell =
        static_cast<std::uint32_t>(static_cast<std::int32_t>(lowest)) * stride_ +
        static_cast<std::uint32_t>(static_cast<std::int32_t>(leftmost));
    return lesser >= 0.0F ? cell : stride_ - 1;
  }

 private:
  float originX_ = 0.0F;
  float originY_ = 0.0F;
  float perMetre_ = 1.0F;
  float columns_ = 0.0F;
  float rows_ = 0.0F;
  std::uint32_t stride_ = 1;
};

/// The levels of an end-point field within a frame of cells that are far from every end point: for
/// loops over points that may lie anywhere.
class ORTUNG_API FramedLevels {
 public:
  FramedLevels() : levels_(1, kFar) {}
  explicit FramedLevels(const EndPointField& field);

  const FramedLookup& lookup() const { return lookup_; }
  const std::uint8_t* levels() const { return levels_.data(); }

 private:
  static constexpr std::uint8_t kFar = 255;

  FramedLookup lookup_;
  std::vector<std::uint8_t> levels_;
};

}  // namespace ortung
