#include "ortung/tables/FieldRegion.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace ortung {

void FieldRegion::check() const {
  if (!(grid.cell > 0.0) || !std::isfinite(grid.cell) || !std::isfinite(grid.originX) ||
      !std::isfinite(grid.originY) || grid.columns <= 0 || grid.rows <= 0) {
    throw std::invalid_argument("field region: the grid must have cells of positive, finite size");
  }
  if (open.size() != grid.size() || standable.size() != grid.size()) {
    throw std::invalid_argument("field region: masks of " + std::to_string(open.size()) + " and " +
                                std::to_string(standable.size()) + " cells, expected " +
                                std::to_string(grid.size()));
  }
  if (std::find(standable.begin(), standable.end(), 1) == standable.end()) {
    throw std::invalid_argument("field region: there is no cell where the robot can stand");
  }
}

}  // namespace ortung
