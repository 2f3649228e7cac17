#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace ortung::app {

/// Bytes as text that may stand within a page (RFC 4648, padded).
std::string base64(std::span<const std::byte> bytes);

}  // namespace ortung::app
