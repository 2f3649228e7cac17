#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "SonarSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

/// Rays within the cone at one elevation.
struct Slice {
  double elevation = 0.0;  ///< [rad]
  int toEachSide = 0;      ///< rays beside the one in the middle
};

/// A cone of rays: slices at elevations within it, each as wide as a circular cone is there.
struct Cone {
  explicit Cone(double openingAngle) {
    constexpr int kFewest = 5;  // rays between middle and edge
    const double half = openingAngle / 2.0;
    const double toEachSide = std::max(std::ceil(half / radians(2.0)), double{kFewest});
    step = half / toEachSide;
    slices.push_back({0.0, static_cast<int>(toEachSide)});
    // At 0.6 of the way up, the cone is 0.8 as wide; at 0.28 it is 0.96, at 0.96 it is 0.28.
    for (const double share : {0.28, 0.6, 0.96})
      for (const double side : {-share, share})
        slices.push_back({side * half, static_cast<int>(std::floor(
                                           std::sqrt(1.0 - share * share) * toEachSide + 1e-9))});
  }
  double step;  ///< between rays of a slice [rad]
  std::vector<Slice> slices;
};

/// What a cone meets in all directions from one place at one moment. The learner puts all sonars of
/// a ring there, one after the other, and turns them on the spot.
class Panorama {
 public:
  Panorama(const Cone& cone, double z, double maxRange) : cone_(cone), z_(z), maxRange_(maxRange) {
    nearest_.resize(static_cast<std::size_t>(std::ceil(kTurn / cone.step - 1e-9)));
    ranges_.resize(nearest_.size());
  }

  bool isOf(const World& world, const Pose2& sonar, Timestamp now) const {
    constexpr double kSame = 1e-9;  // [m]: what a chain of frames leaves of rounding
    return world_ == &world && now_ == now && std::abs(place_.x - sonar.x) < kSame &&
           std::abs(place_.y - sonar.y) < kSame;
  }

  /// Looks around; the heading of @p sonar is met exactly.
  void look(const World& world, const Pose2& sonar, RobotNumber robot, Timestamp now) {
    world_ = &world;
    now_ = now;
    place_ = sonar;
    std::fill(nearest_.begin(), nearest_.end(), static_cast<float>(maxRange_));
    for (const Slice& slice : cone_.slices) {
      world.castFan({.x = sonar.x,
                     .y = sonar.y,
                     .z = z_,
                     .firstAngle = sonar.theta,
                     .angleStep = cone_.step,
                     .elevation = slice.elevation,
                     .maxRange = maxRange_},
                    robot, ranges_);
      spread(slice.toEachSide);
    }
  }

  double nearest(double heading) const {
    const double turns = (heading - place_.theta) / kTurn;
    const double ahead = (turns - std::floor(turns)) * kTurn;
    const auto index = static_cast<std::size_t>(std::lround(ahead / cone_.step));
    return static_cast<double>(nearest_[index % nearest_.size()]);
  }

 private:
  /// Each ray counts in all directions whose cone it lies in.
  void spread(int toEachSide) {
    const auto n = static_cast<int>(ranges_.size());
    for (int i = 0; i < n; ++i) {
      const float range = ranges_[static_cast<std::size_t>(i)];
      if (static_cast<double>(range) >= maxRange_) continue;
      for (int k = i - toEachSide; k <= i + toEachSide; ++k) {
        float& nearest = nearest_[static_cast<std::size_t>((k % n + n) % n)];
        nearest = std::min(nearest, range);
      }
    }
  }

  const Cone& cone_;
  double z_;         ///< [m]
  double maxRange_;  ///< [m]
  const World* world_ = nullptr;
  Timestamp now_ = 0;
  Pose2 place_;
  std::vector<float> nearest_;  ///< by direction [m]
  std::vector<float> ranges_;   ///< of one slice [m]
};

