#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ortung/tables/FieldRegion.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {

/// Where landmarks are, learned from noise-free sightings, and which of them is the nearest one of
/// a place: a grid, so that asking does not take longer the more landmarks there are. Not
/// thread-safe while it is filled; then any number of threads may read it.
class LandmarkPlaces {
 public:
  static constexpr std::uint16_t kNone = 0xFFFF;  ///< none within reach

  void start(const FieldGrid& region, std::size_t landmarks);
  /// A landmark was seen at (x, y). @pre index < landmarks
  void mark(std::size_t index, double x, double y);
  void finish();

  /// Cells in which the sensor may be.
  const FieldGrid& region() const { return region_; }
  /// Cells of nearest().
  const FieldGrid& grid() const { return grid_; }
  /// By cell: number of the nearest landmark, or kNone.
  const std::vector<std::uint16_t>& nearest() const { return nearest_; }
  std::uint16_t nearestTo(double x, double y) const {
    const std::ptrdiff_t cell = grid_.cellAt(x, y);
    return cell < 0 ? kNone : nearest_[static_cast<std::size_t>(cell)];
  }
  /// NaN for one that was never seen [m].
  double x(std::size_t index) const { return x_[index]; }
  double y(std::size_t index) const { return y_[index]; }
  bool isEmpty() const { return nearest_.empty(); }

  void save(TableWriter& file, const std::string& prefix) const;
  /// @throws TableError
  void load(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
            const FieldGrid& region, std::size_t landmarks);

 private:
  void makeGrid();

  FieldGrid region_;
  FieldGrid grid_;
  std::vector<double> x_;  ///< sums of sightings until finish()
  std::vector<double> y_;
  std::vector<double> counts_;  ///< number of sightings by landmark, while learning
  std::vector<std::uint16_t> nearest_;
};

}  // namespace ortung
