#pragma once

#include <array>
#include <charconv>
#include <string>

namespace ortung {

/// The shortest text that gives the same number again; "inf" where nothing is within range.
inline std::string numberText(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

}  // namespace ortung