class SonarSensor : public Sensor {
 public:
  explicit SonarSensor(const Parameters& p)
      : settings_(readSonarSettings(p)),
        cone_(settings_.cone.openingAngle),
        panorama_(cone_, settings_.z, settings_.cone.maxRange),
        ranges_(static_cast<std::size_t>(2 * cone_.slices.front().toEachSide + 1)) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    if (noise == nullptr)
      for (std::size_t i = 0; i < data.size(); ++i) fire(world, robot, nullptr, now, *data[i]);
    else
      fireGroup(world, robot, *noise, now, data);
  }

  /// All fire once in a period, one group after the other.
  double period() const override {
    return settings_.period * static_cast<double>(settings_.atOnce) /
           static_cast<double>(settings_.mounts.size());
  }
  double rays() const override {
    double ofCone = 0.0;
    for (const Slice& slice : cone_.slices) ofCone += 2.0 * slice.toEachSide + 1.0;
    return ofCone * static_cast<double>(settings_.atOnce);
  }

 private:
  /// Sonars of one group fire together, far enough from each other not to hear their neighbours'
  /// echoes; the next call fires the next group.
  void fireGroup(const World& world, const RobotState& robot, Random& noise, Timestamp now,
                 std::span<SensorData* const> data) {
    for (std::size_t k = 0; k < settings_.atOnce; ++k) {
      const std::size_t sonar = settings_.firingOrder[next_ + k];
      if (sonar < data.size()) fire(world, robot, &noise, now, *data[sonar]);
    }
    next_ = (next_ + settings_.atOnce) % settings_.firingOrder.size();
  }

  void fire(const World& world, const RobotState& robot, Random* noise, Timestamp now,
            SensorData& one) {
    // The data half has put each sonar to its place on the ring.
    const Pose2 sonar = robot.pose * one.mount();
    double range = 0.0;
    if (noise == nullptr) {
      if (!panorama_.isOf(world, sonar, now)) panorama_.look(world, sonar, robot.number, now);
      range = seen(panorama_.nearest(sonar.theta));
    } else {
      range = measured(seen(nearest(world, sonar, robot.number)), *noise);
    }
    if (std::isfinite(range)) range = std::max({range, settings_.minRange, 0.001});
    const std::uint32_t word = ConeData::encode(range, settings_.cone.maxRange);
    one.setData(now, {&word, 1});
  }

  /// Nearest surface within the cone, or the greatest range [m].
  double nearest(const World& world, const Pose2& sonar, RobotNumber robot) {
    auto range = static_cast<float>(settings_.cone.maxRange);
    for (const Slice& slice : cone_.slices) {
      const std::span<float> rays(ranges_.data(),
                                  static_cast<std::size_t>(2 * slice.toEachSide + 1));
      world.castFan({.x = sonar.x,
                     .y = sonar.y,
                     .z = settings_.z,
                     .firstAngle = sonar.theta - slice.toEachSide * cone_.step,
                     .angleStep = cone_.step,
                     .elevation = slice.elevation,
                     .maxRange = settings_.cone.maxRange},
                    robot, rays);
      range = std::min(range, *std::min_element(rays.begin(), rays.end()));
    }
    return static_cast<double>(range);
  }

  /// Infinity for nothing within range.
  double seen(double range) const {
    // The greatest range may have come back through a float.
    const bool isNothing = range >= settings_.cone.maxRange * (1.0 - 1e-7);
    return isNothing ? std::numeric_limits<double>::infinity() : range;
  }

  double measured(double range, Random& noise) const {
    const double reach = std::min(range, settings_.cone.maxRange);
    if (noise.uniform() < settings_.falseShare) return noise.uniform(settings_.minRange, reach);
    if (noise.uniform() < settings_.missedShare || !std::isfinite(range))
      return std::numeric_limits<double>::infinity();
    const double sigma = settings_.noiseSigma + settings_.noiseSigmaPerMetre * range;
    return range + sigma * noise.gaussian();
  }

  SonarSettings settings_;
  Cone cone_;
  Panorama panorama_;
  std::vector<float> ranges_;  ///< of one slice [m]
  std::size_t next_ = 0;       ///< place in the firing order
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("sonar_sensor", ortung::provide<ortung::Sensor, ortung::SonarSensor>("sonar"));
