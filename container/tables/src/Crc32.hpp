#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ortung/base/Export.hpp"

namespace ortung::zip {

/// CRC-32 of @p bytes (polynomial 0xEDB88320), continuing from @p crc.
ORTUNG_API std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc = 0);

}  // namespace ortung::zip
