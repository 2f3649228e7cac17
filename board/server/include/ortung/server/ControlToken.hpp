#pragma once

#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/server/MessageBoard.hpp"

namespace ortung {

/// Returns whether @p token belongs to a name that may control the world. The token of '*' says
/// nothing of who has it, so it does not. Takes a time that depends on the length of @p token and
/// the number of tokens alone.
ORTUNG_API bool isControlToken(const BoardConfig& config, std::string_view token);

}  // namespace ortung
