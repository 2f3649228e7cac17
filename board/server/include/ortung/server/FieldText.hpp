#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/tables/FieldModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// " key=number", the shortest that gives the same number again.
ORTUNG_API std::string keyValue(const char* key, double number);

/// " colour=..."; "" of none.
ORTUNG_API std::string colourText(const std::string& colour);

/// What stands and is painted on the field, as DESCRIBE field gives it (docs/protocol.md): of walls
/// the longest, at most 20,000.
ORTUNG_API std::vector<std::string> fieldText(const FieldModel& field);

/// Where the floor of a building is free, as DESCRIBE field gives it: a picture of its cells, for
/// fields that have no paint to be drawn by. Cells are made larger until they are at most 250,000
/// and their lines at most 256 KiB.
ORTUNG_API std::vector<std::string> floorText(FieldGrid grid, std::vector<std::uint8_t> open);

/// Returns whether a field is a floor of that kind, which has neither lines nor goals.
ORTUNG_API bool isFloor(const FieldModel& field);

}  // namespace ortung
