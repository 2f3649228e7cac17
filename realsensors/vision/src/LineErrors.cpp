#include "ortung/vision/LineErrors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace ortung {
namespace {

constexpr double kOutlier = 3.0;
constexpr double kMostAlike = 20.0;
constexpr int kFewest = 10;  ///< pairs of neighbours from which a correlation can be told

/// An error with the side of the line on which its point is.
struct SignedError {
  std::size_t picture, line;
  double along;  ///< position along the line; increases in one direction
  double error;
};

SignedError signedError(const FieldLines& field, const LineError& e) {
  double least = std::numeric_limits<double>::max();
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < field.lines().size(); ++i) {
    const double d = field.nearestOn(i, e.place.x, e.place.y).distance;
    if (d < least) least = d, nearest = i;
  }
  const FieldLine& line = field.lines()[nearest];
  if (line.shape == FieldLine::Shape::kStraight) {
    const double dx = line.x1 - line.x0;
    const double dy = line.y1 - line.y0;
    const double x = e.place.x - line.x0;
    const double y = e.place.y - line.y0;
    return {e.picture, nearest, x * dx + y * dy, std::copysign(e.error, dx * y - dy * x)};
  }
  const double c = std::cos(line.angle);
  const double s = std::sin(line.angle);
  const double x = (c * (e.place.x - line.x) + s * (e.place.y - line.y)) / line.radiusX;
  const double y = (c * (e.place.y - line.y) - s * (e.place.x - line.x)) / line.radiusY;
  return {e.picture, nearest, std::atan2(y, x), std::copysign(e.error, std::hypot(x, y) - 1.0)};
}

}  // namespace

double alikeness(const FieldLines& field, std::span<const LineError> errors) {
  std::vector<SignedError> all;
  for (const LineError& e : errors)
    if (e.error < kOutlier) all.push_back(signedError(field, e));
  std::sort(all.begin(), all.end(), [](const SignedError& a, const SignedError& b) {
    return std::tie(a.picture, a.line, a.along) < std::tie(b.picture, b.line, b.along);
  });
  double squares = 0.0;
  double products = 0.0;
  int pairs = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const SignedError& a = all[i - 1];
    const SignedError& b = all[i];
    if (a.picture != b.picture || a.line != b.line) continue;
    squares += 0.5 * (a.error * a.error + b.error * b.error);
    products += a.error * b.error;
    ++pairs;
  }
  if (pairs < kFewest || !(squares > 0.0)) return 1.0;
  const double correlation = std::clamp(products / squares, 0.0, 0.999);
  return std::min(kMostAlike, (1.0 + correlation) / (1.0 - correlation));
}

}  // namespace ortung
