#pragma once

#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// " key=number", the shortest that gives the same number again.
ORTUNG_API std::string keyValue(const char* key, double number);

/// " colour=..."; "" of none.
ORTUNG_API std::string colourText(const std::string& colour);

/// What stands and is painted on the field, as DESCRIBE field gives it (docs/protocol.md): of walls
/// the longest, at most 20,000.
ORTUNG_API std::vector<std::string> fieldText(const FieldModel& field);

}  // namespace ortung
