#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace ortung::client {

/// What stands behind "key=" in a line of the server's; "" if it is not there.
std::string_view valueOf(std::string_view line, std::string_view key);

/// Cuts the first word off @p line, and the blank behind it.
std::string_view cutWord(std::string_view& line);

/// The number that a text is from its beginning to its end; nothing if it is none.
template <class Number>
std::optional<Number> numberFrom(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace ortung::client
