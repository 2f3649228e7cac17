#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace ortung {

/// Appends a number as bytes, the least significant first.
template <class Number>
void putNumber(std::string& out, Number number) {
  auto rest = static_cast<std::make_unsigned_t<Number>>(number);
  for (std::size_t i = 0; i < sizeof rest; ++i) out += static_cast<char>(rest >> 8 * i & 0xFF);
}

/// Cuts such a number off the front. @pre bytes has as many
template <class Number>
Number takeNumber(std::string_view& bytes) {
  using Bits = std::make_unsigned_t<Number>;
  Bits bits = 0;
  for (std::size_t i = 0; i < sizeof bits; ++i)
    bits =
        static_cast<Bits>(bits | static_cast<Bits>(static_cast<unsigned char>(bytes[i])) << 8 * i);
  bytes.remove_prefix(sizeof bits);
  return static_cast<Number>(bits);
}

/// Words as bytes, the least significant first. @pre out has four bytes a word
inline void putWords(std::span<const std::uint32_t> words, std::span<char> out) {
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(out.data(), words.data(), words.size_bytes());
  } else {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = static_cast<char>(words[i / 4] >> 8 * (i % 4) & 0xFF);
  }
}

}  // namespace ortung
