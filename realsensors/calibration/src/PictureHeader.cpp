#include "PictureHeader.hpp"

#include <array>
#include <charconv>
#include <cstdlib>

namespace ortung {
namespace {

using namespace std::string_view_literals;

/// The fields of a header, none of which may lie behind its end.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}

  bool has(std::size_t at, std::size_t count) const {
    return at <= bytes_.size() && count <= bytes_.size() - at;
  }
  std::uint32_t byte(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }
  std::uint32_t big16(std::size_t at) const { return byte(at) << 8 | byte(at + 1); }
  std::uint32_t big32(std::size_t at) const { return big16(at) << 16 | big16(at + 2); }
  std::uint32_t little16(std::size_t at) const { return byte(at) | byte(at + 1) << 8; }
  std::int32_t little32(std::size_t at) const {
    return static_cast<std::int32_t>(little16(at) | little16(at + 2) << 16);
  }

 private:
  std::string_view bytes_;
};

/// PNG (ISO/IEC 15948), 11.2.2: IHDR comes first.
std::optional<HeaderSize> pngSize(std::string_view bytes) {
  constexpr std::size_t kSize = 16;
  const Fields fields(bytes);
  if (!fields.has(kSize, 8) || bytes.substr(12, 4) != "IHDR") return std::nullopt;
  return HeaderSize{fields.big32(kSize), fields.big32(kSize + 4)};
}

/// JPEG (ITU-T T.81), B.2.2: the first frame header, behind any number of other segments.
std::optional<HeaderSize> jpegSize(std::string_view bytes) {
  const Fields fields(bytes);
  std::size_t at = 2;
  while (fields.has(at, 4)) {
    const std::uint32_t marker = fields.byte(at + 1);
    if (fields.byte(at) != 0xFF) return std::nullopt;
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    const bool isFrame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 &&
                         marker != 0xCC;  // those are tables, and reserved
    if (isFrame)
      return fields.has(at, 9)
                 ? std::optional(HeaderSize{fields.big16(at + 7), fields.big16(at + 5)})
                 : std::nullopt;
    if (marker == 0xD9 || marker == 0xDA) return std::nullopt;  // the end, or data of no frame
    const bool isBare = marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
    at += isBare ? 2 : 2 + fields.big16(at + 2);
  }
  return std::nullopt;
}

/// BMP: OS/2's head has 16 bits a side, all later ones have 32; rows from the top: height < 0.
std::optional<HeaderSize> bmpSize(std::string_view bytes) {
  constexpr std::size_t kHead = 14;
  const Fields fields(bytes);
  if (!fields.has(kHead, 12)) return std::nullopt;
  if (fields.little32(kHead) == 12) return HeaderSize{fields.little16(18), fields.little16(20)};
  return HeaderSize{fields.little32(18), std::llabs(fields.little32(22))};
}

/// PGM and PPM: two numbers behind blanks and comments.
std::optional<HeaderSize> pnmSize(std::string_view bytes) {
  std::array<std::int64_t, 2> numbers{};
  std::size_t at = 2;
  for (std::int64_t& number : numbers) {
    while (at < bytes.size() && (" \t\r\n#"sv.find(bytes[at]) != std::string_view::npos)) {
      if (bytes[at] == '#') at = std::min(bytes.find('\n', at), bytes.size() - 1);
      ++at;
    }
    const auto [end, error] =
        std::from_chars(bytes.data() + at, bytes.data() + bytes.size(), number);
    if (error != std::errc()) return std::nullopt;
    at = static_cast<std::size_t>(end - bytes.data());
  }
  return HeaderSize{numbers[0], numbers[1]};
}

}  // namespace

std::optional<HeaderSize> headerSize(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1A\n"sv)) return pngSize(bytes);
  if (bytes.starts_with("\xFF\xD8\xFF"sv)) return jpegSize(bytes);
  if (bytes.starts_with("BM")) return bmpSize(bytes);
  for (const std::string_view magic : {"P2"sv, "P3"sv, "P5"sv, "P6"sv})
    if (bytes.starts_with(magic)) return pnmSize(bytes);
  return std::nullopt;
}

}  // namespace ortung
