#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Returns the colour 0xRRGGBB that "#rrggbb" or a name of world files ("blue") stands for; nothing
/// for any other text.
ORTUNG_API std::optional<std::uint32_t> rgbOf(std::string_view colour);

}  // namespace ortung
