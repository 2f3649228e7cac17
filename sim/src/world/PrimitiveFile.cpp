#include "PrimitiveFile.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMaxNameLength = 64;
constexpr Range kHeight{-100.0, 1000.0};  ///< heights [m]
constexpr Range kAngle{-3600.0, 3600.0};  ///< angles [degree]

void readTriangle(const Parameters& table, Primitive& triangle) {
  const auto c = table.numbers("corners_m", 6, kCoordinate);
  triangle.corners = {Point2{c[0], c[1]}, Point2{c[2], c[3]}, Point2{c[4], c[5]}};
  triangle.centre = {(c[0] + c[2] + c[4]) / 3.0, (c[1] + c[3] + c[5]) / 3.0};
  const double twiceArea = (c[2] - c[0]) * (c[5] - c[1]) - (c[4] - c[0]) * (c[3] - c[1]);
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(
        longest, std::hypot(c[(2 * i + 2) % 6] - c[2 * i], c[(2 * i + 3) % 6] - c[2 * i + 1]));
  // The smallest height of the triangle is checked. Rounding must not refuse one of a millimetre.
  if (!(std::abs(twiceArea) >= kSize.low * longest * (1.0 - 1e-6)) || longest == 0.0)
    table.fail("corners_m",
               "are on one line, or nearly: of a triangle " +
                   std::to_string(longest > 0.0 ? std::abs(twiceArea) / longest : 0.0) +
                   " m high, expected x1, y1, x2, y2, x3, y3 of one of at least "
                   "0.001");
}

}  // namespace

bool isWord(const std::string& text) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !text.empty() && text.size() <= kMaxNameLength &&
         std::all_of(text.begin(), text.end(), fits);
}

void checkPrintable(const Parameters& table, const std::string& key, const std::string& text) {
  const bool printable = std::none_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
  if (text.size() > kMaxNameLength || !printable)
    table.fail(key, "must be a text of at most 64 printable characters");
}

std::string readColour(const Parameters& table) {
  const std::string colour = table.textOr("colour", "");
  if (!colour.empty() && !isWord(colour[0] == '#' ? colour.substr(1) : colour))
    table.fail("colour", "is \"" + colour + "\", expected a name or \"#rrggbb\"");
  return colour;
}

void readHeights(const Parameters& table, Primitive& primitive) {
  const auto z = table.numbersOr("z_m", {primitive.zLow, primitive.zHigh}, 2, kHeight);
  if (!(z[1] - z[0] >= kSize.low))
    table.fail("z_m", "must be [low, high] with high at least 0.001 m above low");
  primitive.zLow = z[0];
  primitive.zHigh = z[1];
}

void readOutline(const Parameters& table, Primitive& primitive) {
  if (primitive.shape == Primitive::Shape::kTriangle) {
    readTriangle(table, primitive);
    return;
  }
  const auto centre = table.numbers("center_m", 2, kCoordinate);
  const auto size = table.numbers("size_m", 2, kSize);
  primitive.centre = {centre[0], centre[1]};
  primitive.halfX = 0.5 * size[0];
  primitive.halfY = 0.5 * size[1];
  primitive.angle = radians(table.numberOr("angle_deg", 0.0, kAngle));
}

}  // namespace ortung
