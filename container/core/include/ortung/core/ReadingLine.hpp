#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"

namespace ortung {

/// One reading as a line without its end:
/// "<stamp us> <model>/<type>/<feature> <number of words> <word> <word> ...".
/// Appends to @p line. The same line is the log and the wire.
ORTUNG_API void writeLine(const Message& message, std::string& line);

/// Reads such a line: exactly one blank between two words, none elsewhere. Nothing for anything
/// else; then @p why (if given) says what is wrong. Never throws, never allocates more than the
/// line is long.
ORTUNG_API std::optional<Message> parseLine(std::string_view line, std::string* why = nullptr);

inline constexpr std::size_t kMaxWords = 1u << 24;       ///< words of one reading
inline constexpr std::size_t kMaxLineBytes = 64u << 20;  ///< of a record

/// @p token in quotes, as errors show it: what is not printable, and more than 40 bytes, left out.
ORTUNG_API std::string inQuotation(std::string_view token);

}  // namespace ortung
