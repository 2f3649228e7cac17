#include "ortung/vision/LinePoseVerdict.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "ortung/base/Angles.hpp"
#include "ortung/vision/LineErrors.hpp"

namespace ortung {
namespace {

constexpr double kNear = 5.0;         ///< [m]
constexpr double kMostCost = 9.0;     ///< greatest cost of a point, see LinePose
constexpr double kMatched = 3.0;      ///< greatest distance of a point on a line / sigma
constexpr double kLeastNoise = 0.09;  ///< least square of points' errors / their sigma
constexpr double kSamePlace = 0.3;    ///< poses nearer to each other are of one place [m]
constexpr double kSameHeading = 0.1;  ///< [rad]
constexpr double kAnywhere = 10.0;    ///< sigma of a place of which nothing is known [m]
constexpr double kAnyHeading = 3.0;   ///< [rad]

/// Returns the middle around which half a turn maps the field's lines onto themselves.
std::optional<LinePlace> middleOfHalfTurn(const LinePoseSearch& field) {
  const FieldLines& lines = field.lines();
  const LinePlace middle{0.5 * (lines.xMin() + lines.xMax()), 0.5 * (lines.yMin() + lines.yMax())};
  constexpr double kSame = 0.02;  // [m]
  const auto isOnLine = [&](double x, double y) {
    return lines.nearest(2.0 * middle.x - x, 2.0 * middle.y - y).distance < kSame;
  };
  for (const FieldLine& line : lines.lines()) {
    for (const double share : {0.0, 0.3, 0.5, 0.8, 1.0}) {
      double x = line.x0 + share * (line.x1 - line.x0);
      double y = line.y0 + share * (line.y1 - line.y0);
      if (line.shape == FieldLine::Shape::kArc) {
        const double t = line.from + share * (line.to - line.from);
        const double px = line.radiusX * std::cos(t);
        const double py = line.radiusY * std::sin(t);
        x = line.x + std::cos(line.angle) * px - std::sin(line.angle) * py;
        y = line.y + std::sin(line.angle) * px + std::cos(line.angle) * py;
      }
      if (!isOnLine(x, y)) return std::nullopt;
    }
  }
  return middle;
}

bool isSame(const Pose2& a, const Pose2& b) {
  return distance(a, b) < kSamePlace && std::abs(wrapAngle(a.theta - b.theta)) < kSameHeading;
}

/// The best pose that is of another place.
std::optional<LinePose> rivalOf(const LinePoseSearch& field, std::span<const LinePlace> points,
                                std::span<const double> sigmas, const Pose2& pose) {
  const auto middle = middleOfHalfTurn(field);
  for (const LinePose& other : field.search(points, sigmas, 5)) {
    if (isSame(other.pose, pose)) continue;
    if (middle && isSame({2.0 * middle->x - other.pose.x, 2.0 * middle->y - other.pose.y,
                          wrapAngle(other.pose.theta + std::numbers::pi)},
                         pose))
      continue;
    return other;
  }
  return std::nullopt;
}

/// Returns the unit normal of the line at a point; nothing on a filled spot.
std::optional<LinePlace> normalAt(const LinePoseSearch& field, const Pose2& at,
                                  const FieldLines::Nearest& n) {
  constexpr double kOnLine = 1e-6;  // [m]
  if (n.distance > kOnLine) return LinePlace{(at.x - n.x) / n.distance, (at.y - n.y) / n.distance};
  // The nearest place of a point beside follows along the line.
  constexpr double kBeside = 1e-3;  // [m]
  const FieldLines::Nearest x = field.nearest(at.x + kBeside, at.y);
  const FieldLines::Nearest y = field.nearest(at.x, at.y + kBeside);
  const bool isAlongX = std::hypot(x.x - n.x, x.y - n.y) > std::hypot(y.x - n.x, y.y - n.y);
  const double dx = isAlongX ? x.x - n.x : y.x - n.x;
  const double dy = isAlongX ? x.y - n.y : y.y - n.y;
  const double length = std::hypot(dx, dy);
  if (length < 0.5 * kBeside || (x.distance < kOnLine && y.distance < kOnLine)) return std::nullopt;
  return LinePlace{-dy / length, dx / length};
}

/// What the points say of a pose: see LineFit::certainty() for the formula.
struct Fit {
  Eigen::Matrix3d covariance;
  double alike = 1.0;
  int near = 0;
  int stray = 0;  ///< points that are on no line
  double cost = 0.0;
};

Fit fitOf(const LinePoseSearch& field, std::span<const LinePlace> points,
          std::span<const double> sigmas, const Pose2& pose) {
  Fit fit;
  Eigen::Matrix3d curved = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  std::vector<LineError> errors;
  const double count = static_cast<double>(points.size());
  // Few points are fitted well by chance: that does not make them exact.
  const double least = std::clamp(3.0 / std::max(1.0, count), kLeastNoise, 1.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Pose2 at = pose * Pose2{points[i].x, points[i].y, 0.0};
    const FieldLines::Nearest n = field.nearest(at.x, at.y);
    const double r = n.distance / sigmas[i];
    errors.push_back({0, {at.x, at.y}, r});
    fit.cost += std::min(r * r, kMostCost);
    if (std::hypot(points[i].x, points[i].y) <= kNear) ++fit.near;
    if (r > kMatched) ++fit.stray;
    const auto normal = normalAt(field, at, n);
    if (!normal) continue;
    const auto [nx, ny] = *normal;
    const double d = 1.0 + r * r / 4.0;  // polish()'s loss of Geman and McClure
    const Eigen::Vector3d slope(nx, ny, ny * (at.x - pose.x) - nx * (at.y - pose.y));
    const Eigen::Matrix3d square = slope * slope.transpose() / (sigmas[i] * sigmas[i]);
    curved += square * std::max(0.0, 1.0 - 3.0 * r * r / 4.0) / (d * d * d);
    noise += square * std::max(r * r, least) / (d * d * d * d);
  }
  fit.alike = alikeness(field.lines(), errors);
  noise *= fit.alike * count / std::max(0.25 * count, count - 3.0);
  const Eigen::Vector3d anywhere(1.0 / (kAnywhere * kAnywhere), 1.0 / (kAnywhere * kAnywhere),
                                 1.0 / (kAnyHeading * kAnyHeading));
  curved.diagonal() += anywhere;
  noise.diagonal() += anywhere;
  const Eigen::Matrix3d inverse = curved.ldlt().solve(Eigen::Matrix3d::Identity());
  fit.covariance = inverse * noise * inverse;
  return fit;
}

constexpr const char* kSeeMore =
    "pictures that show a corner, the circle or other lines in two directions within 5 m";

std::vector<Check> checksOf(const Fit& fit, const LinePoseVerdict& judged, std::size_t points,
                            const LinesInSight& inSight) {
  const double percent = 100.0 / std::max(1.0, static_cast<double>(points));
  std::vector<Check> checks = {
      {"points within 5 m", static_cast<double>(fit.near), 12.0, true, "", 0,
       "pictures that show lines within 5 m"},
      {"points on no line", percent * fit.stray, 30.0, false, "%", 0,
       "pictures that show this field alone, without things that look like lines"},
      {"cost of the second-best place", judged.rivalCost, 9.0, true, "", 1, kSeeMore},
      {"sigma of the place", std::hypot(judged.sigmas[0], judged.sigmas[1]), 0.15, false, "m", 3,
       kSeeMore},
      {"sigma of the heading", degrees(judged.sigmas[2]), 3.0, false, "degrees", 2, kSeeMore},
  };
  if (inSight.found + inSight.missing > 0.0)
    checks.push_back({"lines in sight that were not found", 100.0 * inSight.missingShare(), 30.0,
                      false, "%", 0,
                      "pictures that show the lines in better light, if this is the field"});
  return checks;
}

}  // namespace

LinePoseVerdict judgePose(const LinePoseSearch& field, std::span<const LinePlace> points,
                          std::span<const double> sigmas, const Pose2& pose,
                          const LinesInSight& inSight) {
  LinePoseVerdict judged;
  judged.rival = pose;
  const Fit fit = fitOf(field, points, sigmas, pose);
  for (int row = 0; row < 3; ++row) {
    judged.sigmas[static_cast<std::size_t>(row)] = std::sqrt(fit.covariance(row, row));
    for (int column = 0; column < 3; ++column)
      judged.covariance[static_cast<std::size_t>(3 * row + column)] = fit.covariance(row, column);
  }
  // Without any other place there is nothing to fear; without points there is nothing to say.
  judged.rivalCost = points.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  if (const auto rival = rivalOf(field, points, sigmas, pose)) {
    judged.rival = rival->pose;
    const double count = static_cast<double>(points.size());
    judged.rivalCost = (rival->cost * count - fit.cost) / fit.alike;
  }
  judged.verdict.checks = checksOf(fit, judged, points.size(), inSight);
  return judged;
}

}  // namespace ortung
