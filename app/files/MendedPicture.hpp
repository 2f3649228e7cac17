#pragma once

#include "Picture.hpp"
#include "WorldGrid.hpp"
#include "ortung/formats/ChangesData.hpp"

namespace ortung::app {

/// Draws the part of two maps around what has changed: the one there is, what was found in it, and
/// the one proposed, beside each other. @pre both maps have the same cells
Picture drawMended(const WorldGrid& before, const ChangesData::Reading& changes,
                   const WorldGrid& after);

}  // namespace ortung::app
