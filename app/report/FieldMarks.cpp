#include "FieldMarks.hpp"

#include <cmath>

namespace ortung::app {

std::vector<std::array<double, 2>> pointsOf(const FieldLine& line) {
  if (line.shape == FieldLine::Shape::kStraight) return {{line.x0, line.y0}, {line.x1, line.y1}};
  constexpr int kPieces = 48;
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i <= kPieces; ++i) {
    const double t = line.from + (line.to - line.from) * i / kPieces;
    const double along = line.radiusX * std::cos(t);
    const double across = line.radiusY * std::sin(t);
    points.push_back({line.x + along * std::cos(line.angle) - across * std::sin(line.angle),
                      line.y + along * std::sin(line.angle) + across * std::cos(line.angle)});
  }
  return points;
}

}  // namespace ortung::app
