#include "ortung/tables/PositionTable.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr int kDirections = 65535;  // levels 0..65534, so that CellTable::kNone stays free
constexpr double kPerRadian = kDirections / kTurn;

}  // namespace

void CellTable::start(const FieldGrid& grid) {
  grid_ = grid;
  own_.assign(grid.size(), kNone);
  levels_ = own_;
}

void CellTable::set(double x, double y, std::uint16_t level) {
  const std::ptrdiff_t cell = grid_.cellAt(x, y);
  if (cell >= 0 && !own_.empty()) own_[static_cast<std::size_t>(cell)] = level;
}

void CellTable::save(TableWriter& file, const std::string& name) const {
  file.add<std::uint16_t>(
      name, {static_cast<std::size_t>(grid_.rows), static_cast<std::size_t>(grid_.columns)},
      levels_);
}

void CellTable::load(const std::shared_ptr<const TableFile>& file, const std::string& name,
                     const FieldGrid& grid) {
  levels_ = file->get<std::uint16_t>(
      name, {static_cast<std::size_t>(grid.rows), static_cast<std::size_t>(grid.columns)});
  grid_ = grid;
  file_ = file;
  own_.clear();
}

PositionTable::PositionTable(double maxRange)
    : metresPerLevel_(std::max(0.001, maxRange / (CellTable::kNone - 1))) {}

void PositionTable::learn(double x, double y, double range) {
  const double level = std::nearbyint(range / metresPerLevel_);
  if (level >= 0 && level < CellTable::kNone) cells_.set(x, y, static_cast<std::uint16_t>(level));
}

float PositionTable::at(double x, double y) const {
  const std::uint16_t level = cells_.at(x, y);
  return level == CellTable::kNone ? std::numeric_limits<float>::quiet_NaN()
                                   : static_cast<float>(level * metresPerLevel_);
}

void BearingTable::learn(double x, double y, double directionInField) {
  const int level =
      static_cast<int>(std::lround(std::remainder(directionInField, kTurn) * kPerRadian));
  cells_.set(x, y, static_cast<std::uint16_t>((level + kDirections) % kDirections));
}

float BearingTable::at(double x, double y) const {
  const std::uint16_t level = cells_.at(x, y);
  if (level == CellTable::kNone) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(std::remainder(level / kPerRadian, kTurn));
}

}  // namespace ortung
