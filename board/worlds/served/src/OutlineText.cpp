#include "OutlineText.hpp"

#include <cmath>
#include <numbers>

#include "ortung/server/FieldText.hpp"

namespace ortung {
namespace {

constexpr int kCornersOfEllipse = 24;

/// Corners of a piece in the frame that it lies in, in order.
std::vector<Point2> outlineOf(const Primitive& piece) {
  if (piece.shape != Primitive::Shape::kEllipse) return cornersOf(piece);
  std::vector<Point2> corners;
  for (int i = 0; i < kCornersOfEllipse; ++i) {
    const double t = 2.0 * std::numbers::pi * i / kCornersOfEllipse;
    const double x = piece.halfX * std::cos(t);
    const double y = piece.halfY * std::sin(t);
    corners.push_back({piece.centre.x + x * std::cos(piece.angle) - y * std::sin(piece.angle),
                       piece.centre.y + x * std::sin(piece.angle) + y * std::cos(piece.angle)});
  }
  return corners;
}

/// To a tenth of a millimetre.
std::string coordinate(double metres) {
  return keyValue("", std::round(metres * 1e4) / 1e4).substr(2);  // behind " ="
}

/// @param what what the line begins with
std::string pieceText(const Primitive& piece, const std::string& what, const std::string& colour) {
  std::string text = what + keyValue("z0_m", piece.zLow) + keyValue("z1_m", piece.zHigh) +
                     colourText(piece.colour.empty() ? colour : piece.colour);
  for (const Point2& corner : outlineOf(piece))
    text += " " + coordinate(corner.x) + "," + coordinate(corner.y);
  return text;
}

/// Whether its sides are lines "wall" already.
bool isWall(const Primitive& piece) {
  const bool isUpright = piece.kind == "wall" || piece.kind == "goal";
  return isUpright && piece.shape == Primitive::Shape::kRectangle;
}

}  // namespace

std::vector<std::string> outlineText(const RobotShape& shape) {
  std::vector<std::string> lines;
  for (const Primitive& piece : shape.pieces)
    lines.push_back(pieceText(piece, "outline", shape.colour));
  for (const Manipulator& manipulator : shape.manipulators)
    for (const ManipulatorState& state : manipulator.states)
      for (const Primitive& piece : state.pieces)
        lines.push_back(
            pieceText(piece, "outline manipulator=" + manipulator.name + " state=" + state.name,
                      shape.colour));
  return lines;
}

std::vector<std::string> solidText(const Solids& solids) {
  constexpr std::size_t kMost = 4096;
  std::vector<std::string> lines;
  for (const Primitive& piece : solids.primitives) {
    if (isWall(piece) || !piece.isSolid() || piece.isMovable) continue;
    if (lines.size() == kMost) break;
    lines.push_back(pieceText(piece, "solid", ""));
  }
  return lines;
}

}  // namespace ortung
