#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {

/// A piece of what beams end on: a line, or a spot around which the ends scatter.
struct Surface {
  float x = 0.0F;  ///< a point of the surface in the field frame [m]
  float y = 0.0F;
  float normalX = 1.0F;  ///< x of the line's unit normal
  float normalY = 0.0F;
  float across = 0.0F;  ///< standard deviation of ends across the surface [m]
  float along = -1.0F;  ///< standard deviation along it [m]; negative: a line, unbounded along
};

/// The surfaces that beams end on, finer than any cell: learned end points are summed up by cell,
/// and mean and covariance of a cell and its neighbours give a line or a spot (after Biber,
/// Straßer, "The normal distributions transform", IROS 2003; Segal, Haehnel, Thrun,
/// "Generalized-ICP", RSS 2009). Only blocks of cells near surfaces take memory. Not thread-safe
/// while it is filled; then any number of threads may read it.
class ORTUNG_API SurfaceField {
 public:
  static constexpr int kReach = 6;  ///< greatest distance from a point to its surface [cells]

  /// Covers the region's grid and @p margin beyond it on all sides [m], with cells of @p cell [m].
  void start(const FieldRegion& region, double cell, double margin);
  void mark(double x, double y);  ///< adds an end point [m]; ignored outside
  /// Makes the surfaces, once all end points are added.
  void finish();

  /// Returns the standard deviation of the world's surfaces (FieldRegion::surfaceSigma) [m].
  double sigma() const { return sigma_; }
  bool isEmpty() const { return surfaces_.empty(); }
  const FieldGrid& grid() const { return grid_; }
  /// Returns the surface nearest to a point [m], or null if none is within kReach.
  const Surface* near(double x, double y) const {
    // As FieldGrid::cellAt(), but for the way over the cell's index, which costs divisions.
    const double column = (x - grid_.originX) / grid_.cell;
    const double row = (y - grid_.originY) / grid_.cell;
    if (!(column >= 0 && row >= 0 && column < grid_.columns && row < grid_.rows)) return nullptr;
    const std::int32_t number = numberAt(static_cast<int>(column), static_cast<int>(row));
    return number < 0 ? nullptr : &surfaces_[static_cast<std::size_t>(number)];
  }
  /// Number of the surface nearest to a cell, or -1. @pre the cell is in the grid
  std::int32_t numberAt(int column, int row) const {
    const std::int32_t block = blockOf_[blockAt(column, row)];
    return block < 0 ? -1 : blocks_[static_cast<std::size_t>(block)][within(column, row)];
  }
  /// All surfaces, by number.
  const std::vector<Surface>& surfaces() const { return surfaces_; }

  void save(TableWriter& file, const std::string& prefix) const;
  /// Files of older versions have no surfaces: then it stays empty.
  void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix);
  /// Returns the surfaces of a file, made once for all who use it: making them takes longer than
  /// what else is loaded.
  static std::shared_ptr<const SurfaceField> of(const std::shared_ptr<const TableFile>& file,
                                                const std::string& prefix);

 private:
  static constexpr int kBlock = 16;  ///< cells along the edge of a block
  /// Mean and covariance of the ends in a cell; lengths in cells, from the cell's centre.
  struct Ends {
    float x = 0.0F;
    float y = 0.0F;
    float xx = 0.0F;
    float xy = 0.0F;
    float yy = 0.0F;
    float count = 0.0F;  ///< number of ends in the cell
  };
  struct Sums {
    double count = 0.0;
    double x = 0.0;
    double y = 0.0;
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    void add(double px, double py);
    Ends ends() const;
  };
  using Block = std::array<std::int32_t, static_cast<std::size_t>(kBlock) * kBlock>;

  std::size_t blockAt(int column, int row) const {
    return static_cast<std::size_t>(row) / kBlock * blockColumns_ +
           static_cast<std::size_t>(column) / kBlock;
  }
  static std::size_t within(int column, int row) {
    return static_cast<std::size_t>(row) % kBlock * kBlock +
           static_cast<std::size_t>(column) % kBlock;
  }
  std::int32_t& numberFor(int column, int row);
  void checkAndClear();
  void makeSurfaces();
  Surface surfaceOf(std::size_t number) const;
  void spreadNumbers();

  FieldGrid grid_;
  double sigma_ = 0.0;
  std::size_t blockColumns_ = 0;
  std::vector<std::int32_t> blockOf_;  ///< index in blocks_, by block of the grid; -1: nothing near
  std::vector<Block> blocks_;          ///< blocks of surface numbers, one for each cell; -1: none
  std::vector<std::int32_t> cells_;    ///< number of the cell in which each surface lies
  std::vector<Ends> ends_;
  std::vector<Surface> surfaces_;
  std::vector<Sums> sums_;  ///< sums of each cell's ends, while learning
};

}  // namespace ortung
