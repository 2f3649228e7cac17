#pragma once

#include <string_view>

namespace ortung::client {

/// What stands behind "key=" in a line of the server's; "" if it is not there.
std::string_view valueOf(std::string_view line, std::string_view key);

/// Cuts the first word off @p line, and the blank behind it.
std::string_view cutWord(std::string_view& line);

}  // namespace ortung::client
