#include "ortung/tables/DirectionTable.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ortung/base/Angles.hpp"

namespace ortung {

void DirectionTable::start(const FieldRegion& region, int directions, int longestRun) {
  if (directions < 1 || directions > kMostDirections || longestRun < 1 ||
      longestRun > directions + 1) {
    throw std::invalid_argument(
        "a direction table has 1 to 36000 directions and runs of at most a turn");
  }
  grid_ = region.grid;
  directions_ = directions;
  stride_ = static_cast<std::size_t>(directions + longestRun - 1);
  ownRowOf_.assign(grid_.size(), -1);
  std::int32_t rows = 0;
  for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
    if (region.open[cell] != 0) ownRowOf_[cell] = rows++;
  }
  const std::size_t size = static_cast<std::size_t>(rows) * stride_ + kSlack;
  ownLevels_.assign(size, RangeScale::kNothing);
  closeness_.assign(size, 0);
  rowOf_ = ownRowOf_;
  levels_ = ownLevels_;
}

double DirectionTable::step() const { return kTurn / directions_; }

int DirectionTable::directionOf(double angle) const {
  const double turns = angle / kTurn;
  const double direction = std::nearbyint((turns - std::floor(turns)) * directions_);
  return direction < directions_ ? static_cast<int>(direction) : 0;  // also for NaN
}

void DirectionTable::learn(double x, double y, double angle, std::uint8_t level) {
  const std::ptrdiff_t cell = grid_.cellAt(x, y);
  if (cell < 0 || ownRowOf_[static_cast<std::size_t>(cell)] < 0) return;
  // Computes the result of directionOf(), and its distance; this is the learner's innermost loop.
  const double steps = angle * (directions_ / kTurn);
  const double nearest = std::nearbyint(steps);
  const double offset = std::abs(steps - nearest);  // 0 to 0.5
  const auto remainder = static_cast<int>(static_cast<std::int64_t>(nearest) % directions_);
  const int direction = remainder < 0 ? remainder + directions_ : remainder;
  const auto closeness = static_cast<std::uint8_t>(std::clamp(255.0 - 500.0 * offset, 1.0, 255.0));
  const std::size_t place =
      static_cast<std::size_t>(ownRowOf_[static_cast<std::size_t>(cell)]) * stride_ +
      static_cast<std::size_t>(direction);
  if (closeness <= closeness_[place]) return;
  closeness_[place] = closeness;
  ownLevels_[place] = level;
}

namespace {

/// Fills directions without an angle from a neighbour; returns false if a hole is too wide.
bool fillHoles(std::span<std::uint8_t> levels, std::span<const std::uint8_t> closeness) {
  const int n = static_cast<int>(levels.size());
  const auto at = [n](int direction) { return static_cast<std::size_t>((direction + n) % n); };
  for (int i = 0; i < n; ++i) {
    if (closeness[at(i)] != 0) continue;
    bool found = false;
    for (int gap = 1; gap <= DirectionTable::kWidestGap && !found; ++gap) {
      for (const int neighbour : {i - gap, i + gap}) {
        if (found || closeness[at(neighbour)] == 0) continue;
        levels[at(i)] = levels[at(neighbour)];
        found = true;
      }
    }
    if (!found) return false;
  }
  return true;
}

}  // namespace

void DirectionTable::finish() {
  const auto turn = static_cast<std::size_t>(directions_);
  for (std::int32_t& row : ownRowOf_) {
    if (row < 0) continue;
    const std::size_t first = static_cast<std::size_t>(row) * stride_;
    const std::span levels(ownLevels_.data() + first, stride_);
    if (!fillHoles(levels.first(turn), std::span(closeness_.data() + first, turn))) {
      row = -1;
      continue;
    }
    for (std::size_t i = turn; i < stride_; ++i) levels[i] = levels[i - turn];
  }
  closeness_.clear();
  closeness_.shrink_to_fit();
}

void DirectionTable::save(TableWriter& file, const std::string& prefix) const {
  const std::int32_t directions = directions_;
  file.add<std::int32_t>(prefix + "directions", {1}, std::span(&directions, 1));
  file.add<std::int32_t>(
      prefix + "row_of_cell",
      {static_cast<std::size_t>(grid_.rows), static_cast<std::size_t>(grid_.columns)}, rowOf_);
  file.add<std::uint8_t>(prefix + "levels", {levels_.size()}, levels_);
}

void DirectionTable::load(const std::shared_ptr<const TableFile>& shared, const std::string& prefix,
                          const FieldGrid& grid, const std::function<int(int)>& longestRunOf) {
  const TableFile& file = *shared;
  const int directions = file.get<std::int32_t>(prefix + "directions", {1})[0];
  const auto rowOf = file.get<std::int32_t>(
      prefix + "row_of_cell",
      {static_cast<std::size_t>(grid.rows), static_cast<std::size_t>(grid.columns)});
  const auto levels = file.get<std::uint8_t>(prefix + "levels", {0});
  if (directions < 1 || directions > kMostDirections || levels.size() < kSlack) {
    throw TableError(file.path().string() + ": table " + prefix + "directions is " +
                     std::to_string(directions) + ", expected 1 to 36000");
  }
  const std::size_t stride = static_cast<std::size_t>(directions + longestRunOf(directions) - 1);
  const auto rows = static_cast<std::int64_t>((levels.size() - kSlack) / stride);
  const bool whole = (levels.size() - kSlack) % stride == 0;
  const bool inside = std::all_of(rowOf.begin(), rowOf.end(),
                                  [&](std::int32_t row) { return row >= -1 && row < rows; });
  if (!whole || !inside) {
    throw TableError(file.path().string() + ": table " + prefix +
                     "levels does not fit its row numbers");
  }
  grid_ = grid;
  directions_ = directions;
  stride_ = stride;
  rowOf_ = rowOf;
  levels_ = levels;
  file_ = shared;
  ownRowOf_.clear();
  ownLevels_.clear();
}

}  // namespace ortung
