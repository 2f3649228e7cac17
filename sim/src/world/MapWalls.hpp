#pragma once

#include <vector>

#include "GridMap.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// Adds the straight walls of a map, as seen from its free cells: outlines of occupied cells, split
/// into straight pieces and evened out by least squares. Short pieces are left out; there are at
/// most 4096, the longest.
void addMapWalls(const GridBody& body, std::vector<FieldWall>& walls);

}  // namespace ortung
