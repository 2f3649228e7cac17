#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// The store-only part of the zip format (PKWARE APPNOTE 6.3.3), without zip64.
namespace ortung::zip {

/// A member's place in the file.
struct Member {
  std::string name;
  std::uint32_t crc = 0;
  std::uint32_t size = 0;
  std::uint32_t headerOffset = 0;  ///< offset of the member's local header in the file [bytes]
};

inline constexpr std::size_t kMostMembers = 65535;
inline constexpr std::size_t kLongestName = 300;
/// Alignment of every member's data in the file [bytes].
inline constexpr std::size_t kAlignment = 64;

/// Local header of @p member, padded so that its data begins at a multiple of kAlignment.
std::string localHeader(const Member& member);
/// Central directory and its end record; @p offset is where it will stand.
std::string directory(const std::vector<Member>& members, std::uint32_t offset);

/// A member and its bytes within a file.
struct Entry {
  std::string name;
  std::span<const std::byte> bytes;
};

/// Reads and checks a whole file: structure, bounds, names and checksums.
/// Returns why it is refused, or "" with @p entries filled.
std::string read(std::span<const std::byte> file, std::vector<Entry>& entries);

}  // namespace ortung::zip
