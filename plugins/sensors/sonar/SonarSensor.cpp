#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "SonarSettings.hpp"
#include "ortung/container/Plugin.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

/// Rays within the cone at one elevation.
struct Slice {
  double elevation = 0.0;  ///< [rad]
  double halfWidth = 0.0;  ///< [rad]
  std::size_t rays = 1;
};

/// Cuts the cone into fans: one level, the others evenly above and below it, each as wide as a
/// cone of circular section is there.
std::vector<Slice> cutCone(double openingAngle) {
  constexpr int kAbove = 2;  // fans above the level one, and below it
  const double half = openingAngle / 2.0;
  const double spacing = std::min(radians(2.0), half / 5.0);
  std::vector<Slice> slices;
  for (int i = -kAbove; i <= kAbove; ++i) {
    Slice slice;
    slice.elevation = half * i / kAbove;
    slice.halfWidth = std::sqrt(std::max(half * half - slice.elevation * slice.elevation, 0.0));
    const double steps = std::ceil(slice.halfWidth / spacing);
    slice.rays = 2 * static_cast<std::size_t>(steps) + 1;  // odd: one of them is in the middle
    slices.push_back(slice);
  }
  return slices;
}

class SonarSensor : public Sensor {
 public:
  explicit SonarSensor(const Parameters& p)
      : settings_(readSonarSettings(p)), slices_(cutCone(settings_.cone.openingAngle)) {
    for (const Slice& slice : slices_) ranges_.resize(std::max(ranges_.size(), slice.rays));
  }

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    for (SensorData* one : data) {
      // The data half has put each sonar to its place on the ring.
      double range = nearestAt(world, robot.pose * one->mount(), robot.number, now);
      if (noise != nullptr) range = measured(range, *noise);
      if (std::isfinite(range)) range = std::max({range, settings_.minRange, 0.001});
      const std::uint32_t word = ConeData::encode(range, settings_.cone.maxRange);
      one->setData(now, {&word, 1});
    }
  }

  double period() const override { return settings_.period; }

 private:
  /// As nearest(), but remembers the last answer: the learner puts all sonars of a ring to the same
  /// place, one after the other.
  double nearestAt(const World& world, const Pose2& sonar, RobotNumber robot, Timestamp now) {
    constexpr double kSame = 1e-9;  // [m] and [rad]: what a chain of frames leaves of rounding
    const bool isKnown = last_ && last_->now == now && last_->world == &world &&
                         std::abs(last_->sonar.x - sonar.x) < kSame &&
                         std::abs(last_->sonar.y - sonar.y) < kSame &&
                         std::abs(wrapAngle(last_->sonar.theta - sonar.theta)) < kSame;
    if (!isKnown) last_ = {now, &world, sonar, nearest(world, sonar, robot)};
    return last_->range;
  }

  /// Nearest surface within the cone [m], or infinity.
  double nearest(const World& world, const Pose2& sonar, RobotNumber robot) {
    double range = settings_.cone.maxRange;
    for (const Slice& slice : slices_) {
      const std::span<float> rays(ranges_.data(), slice.rays);
      const double step =
          slice.rays > 1 ? 2.0 * slice.halfWidth / static_cast<double>(slice.rays - 1) : 0.0;
      world.castFan({.x = sonar.x,
                     .y = sonar.y,
                     .z = settings_.z,
                     .firstAngle = sonar.theta - slice.halfWidth,
                     .angleStep = step,
                     .elevation = slice.elevation,
                     .maxRange = settings_.cone.maxRange},
                    robot, rays);
      range = std::min(range, static_cast<double>(*std::min_element(rays.begin(), rays.end())));
    }
    return range < settings_.cone.maxRange ? range : std::numeric_limits<double>::infinity();
  }

  double measured(double range, Random& noise) const {
    const double reach = std::min(range, settings_.cone.maxRange);
    if (noise.uniform() < settings_.falseShare) return noise.uniform(settings_.minRange, reach);
    if (noise.uniform() < settings_.missedShare || !std::isfinite(range))
      return std::numeric_limits<double>::infinity();
    const double sigma = settings_.noiseSigma + settings_.noiseSigmaPerMetre * range;
    return range + sigma * noise.gaussian();
  }

  struct Answer {
    Timestamp now;
    const World* world;
    Pose2 sonar;
    double range;
  };
  SonarSettings settings_;
  std::optional<Answer> last_;
  std::vector<Slice> slices_;
  std::vector<float> ranges_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("sonar_sensor", ortung::provide<ortung::Sensor, ortung::SonarSensor>("sonar"));
