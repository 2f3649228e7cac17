#include "SurfaceFit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "TableSlope.hpp"

namespace ortung {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Least sine between a beam and a line. A grazed line is less exact than its slant predicts, since
/// ends lie at other heights.
constexpr double kLeastSlant = 0.15;
/// Number of residuals by which the model's scatter and correlation count beside the measured ones.
constexpr double kSupposed = 10.0;
constexpr double kMostAlike = 0.95;
constexpr int kScatterSteps = 4;
constexpr double kLeastScatter = 0.01;  ///< least scatter, as a share of the model's variance

constexpr double kShortest = 1e-6;  ///< least length of a beam by which is divided [m]
constexpr double kStep = 2.0;       ///< distance between places where a beam is followed [cells]
constexpr double kGrazes = 0.2;     ///< least sine between a beam and a line that it crosses
/// Greatest distance between where a beam crosses a line and the mean of its cell's ends [cells].
constexpr double kWithin = 1.0;

/// A beam in the field frame, from a sensor to where it ended.
struct Beam {
  double x;  ///< of its sensor [m]
  double y;
  double c;  ///< its direction
  double s;
  double range;  ///< [m]
};

/// Returns where a beam crosses a surface's line, as a range [m]; NaN if it does not.
double crossing(const Surface& surface, const Beam& beam, double cell) {
  const double nx = static_cast<double>(surface.normalX);
  const double ny = static_cast<double>(surface.normalY);
  const double dx = static_cast<double>(surface.x) - beam.x;
  const double dy = static_cast<double>(surface.y) - beam.y;
  const double slant = nx * beam.c + ny * beam.s;
  if (surface.along >= 0.0F || std::abs(slant) < kGrazes) return kNaN;
  const double range = (nx * dx + ny * dy) / slant;
  const double off = std::hypot(range * beam.c - dx, range * beam.s - dy);
  return off < kWithin * cell ? range : kNaN;
}

/// Returns the surface that a beam shows, or null if none is near its end. This is the nearest one
/// but where the beam would have to cross another one before: noise moves ends through thin walls,
/// and the far side of a wall is no place where a beam ends.
const Surface* shownBy(const SurfaceField& surfaces, const Beam& beam) {
  const Surface* found = surfaces.near(beam.x + beam.range * beam.c, beam.y + beam.range * beam.s);
  if (found == nullptr) return nullptr;
  const double cell = surfaces.grid().cell;
  for (double back = kStep; back <= SurfaceField::kReach; back += kStep) {
    const double at = beam.range - back * cell;
    if (at <= 0.0) break;
    const Surface* before = surfaces.near(beam.x + at * beam.c, beam.y + at * beam.s);
    if (before == nullptr) break;  // nothing is near
    if (before != found && crossing(*before, beam, cell) < beam.range) found = before;
  }
  return found;
}

/// One residual, in standard deviations of the model.
struct Residual {
  double off;
  double variance;  ///< variance by the model [m^2]
  std::array<double, 3> expectation;
  bool follows;  ///< its beam is next to that of the one before
};

/// Returns the variance of residuals that are no outliers, in variances of the model, by
/// expectation maximization from the model's.
double scatterOf(const std::vector<Residual>& residuals, double outliers) {
  double variance = 1.0;
  for (int k = 0; k < kScatterSteps; ++k) {
    double count = kSupposed;
    double squares = kSupposed * variance;
    for (const Residual& r : residuals) {
      const double weight = inlierShare(outliers, r.off / std::sqrt(variance));
      count += weight;
      squares += weight * r.off * r.off;
    }
    variance = std::clamp(squares / count, kLeastScatter, 1.0);
  }
  return variance;
}

Slope slopeOf(const std::vector<Residual>& residuals, double outliers) {
  const double scatter = scatterOf(residuals, outliers);
  Slope slope;
  double products = 0.0;
  double pairs = 1e-9;
  double lastWeight = 0.0;
  double last = 0.0;
  for (const Residual& r : residuals) {
    const double weight = inlierShare(outliers, r.off / std::sqrt(scatter));
    slope.add(r.off * std::sqrt(r.variance), r.expectation, weight / (r.variance * scatter));
    if (r.follows) {
      const double both = std::min(weight, lastWeight);
      products += both * r.off * last;
      pairs += 0.5 * both * (r.off * r.off + last * last);
    }
    last = r.off;
    lastWeight = weight;
  }
  const double alike = std::clamp(products / pairs, 0.0, kMostAlike);
  Slope worth;
  worth.add(slope, (1.0 - alike) / (1.0 + alike));
  return worth;
}

}  // namespace

void SurfaceFit::add(double range, double bearing) {
  const Pose2 end = mount_ * Pose2{range * std::cos(bearing), range * std::sin(bearing), 0.0};
  ends_.push_back({end.x, end.y, range});
}

Slope SurfaceFit::slopeAt(const Pose2& robot) const {
  if (isEmpty()) return {};
  std::vector<Residual> residuals;
  residuals.reserve(2 * ends_.size());
  const double c = std::cos(robot.theta);
  const double s = std::sin(robot.theta);
  const Pose2 sensor = robot * mount_;
  bool follows = false;
  for (const End& end : ends_) {
    const double dx = c * end.x - s * end.y;  // from the robot, in the field's directions
    const double dy = s * end.x + c * end.y;
    const double x = robot.x + dx;
    const double y = robot.y + dy;
    const double bx = x - sensor.x;
    const double by = y - sensor.y;
    const double length = std::max(end.range, kShortest);
    const Surface* surface =
        shownBy(*surfaces_, {sensor.x, sensor.y, bx / length, by / length, end.range});
    if (surface == nullptr) {
      follows = false;
      continue;
    }
    const double sigma = model_.sigmaAt(end.range);
    const auto take = [&](double nx, double ny, double variance) {
      const double off =
          nx * (static_cast<double>(surface->x) - x) + ny * (static_cast<double>(surface->y) - y);
      residuals.push_back(
          {off / std::sqrt(variance), variance, {nx, ny, ny * dx - nx * dy}, follows});
    };
    const auto nx = static_cast<double>(surface->normalX);
    const auto ny = static_cast<double>(surface->normalY);
    const auto across = static_cast<double>(surface->across);
    if (surface->along < 0.0F) {
      const double slant = std::max(kLeastSlant, std::abs(nx * bx + ny * by) / length);
      take(nx, ny, sigma * sigma * slant * slant + across * across);
      follows = true;
    } else {
      const auto along = static_cast<double>(surface->along);
      follows = false;
      take(nx, ny, sigma * sigma + across * across);
      take(-ny, nx, sigma * sigma + along * along);
    }
  }
  Slope slope = slopeOf(residuals, model_.outliers);
  slope.blurMetres = surfaces_->sigma();
  double squares = 0.0;
  for (const Residual& r : residuals) squares += r.expectation[2] * r.expectation[2];
  const double lever = std::sqrt(squares / (static_cast<double>(residuals.size()) + 1e-9));
  slope.blurRadians = lever > 0.0 ? std::min(1.0, surfaces_->sigma() / lever) : 0.0;
  return slope;
}

}  // namespace ortung
