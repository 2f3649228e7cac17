#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// The only place here that knows lz4 and zstd.
namespace ortung::ros2 {

std::string packZstd(std::string_view bytes);
std::string packLz4(std::string_view bytes);

/// Unpacks what nobody vouches for: @p out grows as bytes come out, to @p most at most.
/// @returns why not, or ""
std::string unpackZstd(std::string_view packed, std::size_t most, std::string& out);
std::string unpackLz4(std::string_view packed, std::size_t most, std::string& out);

}  // namespace ortung::ros2
