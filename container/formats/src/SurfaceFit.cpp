#include "SurfaceFit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "BeamRows.hpp"
#include "FitResiduals.hpp"
#include "ShownSurfaces.hpp"
#include "ortung/base/Widest.hpp"

namespace ortung {
namespace {

/// Least sine between a beam and a line. A grazed line is less exact than its slant predicts, since
/// ends lie at other heights.
constexpr double kLeastSlant = 0.15;

/// Ends of a block of beams in the robot frame.
struct EndRows {
  const double* x;
  const double* y;
  const double* c;
  const double* s;
  const double* range;
  const double* variance;
};

/// A heading.
struct Turn {
  double c;
  double s;
};

/// Turns beams into the field frame.
struct TurnedBeams {
  ORTUNG_INLINE static void run(EndRows ends, Turn by, BeamRows* beams) {
    for (std::size_t i = 0; i < beams->size; ++i) {
      beams->range[i] = ends.range[i];
      beams->dx[i] = by.c * ends.x[i] - by.s * ends.y[i];
      beams->dy[i] = by.s * ends.x[i] + by.c * ends.y[i];
      beams->c[i] = by.c * ends.c[i] - by.s * ends.s[i];
      beams->s[i] = by.s * ends.c[i] + by.c * ends.s[i];
    }
  }
};

/// Writes a residual and its derivatives. @param nx, ny direction in which it is measured
/// @param off distance in this direction [m] @param lever its derivative by the heading [m]
ORTUNG_INLINE void putResidual(std::size_t i, double nx, double ny, double off, double lever,
                               double perSigma, FitResiduals::Block* out) {
  out->off[i] = off * perSigma;
  out->x[i] = nx * perSigma;
  out->y[i] = ny * perSigma;
  out->theta[i] = lever * perSigma;
  out->lever[i] = lever;
}

/// Computes the residuals of ends across lines, and in one direction of spots.
struct ResidualsAcross {
  ORTUNG_INLINE static void run(const BeamRows* beams, const Surface* surfaces,
                                const std::int32_t* numbers, const double* variance, Pose2 robot,
                                FitResiduals::Block* out) {
    for (std::size_t i = 0; i < beams->size; ++i) {
      const Surface& surface = surfaces[numbers[i] < 0 ? 0 : numbers[i]];
      const auto nx = static_cast<double>(surface.normalX);
      const auto ny = static_cast<double>(surface.normalY);
      const auto across = static_cast<double>(surface.across);
      const double offX = static_cast<double>(surface.x) - robot.x - beams->dx[i];
      const double offY = static_cast<double>(surface.y) - robot.y - beams->dy[i];
      const double slant = nx * beams->c[i] + ny * beams->s[i];
      const double squared = slant * slant;
      const double least =
          squared < kLeastSlant * kLeastSlant ? kLeastSlant * kLeastSlant : squared;
      const double times = surface.along < 0.0F ? least : 1.0;
      const double perSigma = 1.0 / std::sqrt(variance[i] * times + across * across);
      const double lever = ny * beams->dx[i] - nx * beams->dy[i];
      putResidual(i, nx, ny, nx * offX + ny * offY, lever, perSigma, out);
    }
  }
};

/// Computes the residuals of ends in the other direction of spots.
struct ResidualsAlong {
  ORTUNG_INLINE static void run(const BeamRows* beams, const Surface* surfaces,
                                const std::int32_t* numbers, const double* variance, Pose2 robot,
                                FitResiduals::Block* out) {
    for (std::size_t i = 0; i < beams->size; ++i) {
      const Surface& surface = surfaces[numbers[i] < 0 ? 0 : numbers[i]];
      const double nx = -static_cast<double>(surface.normalY);
      const auto ny = static_cast<double>(surface.normalX);
      const auto along = static_cast<double>(surface.along);
      const double offX = static_cast<double>(surface.x) - robot.x - beams->dx[i];
      const double offY = static_cast<double>(surface.y) - robot.y - beams->dy[i];
      const double perSigma = 1.0 / std::sqrt(variance[i] + along * along);
      const double lever = ny * beams->dx[i] - nx * beams->dy[i];
      putResidual(i, nx, ny, nx * offX + ny * offY, lever, perSigma, out);
    }
  }
};

}  // namespace

void SurfaceFit::add(double range, double bearing) {
  const double c = std::cos(mount_.theta + bearing);
  const double s = std::sin(mount_.theta + bearing);
  const double sigma = model_.sigmaAt(range);
  x_.push_back(mount_.x + range * c);
  y_.push_back(mount_.y + range * s);
  c_.push_back(c);
  s_.push_back(s);
  range_.push_back(range);
  variance_.push_back(sigma * sigma);
}

Slope SurfaceFit::slopeAt(const Pose2& robot) const {
  if (isEmpty()) return {};
  FitResiduals residuals(2 * range_.size());
  const Turn turn{std::cos(robot.theta), std::sin(robot.theta)};
  const Pose2 sensor = robot * mount_;
  ShownSurfaces shown(*surfaces_);
  const Surface* surfaces = surfaces_->surfaces().data();
  BeamRows beams;
  beams.sensorX = sensor.x;
  beams.sensorY = sensor.y;
  FitResiduals::Block across;
  FitResiduals::Block along;
  bool follows = false;
  for (std::size_t first = 0; first < range_.size(); first += BeamRows::kBlock) {
    beams.size = std::min(BeamRows::kBlock, range_.size() - first);
    const double* variance = variance_.data() + first;
    runWidest<TurnedBeams>(EndRows{x_.data() + first, y_.data() + first, c_.data() + first,
                                   s_.data() + first, range_.data() + first, variance},
                           turn, &beams);
    shown.find(beams);
    runWidest<ResidualsAcross>(&beams, surfaces, shown.numbers(), variance, robot, &across);
    bool hasAlong = false;
    for (std::size_t i = 0; i < beams.size; ++i) {
      if (!shown.has(i)) {
        follows = false;
        continue;
      }
      const bool isLine = shown.isLine(i);
      residuals.add(across, i, follows && isLine);
      follows = isLine;
      if (isLine) continue;
      if (!std::exchange(hasAlong, true))
        runWidest<ResidualsAlong>(&beams, surfaces, shown.numbers(), variance, robot, &along);
      residuals.add(along, i, false);
    }
  }
  if (residuals.isEmpty()) return {};
  Slope slope = residuals.slope(model_.outliers);
  slope.blurMetres = surfaces_->sigma();
  const double lever = residuals.lever();
  slope.blurRadians = lever > 0.0 ? std::min(1.0, surfaces_->sigma() / lever) : 0.0;
  return slope;
}

}  // namespace ortung
