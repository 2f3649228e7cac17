#include "Zip.hpp"

#include <cstring>
#include <optional>
#include <set>

#include "Crc32.hpp"

namespace ortung::zip {
namespace {

constexpr std::uint32_t kLocalMagic = 0x04034b50;
constexpr std::uint32_t kDirectoryMagic = 0x02014b50;
constexpr std::uint32_t kEndMagic = 0x06054b50;
constexpr std::size_t kLocalSize = 30;
constexpr std::size_t kDirectorySize = 46;
constexpr std::size_t kEndSize = 22;
constexpr std::uint16_t kVersion = 20;
constexpr std::uint16_t kExtraId = 0x4F52;  // "RO": our padding, ignored by others
constexpr std::uint16_t kDate = (2000 - 1980) << 9 | 1 << 5 | 1;  // fixed: same content, same bytes

template <class Number>
void put(std::string& out, Number value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    out += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
}

template <class Number>
Number take(std::span<const std::byte> bytes, std::size_t offset) {
  Number value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::optional<std::string> takeName(std::span<const std::byte> bytes, std::size_t offset,
                                    std::size_t size) {
  if (size == 0 || size > kLongestName || offset > bytes.size() || size > bytes.size() - offset)
    return std::nullopt;
  std::string name(reinterpret_cast<const char*>(bytes.data()) + offset, size);
  for (const char c : name) {
    const bool fine = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == '.' || c == '-';
    if (!fine) return std::nullopt;
  }
  return name;
}

/// @param free in: end of the member before; out: end of this one
std::string readMember(std::span<const std::byte> file, std::size_t at, Entry& entry,
                       std::size_t& next, std::size_t& free) {
  if (at > file.size() || file.size() - at < kDirectorySize ||
      take<std::uint32_t>(file, at) != kDirectoryMagic) {
    return "its directory is damaged";
  }
  const auto method = take<std::uint16_t>(file, at + 10);
  const auto crc = take<std::uint32_t>(file, at + 16);
  const std::size_t packed = take<std::uint32_t>(file, at + 20);
  const std::size_t size = take<std::uint32_t>(file, at + 24);
  const std::size_t nameSize = take<std::uint16_t>(file, at + 28);
  const std::size_t skip =
      std::size_t{take<std::uint16_t>(file, at + 30)} + take<std::uint16_t>(file, at + 32);
  const std::size_t local = take<std::uint32_t>(file, at + 42);
  const auto name = takeName(file, at + kDirectorySize, nameSize);
  if (!name) return "a member has a bad name";
  if (method != 0 || packed != size)
    return "member " + *name + " is compressed, expected it stored";
  // Members that overlap would make a small file take long to check.
  if (local < free || local > file.size() || file.size() - local < kLocalSize ||
      take<std::uint32_t>(file, local) != kLocalMagic) {
    return "member " + *name + " is damaged";
  }
  const std::size_t data = local + kLocalSize + take<std::uint16_t>(file, local + 26) +
                           take<std::uint16_t>(file, local + 28);
  if (data > file.size() || size > file.size() - data) return "member " + *name + " is cut off";
  entry = {*name, file.subspan(data, size)};
  if (crc32(entry.bytes) != crc) return "the checksum of member " + *name + " is wrong";
  next = at + kDirectorySize + nameSize + skip;
  free = data + size;
  return "";
}

}  // namespace

std::string localHeader(const Member& member) {
  const std::size_t bare = member.headerOffset + kLocalSize + member.name.size();
  // An extra field takes at least 4 bytes.
  const std::size_t extra = 4 + (kAlignment - (bare + 4) % kAlignment) % kAlignment;
  std::string out;
  put(out, kLocalMagic);
  put(out, kVersion);
  put(out, std::uint16_t{0});  // flags
  put(out, std::uint16_t{0});  // stored
  put(out, std::uint16_t{0});  // time
  put(out, kDate);
  put(out, member.crc);
  put(out, member.size);
  put(out, member.size);
  put(out, static_cast<std::uint16_t>(member.name.size()));
  put(out, static_cast<std::uint16_t>(extra));
  out += member.name;
  put(out, kExtraId);
  put(out, static_cast<std::uint16_t>(extra - 4));
  out.append(extra - 4, '\0');
  return out;
}

std::string directory(const std::vector<Member>& members, std::uint32_t offset) {
  std::string out;
  for (const Member& member : members) {
    put(out, kDirectoryMagic);
    put(out, kVersion);
    put(out, kVersion);
    put(out, std::uint16_t{0});
    put(out, std::uint16_t{0});
    put(out, std::uint16_t{0});
    put(out, kDate);
    put(out, member.crc);
    put(out, member.size);
    put(out, member.size);
    put(out, static_cast<std::uint16_t>(member.name.size()));
    for (int i = 0; i < 4; ++i) put(out, std::uint16_t{0});  // extra, comment, disk, attributes
    put(out, std::uint32_t{0});
    put(out, member.headerOffset);
    out += member.name;
  }
  const auto size = static_cast<std::uint32_t>(out.size());
  put(out, kEndMagic);
  put(out, std::uint16_t{0});
  put(out, std::uint16_t{0});
  put(out, static_cast<std::uint16_t>(members.size()));
  put(out, static_cast<std::uint16_t>(members.size()));
  put(out, size);
  put(out, offset);
  put(out, std::uint16_t{0});
  return out;
}

std::string read(std::span<const std::byte> file, std::vector<Entry>& entries) {
  entries.clear();
  if (file.size() < kEndSize || take<std::uint32_t>(file, file.size() - kEndSize) != kEndMagic) {
    return "it is no table file, or cut off: the end record is missing";
  }
  const std::size_t end = file.size() - kEndSize;
  const std::size_t count = take<std::uint16_t>(file, end + 10);
  std::size_t at = take<std::uint32_t>(file, end + 16);
  if (at > end || take<std::uint32_t>(file, end + 12) != end - at)
    return "its directory is damaged";
  std::size_t free = 0;
  std::set<std::string> names;
  for (std::size_t i = 0; i < count; ++i) {
    Entry entry;
    if (const std::string why = readMember(file, at, entry, at, free); !why.empty()) return why;
    if (!names.insert(entry.name).second) return "member " + entry.name + " occurs twice";
    entries.push_back(std::move(entry));
  }
  return at == end ? "" : "its directory is damaged";
}

}  // namespace ortung::zip
