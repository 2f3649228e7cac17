#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// 0xRRGGBB of "#rrggbb" or of a name that world files use; nothing for others.
ORTUNG_API std::optional<std::uint32_t> rgbOf(std::string_view colour);

}  // namespace ortung
