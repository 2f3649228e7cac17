#include "SurfaceFit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ortung/base/FastMath.hpp"
#include "ortung/base/Widest.hpp"

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
constexpr double kLeastScatter = 0.01;    ///< least scatter, as a share of the model's variance
constexpr float kLeastOutliers = 1e-30F;  ///< share of outliers below which it counts as none

constexpr double kStep = 2.0;    ///< distance between places where a beam is followed [cells]
constexpr double kGrazes = 0.2;  ///< least sine between a beam and a line that it crosses
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
  const double offX = range * beam.c - dx;
  const double offY = range * beam.s - dy;
  const double within = kWithin * cell;
  return offX * offX + offY * offY < within * within ? range : kNaN;
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

/// Computes inlierShare() in single precision, without branches and calls, so that the compiler
/// vectorizes it.
struct InlierShares {
  /// @param squares squared residuals [variances of the model] @param variance of those that are no
  /// outliers, in the same unit
  ORTUNG_INLINE static void run(const float* squares, float variance, float outliers, float* shares,
                                std::size_t n) {
    const float halfPrecision = -0.5F / variance;
    for (std::size_t k = 0; k < n; ++k) {
      const float inlier = (1.0F - outliers) * powerOfE(halfPrecision * squares[k]);
      shares[k] = inlier / (inlier + outliers);
    }
  }
};

/// The residuals of a scan, in standard deviations of the model: a row of each for every quantity.
struct Residuals {
  /// One of them with its derivatives by the robot's x, y, theta.
  struct One {
    double off;
    std::array<double, 3> expectation;
    bool follows;  ///< its beam is next to that of the one before
  };
  std::vector<One> all;
  std::vector<float> squares;
  std::vector<float> shares;  ///< how probably each is no outlier

  explicit Residuals(std::size_t most) {
    all.reserve(most);
    squares.reserve(most);
  }
  void add(double off, double sigma, const std::array<double, 3>& by, bool follows) {
    const double one = off / sigma;
    all.push_back({one, {by[0] / sigma, by[1] / sigma, by[2] / sigma}, follows});
    squares.push_back(static_cast<float>(one * one));
  }
  void judge(double variance, double outliers) {
    shares.resize(squares.size());
    runWidest<InlierShares>(squares.data(), static_cast<float>(variance),
                            std::max(static_cast<float>(outliers), kLeastOutliers), shares.data(),
                            squares.size());
  }
};

/// Returns the variance of residuals that are no outliers, in variances of the model, by
/// expectation maximization from the model's.
double scatterOf(Residuals& residuals, double outliers) {
  double variance = 1.0;
  for (int k = 0; k < kScatterSteps; ++k) {
    residuals.judge(variance, outliers);
    double count = kSupposed;
    double squares = kSupposed * variance;
    for (std::size_t i = 0; i < residuals.all.size(); ++i) {
      const auto share = static_cast<double>(residuals.shares[i]);
      count += share;
      squares += share * static_cast<double>(residuals.squares[i]);
    }
    variance = std::clamp(squares / count, kLeastScatter, 1.0);
  }
  return variance;
}

Slope slopeOf(Residuals& residuals, double outliers) {
  const double scatter = scatterOf(residuals, outliers);
  residuals.judge(scatter, outliers);
  Slope slope;
  double products = 0.0;
  double pairs = 1e-9;
  double lastShare = 0.0;
  double last = 0.0;
  for (std::size_t i = 0; i < residuals.all.size(); ++i) {
    const Residuals::One& r = residuals.all[i];
    const auto share = static_cast<double>(residuals.shares[i]);
    slope.add(r.off, r.expectation, share / scatter);
    if (r.follows) {
      const double both = std::min(share, lastShare);
      products += both * r.off * last;
      pairs += 0.5 * both * (r.off * r.off + last * last);
    }
    last = r.off;
    lastShare = share;
  }
  const double alike = std::clamp(products / pairs, 0.0, kMostAlike);
  Slope worth;
  worth.add(slope, (1.0 - alike) / (1.0 + alike));
  return worth;
}

}  // namespace

void SurfaceFit::add(double range, double bearing) {
  const double c = std::cos(mount_.theta + bearing);
  const double s = std::sin(mount_.theta + bearing);
  const double sigma = model_.sigmaAt(range);
  ends_.push_back({mount_.x + range * c, mount_.y + range * s, c, s, range, sigma * sigma});
}

Slope SurfaceFit::slopeAt(const Pose2& robot) const {
  if (isEmpty()) return {};
  Residuals residuals(2 * ends_.size());
  const double c = std::cos(robot.theta);
  const double s = std::sin(robot.theta);
  const Pose2 sensor = robot * mount_;
  bool follows = false;
  double levers = 0.0;  // sum of squares
  for (const End& end : ends_) {
    const double dx = c * end.x - s * end.y;  // from the robot, in the field's directions
    const double dy = s * end.x + c * end.y;
    const Beam beam{sensor.x, sensor.y, c * end.c - s * end.s, s * end.c + c * end.s, end.range};
    const Surface* surface = shownBy(*surfaces_, beam);
    if (surface == nullptr) {
      follows = false;
      continue;
    }
    const double offX = static_cast<double>(surface->x) - robot.x - dx;
    const double offY = static_cast<double>(surface->y) - robot.y - dy;
    const auto take = [&](double nx, double ny, double variance) {
      const double lever = ny * dx - nx * dy;
      levers += lever * lever;
      residuals.add(nx * offX + ny * offY, std::sqrt(variance), {nx, ny, lever}, follows);
    };
    const auto nx = static_cast<double>(surface->normalX);
    const auto ny = static_cast<double>(surface->normalY);
    const auto across = static_cast<double>(surface->across);
    if (surface->along < 0.0F) {
      const double slant = std::max(kLeastSlant, std::abs(nx * beam.c + ny * beam.s));
      take(nx, ny, end.variance * slant * slant + across * across);
      follows = true;
    } else {
      const auto along = static_cast<double>(surface->along);
      follows = false;
      take(nx, ny, end.variance + across * across);
      take(-ny, nx, end.variance + along * along);
    }
  }
  Slope slope = slopeOf(residuals, model_.outliers);
  slope.blurMetres = surfaces_->sigma();
  const double lever = std::sqrt(levers / (static_cast<double>(residuals.all.size()) + 1e-9));
  slope.blurRadians = lever > 0.0 ? std::min(1.0, surfaces_->sigma() / lever) : 0.0;
  return slope;
}

}  // namespace ortung
