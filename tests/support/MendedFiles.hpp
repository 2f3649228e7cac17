#pragma once

#include <cstdint>
#include <cstring>
#include <string>

/// Checksums of damaged files set right again, as a hostile writer would: without that, nothing
/// behind the checksum is ever tried.
namespace ortung::test {

/// CRC-32 of zip and PNG, bit by bit.
inline std::uint32_t crcOf(const char* bytes, std::size_t n) {
  std::uint32_t crc = ~0u;
  for (std::size_t i = 0; i < n; ++i) {
    crc ^= static_cast<unsigned char>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

/// The chunks of a PNG, as far as their lengths make sense.
inline void mendPng(std::string& png) {
  for (std::size_t at = 8; png.size() >= 12 && at <= png.size() - 12;) {
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
      length = length << 8 | static_cast<unsigned char>(png[at + i]);
    if (length > png.size() - at - 12) return;
    const std::uint32_t crc = crcOf(png.data() + at + 4, length + 4);
    for (std::size_t i = 0; i < 4; ++i)
      png[at + 8 + length + i] = static_cast<char>(crc >> (24 - 8 * i));
    at += 12 + length;
  }
}

/// The members of a table file (a zip that stores), as far as its directory makes sense.
inline void mendZip(std::string& zip) {
  const auto number = [&zip](std::size_t place, std::size_t size) -> std::size_t {
    std::uint32_t value = 0;
    if (place > zip.size() || zip.size() - place < size) return zip.size();
    std::memcpy(&value, zip.data() + place, size);
    return value;
  };
  if (zip.size() < 22) return;
  const std::size_t end = zip.size() - 22;
  std::size_t at = number(end + 16, 4);
  for (std::size_t i = number(end + 10, 2); i > 0 && at <= end && end - at >= 46; --i) {
    const std::size_t size = number(at + 24, 4);
    const std::size_t local = number(at + 42, 4);
    const std::size_t data = local + 30 + number(local + 26, 2) + number(local + 28, 2);
    if (data <= end && size <= end - data) {
      const std::uint32_t crc = crcOf(zip.data() + data, size);
      std::memcpy(zip.data() + at + 16, &crc, 4);
      if (local <= end && end - local >= 30) std::memcpy(zip.data() + local + 14, &crc, 4);
    }
    at += 46 + number(at + 28, 2) + number(at + 30, 2) + number(at + 32, 2);
  }
}

}  // namespace ortung::test
