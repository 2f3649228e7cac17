#pragma once

#include <string>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Returns what cameras are rendered with: "egl: llvmpipe (LLVM 15.0.6, 256 bits)".
/// @throws std::runtime_error naming what was tried, why it did not work, and what to install
ORTUNG_API std::string openGlRenderer();

}  // namespace ortung
