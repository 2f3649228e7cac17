#pragma once

#include <cstddef>

#include "WorldGrid.hpp"
#include "ortung/formats/ChangesData.hpp"

namespace ortung::app {

/// How many cells of a grid were changed.
struct MendedCells {
  std::size_t freed = 0;
  std::size_t occupied = 0;
};

/// Changes a map where readings are sure that it no longer fits. Around a wall that is gone cells
/// become free, and so does what is left of a body of at most a few metres if most of its surface
/// is gone: nobody can see its inside. What is new becomes occupied, and is joined where it was
/// found in cells next to each other.
MendedCells mend(const ChangesData::Reading& changes, WorldGrid& grid);

}  // namespace ortung::app
