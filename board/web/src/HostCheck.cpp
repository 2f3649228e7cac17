#include "HostCheck.hpp"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <cctype>

namespace ortung::web {
namespace {

bool isSameIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

bool isPort(std::string_view text) {
  return !text.empty() && text.size() <= 5 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// "name:port", "[::1]:port" or either without a port; the name alone, or "" if it is none of them.
std::string_view nameOf(std::string_view host) {
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    if (end == host.npos) return {};
    const std::string_view rest = host.substr(end + 1);
    if (!rest.empty() && (rest.front() != ':' || !isPort(rest.substr(1)))) return {};
    return host.substr(1, end - 1);
  }
  const std::size_t colon = host.find(':');
  if (colon != host.npos && !isPort(host.substr(colon + 1))) return {};
  return host.substr(0, colon);
}

}  // namespace

bool isOwnHost(std::string_view host, const std::vector<std::string>& names) {
  const std::string_view name = nameOf(host);
  if (name.empty()) return false;
  if (isSameIgnoringCase(name, "localhost")) return true;
  boost::system::error_code error;
  boost::asio::ip::make_address(std::string(name), error);
  if (!error) return true;
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& own) { return isSameIgnoringCase(own, name); });
}

bool isOwnOrigin(std::string_view origin, std::string_view host,
                 const std::vector<std::string>& others) {
  if (origin.empty()) return true;
  for (const std::string_view scheme : {"http://", "https://"})
    if (origin.starts_with(scheme) && isSameIgnoringCase(origin.substr(scheme.size()), host))
      return true;
  return std::any_of(others.begin(), others.end(),
                     [&](const std::string& other) { return isSameIgnoringCase(other, origin); });
}

}  // namespace ortung::web
