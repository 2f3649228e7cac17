#include "ScanTrace.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "SurfaceRay.hpp"

namespace ortung {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns the distance from the nearest surface [m]; infinity if none is near.
double distanceFrom(const SurfaceField& surfaces, double x, double y) {
  const Surface* surface = surfaces.near(x, y);
  if (surface == nullptr) return kInfinity;
  const double dx = x - static_cast<double>(surface->x);
  const double dy = y - static_cast<double>(surface->y);
  const bool isLine = surface->along < 0.0F;
  return isLine ? std::abs(dx * static_cast<double>(surface->normalX) +
                           dy * static_cast<double>(surface->normalY))
                : std::hypot(dx, dy);
}

}  // namespace

ScanTrace::ScanTrace(std::shared_ptr<const SurfaceField> surfaces, const Pose2& mount,
                     const ScanData::Config& config, std::span<const float> ranges, Make make)
    : surfaces_(std::move(surfaces)),
      mount_(mount),
      config_(config),
      ranges_(ranges.begin(), ranges.end()),
      make_(std::move(make)) {}

void ScanTrace::trace(const Pose2& pose, std::vector<TracedBeam>& beams) const {
  const Pose2 sensor = pose * mount_;
  if (surfaces_->isEmpty() || surfaces_->grid().cellAt(sensor.x, sensor.y) < 0) return;
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    if (std::isnan(ranges_[i])) continue;
    TracedBeam beam{sensor.x, sensor.y,
                    sensor.theta + config_.firstAngle + static_cast<double>(i) * config_.angleStep,
                    static_cast<double>(ranges_[i])};
    beam.expected = rangeAlong(*surfaces_, {beam.x, beam.y, beam.bearing}, config_.maxRange);
    beam.reach = config_.maxRange;
    beam.away = std::isfinite(beam.read)
                    ? distanceFrom(*surfaces_, beam.x + beam.read * std::cos(beam.bearing),
                                   beam.y + beam.read * std::sin(beam.bearing))
                    : kInfinity;
    beam.sigma = std::hypot(config_.model.sigmaAt(beam.expected), surfaces_->sigma());
    if (beam.expected >= config_.maxRange) beam.expected = kInfinity;
    beams.push_back(beam);
  }
}

std::shared_ptr<const Weigher> ScanTrace::without(const std::vector<bool>& dropped) const {
  std::vector<float> left = ranges_;
  std::size_t beam = 0;
  for (float& range : left) {
    if (std::isnan(range)) continue;
    if (beam < dropped.size() && dropped[beam]) range = std::numeric_limits<float>::quiet_NaN();
    ++beam;
  }
  return make_(left);
}

}  // namespace ortung
