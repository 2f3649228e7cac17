#include "ortung/tables/EndPointField.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ortung {
namespace {

constexpr std::size_t kMostCells = 1u << 27;
constexpr float kFar = 1e10F;

/// Squared distance transform of one row or column (Felzenszwalb and Huttenlocher, section 2).
class LineTransform {
 public:
  explicit LineTransform(std::size_t longest)
      : in_(longest), parabola_(longest), border_(longest + 1) {}

  template <class Get, class Set>
  void run(int n, Get get, Set set) {
    for (int i = 0; i < n; ++i) in_[at(i)] = get(i);
    int last = 0;
    parabola_[0] = 0;
    border_[0] = -std::numeric_limits<double>::infinity();
    border_[1] = std::numeric_limits<double>::infinity();
    for (int q = 1; q < n; ++q) {
      double crossing = cross(q, parabola_[at(last)]);
      while (crossing <= border_[at(last)]) crossing = cross(q, parabola_[at(--last)]);
      parabola_[at(++last)] = q;
      border_[at(last)] = crossing;
      border_[at(last + 1)] = std::numeric_limits<double>::infinity();
    }
    int k = 0;
    for (int q = 0; q < n; ++q) {
      while (border_[at(k + 1)] < static_cast<double>(q)) ++k;
      const int v = parabola_[at(k)];
      set(q, square(q - v) + in_[at(v)]);
    }
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static double square(double cells) {
    return cells * cells;
  }  // in long corridors too large for an int
  double cross(int q, int v) const {
    return ((in_[at(q)] + square(q)) - (in_[at(v)] + square(v))) / (2.0 * (q - v));
  }
  std::vector<double> in_;
  std::vector<int> parabola_;
  std::vector<double> border_;
};

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
  const int columns = grid_.columns;
  const int rows = grid_.rows;
  std::vector<float> squared(grid_.size());
  std::transform(own_.begin(), own_.end(), squared.begin(),
                 [](std::uint8_t m) { return m != 0 ? 0.0F : kFar; });
  LineTransform transform(static_cast<std::size_t>(std::max(columns, rows)));
  const auto at = [&](int column, int row) -> float& {
    return squared[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  };
  for (int column = 0; column < columns; ++column) {
    transform.run(
        rows, [&](int row) { return at(column, row); },
        [&](int row, double v) { at(column, row) = static_cast<float>(v); });
  }
  for (int row = 0; row < rows; ++row) {
    transform.run(
        columns, [&](int column) { return at(column, row); },
        [&](int column, double v) { at(column, row) = static_cast<float>(v); });
  }
  std::transform(squared.begin(), squared.end(), own_.begin(), [](float d) {
    return static_cast<std::uint8_t>(std::min(255.0F, std::nearbyint(std::sqrt(d) * kPerCell)));
  });
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
                    place[2] < 1e3 && array.shape[0] <= kMostCells &&
                    array.shape[1] <= kMostCells && !levels.empty();
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
