#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ortung::ros2 {

/// Unpacks untrusted bytes: @p out grows with the output, to at most @p most bytes.
/// @returns "", or the reason why they can't be unpacked
std::string unpackBzip2(std::string_view packed, std::size_t most, std::string& out);

}  // namespace ortung::ros2
