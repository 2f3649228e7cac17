#pragma once

#include <cstdint>
#include <string_view>

// The format's constants, which writer and reader share.
namespace ortung::chunk {

inline constexpr int kOfOrtung = 13;  ///< variant of skippable frames: magic, heads, index
inline constexpr int kApart = 14;     ///< variant of skippable frames that hold a reading
inline constexpr std::string_view kChunkTag = "CHNK";
inline constexpr std::string_view kIndexTag = "INDX";
inline constexpr std::string_view kIndexEnd = "ORTINDEX";

/// How far apart bytes may be whose differences are kept: not at all, or as far as those of pixels
/// that are grey, coloured, and coloured with a fourth byte.
inline constexpr std::uint32_t kStrides[] = {0, 1, 3, 4};
constexpr bool isStride(std::uint32_t number) { return number <= 4 && number != 2; }

}  // namespace ortung::chunk
