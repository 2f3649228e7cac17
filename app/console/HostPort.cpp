#include "HostPort.hpp"

#include <charconv>

namespace ortung::app {

std::optional<HostPort> parseHostPort(const std::string& text) {
  const bool isOnlyBracketed = text.starts_with('[') && text.ends_with(']');  // [::1]
  const std::size_t colon = isOnlyBracketed ? text.npos : text.rfind(':');    // or [::1]:7777
  HostPort found{text.substr(0, colon), std::nullopt};
  if (colon != text.npos) {
    const char* end = text.data() + text.size();
    std::uint16_t port = 0;
    const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, port);
    if (error != std::errc() || rest != end) return std::nullopt;
    found.port = port;
  }
  if (found.host.starts_with('[') && found.host.ends_with(']'))
    found.host = found.host.substr(1, found.host.size() - 2);
  return found;
}

std::string hostForBrowsers(const std::string& address) {
  if (address == "0.0.0.0" || address == "::") return "localhost";
  return address.find(':') == address.npos ? address : "[" + address + "]";
}

}  // namespace ortung::app
