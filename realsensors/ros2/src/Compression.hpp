#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

// The only place here that knows lz4 and zstd.
namespace ortung::ros2 {

ORTUNG_API std::string packZstd(std::string_view bytes);
ORTUNG_API std::string packLz4(std::string_view bytes);

/// Unpacks untrusted bytes: @p out grows with the output, to at most @p most bytes.
/// @returns "", or the reason why they can't be unpacked
ORTUNG_API std::string unpackZstd(std::string_view packed, std::size_t most, std::string& out);
ORTUNG_API std::string unpackLz4(std::string_view packed, std::size_t most, std::string& out);

}  // namespace ortung::ros2
