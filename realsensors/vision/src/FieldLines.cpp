#include "ortung/vision/FieldLines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

FieldLines::Nearest nearestOnStraight(const FieldLine& line, double x, double y) {
  const double dx = line.x1 - line.x0;
  const double dy = line.y1 - line.y0;
  const double squared = dx * dx + dy * dy;
  const double along =
      squared > 0.0 ? std::clamp(((x - line.x0) * dx + (y - line.y0) * dy) / squared, 0.0, 1.0)
                    : 0.0;
  FieldLines::Nearest n{line.x0 + along * dx, line.y0 + along * dy, 0.0};
  n.distance = std::hypot(x - n.x, y - n.y);
  return n;
}

/// Exact for circles; for an ellipse it is the point with the same parametric angle t.
FieldLines::Nearest nearestOnArc(const FieldLine& line, double x, double y) {
  const double c = std::cos(line.angle);
  const double s = std::sin(line.angle);
  const double px = c * (x - line.x) + s * (y - line.y);
  const double py = c * (y - line.y) - s * (x - line.x);
  if (line.width >= 2.0 * std::min(line.radiusX, line.radiusY) * 0.999 &&
      std::hypot(px / line.radiusX, py / line.radiusY) <= 2.0)
    return {x, y, 0.0};  // on a filled spot
  const auto place = [&](double t) {
    const double qx = line.radiusX * std::cos(t);
    const double qy = line.radiusY * std::sin(t);
    FieldLines::Nearest n{line.x + c * qx - s * qy, line.y + s * qx + c * qy, 0.0};
    n.distance = std::hypot(x - n.x, y - n.y);
    return n;
  };
  double t = std::atan2(py / line.radiusY, px / line.radiusX);
  while (t < line.from) t += kTurn;
  while (t > line.from + kTurn) t -= kTurn;
  if (t <= line.to) return place(t);
  const FieldLines::Nearest begin = place(line.from);
  const FieldLines::Nearest end = place(line.to);
  return begin.distance < end.distance ? begin : end;
}

}  // namespace

FieldLines::FieldLines(std::span<const FieldLine> lines) : lines_(lines.begin(), lines.end()) {
  // What has no width is the border of a painted area, not a line.
  std::erase_if(lines_, [](const FieldLine& line) { return line.width <= 0.0; });
  if (lines_.empty()) throw std::invalid_argument("the world has no painted lines");
  if (lines_.size() > 10000)
    throw std::invalid_argument("the world has " + std::to_string(lines_.size()) +
                                " painted lines, expected at most 10000");
  xMin_ = yMin_ = std::numeric_limits<double>::max();
  xMax_ = yMax_ = std::numeric_limits<double>::lowest();
  const auto hold = [this](double x, double y) {
    xMin_ = std::min(xMin_, x);
    xMax_ = std::max(xMax_, x);
    yMin_ = std::min(yMin_, y);
    yMax_ = std::max(yMax_, y);
  };
  for (const FieldLine& line : lines_) {
    if (line.shape == FieldLine::Shape::kStraight) {
      hold(line.x0, line.y0);
      hold(line.x1, line.y1);
    } else {
      const double most = std::max(line.radiusX, line.radiusY);
      hold(line.x - most, line.y - most);
      hold(line.x + most, line.y + most);
    }
  }
}

FieldLines::Nearest FieldLines::nearestOn(std::size_t line, double x, double y) const {
  const FieldLine& one = lines_[line];
  return one.shape == FieldLine::Shape::kStraight ? nearestOnStraight(one, x, y)
                                                  : nearestOnArc(one, x, y);
}

FieldLines::Nearest FieldLines::nearest(double x, double y) const {
  Nearest best{0.0, 0.0, std::numeric_limits<double>::max()};
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Nearest n = nearestOn(i, x, y);
    if (n.distance < best.distance) best = n;
  }
  return best;
}

}  // namespace ortung
