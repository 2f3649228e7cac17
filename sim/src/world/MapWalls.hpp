#pragma once

#include <vector>

#include "GridMap.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// Adds the straight walls of a map, as seen from its free cells: outlines of occupied cells are
/// split into straight pieces, which are fitted by least squares. Short pieces are left out, and
/// only the longest 4096 are kept.
void addMapWalls(const GridBody& body, std::vector<FieldWall>& walls);

}  // namespace ortung
