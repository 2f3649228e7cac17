#pragma once

#include <bit>
#include <boost/crc.hpp>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

// Items of MCAP's records: little-endian numbers; texts and lists after their length in bytes.
namespace ortung::ros2 {

inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

/// Kinds of records.
enum class McapOp : std::uint8_t {
  kHeader = 1,
  kFooter,
  kSchema,
  kChannel,
  kMessage,
  kChunk,
  kMessageIndex,
  kChunkIndex,
  kAttachment,
  kAttachmentIndex,
  kStatistics,
  kMetadata,
  kMetadataIndex,
  kSummaryOffset,
  kDataEnd,
};

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

inline void put(std::string& out, std::unsigned_integral auto number) {
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}
inline void putText(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}
/// Appends a record: its kind, its length and its content.
inline void putRecord(std::string& out, McapOp kind, std::string_view content) {
  put(out, static_cast<std::uint8_t>(kind));
  put(out, static_cast<std::uint64_t>(content.size()));
  out += content;
}

/// Takes an item from the front of bytes; returns false, and takes nothing, if there are too few.
template <std::unsigned_integral T>
bool take(std::string_view& bytes, T& number) {
  if (bytes.size() < sizeof number) return false;
  std::memcpy(&number, bytes.data(), sizeof number);
  bytes.remove_prefix(sizeof number);
  return true;
}
template <std::unsigned_integral Length>
bool takeBytes(std::string_view& bytes, std::string_view& piece) {
  std::string_view rest = bytes;
  Length size = 0;
  if (!take(rest, size) || size > rest.size()) return false;
  piece = rest.substr(0, size);
  bytes = rest.substr(size);
  return true;
}
inline bool takeText(std::string_view& bytes, std::string& text) {
  std::string_view piece;
  if (!takeBytes<std::uint32_t>(bytes, piece)) return false;
  text = piece;
  return true;
}

/// The CRC-32 of zip, of bytes that may come in pieces. Not thread-safe.
class Crc {
 public:
  void add(std::string_view bytes) { crc_.process_bytes(bytes.data(), bytes.size()); }
  std::uint32_t value() const { return crc_.checksum(); }

 private:
  boost::crc_32_type crc_;
};
inline std::uint32_t crcOf(std::string_view bytes) {
  Crc crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace ortung::ros2
