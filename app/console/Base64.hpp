#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace ortung::app {

/// Encodes bytes as text (RFC 4648, padded), e.g. for data within a page.
std::string base64(std::span<const std::byte> bytes);

}  // namespace ortung::app
