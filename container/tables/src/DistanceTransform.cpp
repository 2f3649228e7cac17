#include "ortung/tables/DistanceTransform.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace ortung {
namespace {

/// Returns where the parabolas (x - column)^2 + height[column]^2 of columns p < q meet.
double crossing(const int* height, int p, int q) {
  const double a = static_cast<double>(height[p]) * height[p] + static_cast<double>(p) * p;
  const double b = static_cast<double>(height[q]) * height[q] + static_cast<double>(q) * q;
  return (b - a) / (2.0 * (q - p));
}

}  // namespace

DistanceTransform::DistanceTransform(int columns, int rows, std::span<const std::uint8_t> marked)
    : columns_(columns),
      rows_(rows),
      far_(rows + columns + 1),
      inColumn_(marked.size(), far_),
      place_(static_cast<std::size_t>(columns)),
      from_(static_cast<std::size_t>(columns)),
      squared_(static_cast<std::size_t>(columns)) {
  assert(marked.size() == at(0, rows));
  const auto sweep = [&](int row, int previous) {
    for (int column = 0; column < columns_; ++column) {
      int& here = inColumn_[at(column, row)];
      if (marked[at(column, row)] != 0) {
        here = 0;
      } else if (previous >= 0 && previous < rows_) {
        here = std::min(here, inColumn_[at(column, previous)] + 1);
      }
    }
  };
  for (int row = 0; row < rows_; ++row) sweep(row, row - 1);
  for (int row = rows_ - 1; row >= 0; --row) sweep(row, row + 1);
}

void DistanceTransform::build(const int* height) {
  count_ = 0;
  for (int q = 0; q < columns_; ++q) {
    if (height[q] >= far_) continue;
    double start = -std::numeric_limits<double>::infinity();
    while (count_ > 0) {
      start = crossing(height, place_[count_ - 1], q);
      if (start > from_[count_ - 1]) break;
      --count_;
      start = -std::numeric_limits<double>::infinity();
    }
    place_[count_] = q;
    from_[count_] = start;
    ++count_;
  }
}

std::span<const double> DistanceTransform::squaredOf(int row) {
  const int* height = inColumn_.data() + at(0, row);
  build(height);
  if (count_ == 0) {
    std::fill(squared_.begin(), squared_.end(), std::numeric_limits<double>::infinity());
    return squared_;
  }
  std::size_t k = 0;
  for (int x = 0; x < columns_; ++x) {
    while (k + 1 < count_ && from_[k + 1] <= x) ++k;
    const double dx = x - place_[k];
    const double dy = height[place_[k]];
    squared_[static_cast<std::size_t>(x)] = dx * dx + dy * dy;
  }
  return squared_;
}

}  // namespace ortung
