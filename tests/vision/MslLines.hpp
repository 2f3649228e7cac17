#pragma once

#include <numbers>
#include <vector>

#include "ortung/tables/FieldModel.hpp"

namespace ortung {

/// Sizes of an MSL field as the rules name them [m].
struct MslSizes {
  double length = 22.0, width = 14.0;
  double penaltyWidth = 6.9, penaltyDepth = 2.25;
  double goalWidth = 3.9, goalDepth = 0.75;
  double circle = 4.0;  ///< diameter
  double corner = 0.75, mark = 3.6, markSize = 0.15, line = 0.125;
};

/// Its lines, x along the length, from outer edges as the rules measure them.
inline std::vector<FieldLine> mslLines(const MslSizes& m) {
  std::vector<FieldLine> lines;
  const auto straight = [&](double x0, double y0, double x1, double y1) {
    FieldLine line;
    line.x0 = x0, line.y0 = y0, line.x1 = x1, line.y1 = y1, line.width = m.line;
    lines.push_back(line);
  };
  const auto arc = [&](double x, double y, double radius, double from, double to, double width) {
    FieldLine line;
    line.shape = FieldLine::Shape::kArc;
    line.x = x, line.y = y, line.radiusX = line.radiusY = radius;
    line.from = from, line.to = to, line.width = width;
    lines.push_back(line);
  };
  const double half = 0.5 * m.line;
  const double x = 0.5 * m.length - half;
  const double y = 0.5 * m.width - half;
  for (const double side : {-1.0, 1.0}) {
    straight(-x, side * y, x, side * y);
    straight(side * x, -y, side * x, y);
    for (const auto& [depth, width] :
         {std::pair{m.penaltyDepth, m.penaltyWidth}, {m.goalDepth, m.goalWidth}}) {
      const double front = side * (0.5 * m.length - depth + half);
      const double edge = 0.5 * width - half;
      straight(front, -edge, front, edge);
      straight(side * x, edge, front, edge);
      straight(side * x, -edge, front, -edge);
    }
    const double spot = side * (0.5 * m.length - m.mark);
    arc(spot, 0.0, 0.5 * m.markSize, 0.0, 2.0 * std::numbers::pi, m.markSize);
  }
  straight(0.0, -y, 0.0, y);
  arc(0.0, 0.0, 0.5 * m.circle - half, 0.0, 2.0 * std::numbers::pi, m.line);
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  for (int k = 0; k < 4 && m.corner > 0.0; ++k)
    arc(k == 0 || k == 3 ? -x : x, k < 2 ? -y : y, m.corner - half, k * kQuarter,
        (k + 1) * kQuarter, m.line);
  return lines;
}

}  // namespace ortung
