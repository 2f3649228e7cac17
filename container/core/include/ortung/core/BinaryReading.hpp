#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"

namespace ortung {

/// Appends a reading in binary form, which is shorter for large readings on a network: the line
/// "STAMP MODEL/TYPE/FEATURE N", then N words of four bytes each, the least significant first.
ORTUNG_API void writeBinary(const Message& message, std::string& out);

/// Cuts such a reading off the front of @p bytes. Returns nothing for anything else; then @p bytes
/// stays as it is and @p why (if given) says what is wrong. Never allocates more than the bytes are
/// long.
ORTUNG_API std::optional<Message> parseBinary(std::string_view& bytes, std::string* why = nullptr);

}  // namespace ortung
