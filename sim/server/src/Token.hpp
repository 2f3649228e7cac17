#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ortung/server/MessageBoard.hpp"

namespace ortung::server {

/// Whether both texts are the same, in a time that depends on the length of @p given alone.
bool isSameInConstantTime(std::string_view secret, std::string_view given);

/// Whether a client of this name may come in with this token; always, if there are no tokens.
bool isTokenRight(const std::vector<BoardToken>& tokens, std::string_view name,
                  std::string_view given);

}  // namespace ortung::server
