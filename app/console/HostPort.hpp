#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ortung::app {

/// The address of a server: "127.0.0.1:7777", "[::1]:7777", "[::1]".
struct HostPort {
  std::string host;                   ///< host without brackets
  std::optional<std::uint16_t> port;  ///< port; nothing: the text has none
};

/// Parses "HOST[:PORT]"; nothing if the text behind the last colon, outside of brackets, is not a
/// number in [0, 65535].
std::optional<HostPort> parseHostPort(const std::string& text);

/// Returns the host by which a browser on this computer reaches a server that listens on
/// @p address: localhost for one on all addresses; one with colons in brackets.
std::string hostForBrowsers(const std::string& address);

}  // namespace ortung::app
