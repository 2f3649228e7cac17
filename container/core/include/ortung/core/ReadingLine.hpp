#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"

namespace ortung {

/// Appends one reading to @p line, without an end of line:
/// "<stamp us> <model>/<type>/<feature> <number of words> <word> <word> ...".
/// The same line is in the log and on the wire.
ORTUNG_API void writeLine(const Message& message, std::string& line);

/// Reads such a line: exactly one blank between two words, none elsewhere. Returns nothing for
/// anything else; then @p why (if given) says what is wrong. Never throws, never allocates more
/// than the line is long.
ORTUNG_API std::optional<Message> parseLine(std::string_view line, std::string* why = nullptr);

inline constexpr std::size_t kMaxWords = 1u << 24;       ///< most words of one reading
inline constexpr std::size_t kMaxLineBytes = 64u << 20;  ///< most bytes of a record's line

/// Returns @p token in quotes for messages, without unprintable characters and all beyond 40 bytes.
ORTUNG_API std::string inQuotation(std::string_view token);

}  // namespace ortung
