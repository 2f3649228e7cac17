#include "ortung/tables/EndPointField.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ortung/tables/DistanceTransform.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostCells = 1u << 27;

}  // namespace

void EndPointField::start(const FieldGrid& grid, double cell, double margin) {
  const double width = grid.columns * grid.cell + 2 * margin;
  const double height = grid.rows * grid.cell + 2 * margin;
  if (!(cell > 0.0) || !(width / cell * (height / cell) < kMostCells)) {
    throw std::invalid_argument(
        "an end-point field has at most 2^27 cells; choose a larger endpoint_cell_m");
  }
  grid_ = {grid.originX - margin, grid.originY - margin, cell,
           static_cast<int>(std::ceil(width / cell)), static_cast<int>(std::ceil(height / cell))};
  own_.assign(grid_.size(), 0);
  levels_ = own_;
}

void EndPointField::mark(double x, double y) {
  const std::ptrdiff_t cell = grid_.cellAt(x, y);
  if (cell >= 0) own_[static_cast<std::size_t>(cell)] = 1;
}

void EndPointField::finish() {
  DistanceTransform distances(grid_.columns, grid_.rows, own_);
  auto level = own_.begin();
  for (int row = 0; row < grid_.rows; ++row) {
    for (const double squared : distances.squaredOf(row)) {
      const float cells = std::sqrt(static_cast<float>(squared));
      *level++ = static_cast<std::uint8_t>(std::min(255.0F, std::nearbyint(cells * kPerCell)));
    }
  }
}

void EndPointField::save(TableWriter& file, const std::string& prefix) const {
  const double place[] = {grid_.originX, grid_.originY, grid_.cell};
  file.add<double>(prefix + "end_point_grid", {3}, place);
  file.add<std::uint8_t>(
      prefix + "end_points",
      {static_cast<std::size_t>(grid_.rows), static_cast<std::size_t>(grid_.columns)}, levels_);
}

void EndPointField::load(const std::shared_ptr<const TableFile>& shared,
                         const std::string& prefix) {
  const TableFile& file = *shared;
  const auto place = file.get<double>(prefix + "end_point_grid", {3});
  const TableArray& array = file.array(prefix + "end_points");
  const auto levels = file.get<std::uint8_t>(prefix + "end_points", {0, 0});
  const bool fine = std::isfinite(place[0]) && std::isfinite(place[1]) && place[2] > 1e-4 &&
                    place[2] < 1e3 && levels.size() <= kMostCells && !levels.empty();
  if (!fine)
    throw TableError(file.path().string() + ": table " + prefix +
                     "end_point_grid has impossible values");
  grid_ = {place[0], place[1], place[2], static_cast<int>(array.shape[1]),
           static_cast<int>(array.shape[0])};
  levels_ = levels;
  file_ = shared;
  own_.clear();
}

}  // namespace ortung
