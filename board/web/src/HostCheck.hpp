#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ortung::web {

/// Whether the text of a Host header is this computer's for sure: an address, localhost, or one of
/// @p names, each with a port or without. A name of somebody else's may lead here today and have
/// led elsewhere when its page was loaded (DNS rebinding); addresses can't.
bool isOwnHost(std::string_view host, const std::vector<std::string>& names);

/// Whether a page of @p origin may connect to @p host: it was loaded from there, or is one of
/// @p others. Programs that are no browsers send no origin: those may.
bool isOwnOrigin(std::string_view origin, std::string_view host,
                 const std::vector<std::string>& others);

}  // namespace ortung::web
