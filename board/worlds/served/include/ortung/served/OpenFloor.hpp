#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/sim/SimWorld.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Which cells of a world's floor are free, to draw it: of 5 cm, or larger ones of a large world.
ORTUNG_API FieldRegion openFloor(const SimWorld& world);

}  // namespace ortung
