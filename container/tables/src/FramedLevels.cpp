#include "FramedLevels.hpp"

#include <algorithm>

namespace ortung {

FramedLevels::FramedLevels(const EndPointField& field) : lookup_(field.grid()) {
  const auto columns = static_cast<std::size_t>(field.grid().columns);
  const auto rows = static_cast<std::size_t>(field.grid().rows);
  levels_.reserve((columns + 1) * (rows + 1));
  for (std::size_t row = 0; row < rows; ++row) {
    const auto line = field.levels().subspan(row * columns, columns);
    levels_.insert(levels_.end(), line.begin(), line.end());
    levels_.push_back(kFar);
  }
  levels_.resize((columns + 1) * (rows + 1), kFar);
}

}  // namespace ortung
