#pragma once

#include <cstdint>
#include <string>

namespace ortung {

/// 0xRRGGBB of "#rrggbb" or of a name that world files use; ObjectsData::kNoColour for others.
std::uint32_t colourWord(const std::string& colour);

}  // namespace ortung
