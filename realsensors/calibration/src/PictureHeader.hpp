#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace ortung {

/// The size of a picture as its header has it [px].
struct HeaderSize {
  std::int64_t width = 0;
  std::int64_t height = 0;
};

/// Reads the size of a PNG, JPEG, BMP, PGM or PPM file before anything is decoded: pictures are as
/// large as they say, whatever their files' size. Nothing for other formats and for headers that
/// end early.
std::optional<HeaderSize> headerSize(std::string_view bytes);

}  // namespace ortung
