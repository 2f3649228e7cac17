#pragma once

#include <string>
#include <string_view>

/// Small PNG images in hexadecimal, of all kinds of pixels (PNG specification, 11.2.2).
namespace ortung::test {

/// 3 x 2 grey pixels of 8 bits, with a comment.
constexpr std::string_view kGrey =
    "89504e470d0a1a0a0000000d4948445200000003000000020800000000b81f39c60000000b74455874436f"
    "6d6d656e74006d6170e866b067000000104944415478da63f8f78f81e1ecbf7f00124f04c62e7939e90000"
    "000049454e44ae426082";
/// 3 x 2 grey pixels of 1 bit.
constexpr std::string_view kBits =
    "89504e470d0a1a0a0000000d4948445200000003000000020100000000b50f5bb70000000c4944415478da"
    "6338c090000002a401219e5751a00000000049454e44ae426082";
/// 3 x 2 pixels of a palette, one of its colours transparent.
constexpr std::string_view kPalette =
    "89504e470d0a1a0a0000000d4948445200000003000000020203000000e01a8e8900000009504c5445fefe"
    "fe000000cdcdcd0101a4290000000374524e53ffff00d7ca0d410000000c4944415478da63906098000000"
    "dc00a9521a138f0000000049454e44ae426082";
/// 2 x 2 colours of 16 bits with alpha, interlaced.
constexpr std::string_view kInterlaced =
    "89504e470d0a1a0a0000000d49484452000000020000000210060000015521e1f10000001a4944415478da"
    "63f80706ffff33400090f10f0cffff87d00c0c0065d111e350c2fa8d0000000049454e44ae426082";

inline std::string fromHex(std::string_view hexadecimal) {
  std::string bytes;
  for (std::size_t i = 0; i < hexadecimal.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(hexadecimal.substr(i, 2)), nullptr, 16));
  return bytes;
}

}  // namespace ortung::test
