#include "LineMesh.hpp"

#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr double kPiece = 2.0;  ///< longest piece of a straight line [m]
/// Step of an arc's parameter [rad]: an error of 0.6 mm for a radius of 2 m.
constexpr double kArcStep = 0.05;
constexpr std::size_t kMostVertices = std::size_t{1} << 22;
constexpr Rgba kWhite{255, 255, 255, 255};
constexpr double kEndless = 2000.0;  ///< length of a line without ends [m]

}  // namespace

void LineMesh::add(const FieldLine& line) {
  const Rgba colour = rgbaOf(line.colour, kWhite);
  if (scene_.lines.size() > kMostVertices || !(line.width > 0.0)) return;
  if (line.shape == FieldLine::Shape::kStraight)
    addStraight(line, colour);
  else
    addArc(line, colour);
}

void LineMesh::addStraight(const FieldLine& line, Rgba colour) {
  const double length = std::hypot(line.x1 - line.x0, line.y1 - line.y0);
  if (!(length > 0.0)) return;
  const double dx = (line.x1 - line.x0) / length;
  const double dy = (line.y1 - line.y0) / length;
  const int pieces = std::clamp(static_cast<int>(std::ceil(length / kPiece)), 1, 4096);
  const auto node = [&](int i) {
    const double at = length * i / pieces;
    const double end = i == 0 ? -1.0 : i == pieces ? 1.0 : 0.0;
    return Node{line.x0 + at * dx - scene_.middle.x,
                line.y0 + at * dy - scene_.middle.y,
                -dy,
                dx,
                end * dx,
                end * dy,
                at};
  };
  for (int i = 0; i < pieces; ++i) piece(node(i), node(i + 1), 0.5 * line.width, length, colour);
}

void LineMesh::addArc(const FieldLine& line, Rgba colour) {
  // A filled circle; its middle line runs at half its radius.
  const bool isSpot = line.radiusX == line.radiusY && line.width >= 2.0 * line.radiusX &&
                      line.to - line.from > kTurn - 1e-6;
  if (isSpot) return addSpot(line.x, line.y, line.radiusX + 0.5 * line.width, colour);
  const bool isClosed = line.to - line.from > kTurn - 1e-6;
  const int pieces =
      std::clamp(static_cast<int>(std::ceil((line.to - line.from) / kArcStep)), 1, 4096);
  const double cos = std::cos(line.angle);
  const double sin = std::sin(line.angle);
  std::vector<Node> nodes;
  for (int i = 0; i <= pieces; ++i) {
    const double t = line.from + (line.to - line.from) * i / pieces;
    const double x = line.radiusX * std::cos(t);
    const double y = line.radiusY * std::sin(t);
    const double speed = std::hypot(line.radiusX * std::sin(t), line.radiusY * std::cos(t));
    if (!(speed > 0.0)) return;
    const double tx = -line.radiusX * std::sin(t) / speed;
    const double ty = line.radiusY * std::cos(t) / speed;
    const double end = isClosed ? 0.0 : i == 0 ? -1.0 : i == pieces ? 1.0 : 0.0;
    const double fx = cos * tx - sin * ty;
    const double fy = sin * tx + cos * ty;
    nodes.push_back({line.x + cos * x - sin * y - scene_.middle.x,
                     line.y + sin * x + cos * y - scene_.middle.y, -fy, fx, end * fx, end * fy,
                     nodes.empty() ? 0.0 : nodes.back().along});
    if (nodes.size() < 2) continue;
    const Node& last = nodes[nodes.size() - 2];
    nodes.back().along += std::hypot(nodes.back().x - last.x, nodes.back().y - last.y);
  }
  const double length = isClosed ? kEndless : nodes.back().along;
  if (isClosed)
    for (Node& node : nodes) node.along = 0.5 * kEndless;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    piece(nodes[i - 1], nodes[i], 0.5 * line.width, length, colour);
}

void LineMesh::addSpot(double x, double y, double radius, Rgba colour) {
  const std::size_t first = scene_.lines.size();
  const auto corner = [&](float u, float v) {
    // Its corners are enlarged like those of lines; `end` is the second direction.
    return LineVertex{static_cast<float>(x - scene_.middle.x),
                      static_cast<float>(y - scene_.middle.y),
                      0.0F,
                      1.0F,
                      v,
                      0.0F,
                      u,
                      -static_cast<float>(radius),
                      0.0F,
                      0.0F,
                      colour};
  };
  for (const auto& [u, v] : {std::pair{-1.0F, -1.0F}, {-1.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, -1.0F}})
    scene_.lines.push_back(corner(u, v));
  close(first);
}

void LineMesh::piece(const Node& from, const Node& to, double half, double length, Rgba colour) {
  const std::size_t first = scene_.lines.size();
  const auto corner = [&](const Node& node, float side) {
    return LineVertex{static_cast<float>(node.x),
                      static_cast<float>(node.y),
                      static_cast<float>(node.acrossX),
                      static_cast<float>(node.acrossY),
                      static_cast<float>(node.endX),
                      static_cast<float>(node.endY),
                      side,
                      static_cast<float>(half),
                      static_cast<float>(node.along),
                      static_cast<float>(length),
                      colour};
  };
  const LineVertex a = corner(from, -1.0F), b = corner(to, -1.0F);
  const LineVertex c = corner(to, 1.0F), d = corner(from, 1.0F);
  scene_.lines.insert(scene_.lines.end(), {a, b, c, d});
  close(first);
}

/// Makes a chunk of the vertices from @p firstVertex on.
void LineMesh::close(std::size_t firstVertex) {
  Chunk chunk;
  chunk.first = static_cast<std::uint32_t>(firstVertex);
  chunk.count = static_cast<std::uint32_t>(scene_.lines.size() - firstVertex);
  double xLow = 1e9, xHigh = -1e9, yLow = 1e9, yHigh = -1e9, half = 0.0;
  for (std::size_t i = firstVertex; i < scene_.lines.size(); ++i) {
    const LineVertex& v = scene_.lines[i];
    xLow = std::min<double>(xLow, v.x);
    xHigh = std::max<double>(xHigh, v.x);
    yLow = std::min<double>(yLow, v.y);
    yHigh = std::max<double>(yHigh, v.y);
    half = std::max<double>(half, std::abs(v.half));
  }
  chunk.x = 0.5 * (xLow + xHigh);
  chunk.y = 0.5 * (yLow + yHigh);
  chunk.reach = 0.5 * std::hypot(xHigh - xLow, yHigh - yLow) + 1.5 * half;
  scene_.lineChunks.push_back(chunk);
}

}  // namespace ortung
