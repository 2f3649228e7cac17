#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ortung::app {

/// Where a program is reached: "127.0.0.1:7777", "[::1]:7777".
struct HostPort {
  std::string host;                   ///< without brackets
  std::optional<std::uint16_t> port;  ///< nothing: the text has none
};

/// Reads "HOST[:PORT]"; nothing if what is behind the last colon is no number from 0 to 65535.
std::optional<HostPort> parseHostPort(const std::string& text);

}  // namespace ortung::app
