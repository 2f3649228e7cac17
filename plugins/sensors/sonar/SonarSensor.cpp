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

/// Greatest angle between the axes of a panorama [rad].
constexpr double kWidestStep = 2.0 * kTurn / 360.0;

/// The ranges of a cone in all directions from one place at one time. The learner puts all sonars
/// of a ring there, one by one, and turns them on the spot.
class Panorama {
 public:
  explicit Panorama(const SonarSettings& settings)
      : cone_{.z = settings.z,
              .halfAngle = settings.cone.openingAngle / 2.0,
              .maxRange = settings.cone.maxRange} {
    constexpr double kFewest = 5.0;  // least number of axes between that of a cone and its edge
    cone_.angleStep = cone_.halfAngle / std::max(std::ceil(cone_.halfAngle / kWidestStep), kFewest);
    nearest_.resize(static_cast<std::size_t>(std::ceil(kTurn / cone_.angleStep - 1e-9)));
  }

  bool isOf(const World& world, const Pose2& sonar, Timestamp now) const {
    constexpr double kSame = 1e-9;  // [m]: rounding error of a chain of frames
    return world_ == &world && now_ == now && std::abs(cone_.x - sonar.x) < kSame &&
           std::abs(cone_.y - sonar.y) < kSame;
  }

  /// Computes the ranges; the heading of @p sonar is one of the directions.
  void look(const World& world, const Pose2& sonar, RobotNumber robot, Timestamp now) {
    world_ = &world;
    now_ = now;
    cone_.x = sonar.x;
    cone_.y = sonar.y;
    cone_.firstAngle = sonar.theta;
    world.castCones(cone_, robot, nearest_);
  }

  double nearest(double heading) const {
    const double turns = (heading - cone_.firstAngle) / kTurn;
    const double ahead = (turns - std::floor(turns)) * kTurn;
    const auto index = static_cast<std::size_t>(std::lround(ahead / cone_.angleStep));
    return static_cast<double>(nearest_[index % nearest_.size()]);
  }

 private:
  ConeFan cone_;
  const World* world_ = nullptr;
  Timestamp now_ = 0;
  std::vector<float> nearest_;  ///< nearest surface in each direction [m]
};

class SonarSensor : public Sensor {
 public:
  explicit SonarSensor(const Parameters& p)
      : settings_(readSonarSettings(p)), panorama_(settings_) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    if (noise == nullptr)
      for (std::size_t i = 0; i < data.size(); ++i) fire(world, robot, nullptr, now, *data[i]);
    else
      fireGroup(world, robot, *noise, now, data);
  }

  /// Returns the time between two groups: all fire once in a period, group by group.
  double period() const override {
    return settings_.period * static_cast<double>(settings_.atOnce) /
           static_cast<double>(settings_.mounts.size());
  }
  /// Returns the cost of a cone of seven slices of rays, which is an upper bound.
  double rays() const override {
    const double toEachSide = std::max(settings_.cone.openingAngle / 2.0 / kWidestStep, 5.0);
    return 7.0 * (1.6 * toEachSide + 1.0) * static_cast<double>(settings_.atOnce);
  }

 private:
  /// Fires a group of sonars, which are far enough from each other not to hear their neighbours'
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
    // The data half has placed each sonar on the ring.
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

  /// Returns the range of the nearest surface within the cone, or the greatest range [m].
  double nearest(const World& world, const Pose2& sonar, RobotNumber robot) const {
    float range = 0.0F;
    world.castCones({.x = sonar.x,
                     .y = sonar.y,
                     .z = settings_.z,
                     .firstAngle = sonar.theta,
                     .halfAngle = settings_.cone.openingAngle / 2.0,
                     .maxRange = settings_.cone.maxRange},
                    robot, {&range, 1});
    return static_cast<double>(range);
  }

  /// Returns the range, or infinity if nothing is within range.
  double seen(double range) const {
    // The greatest range may have been rounded to a float.
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
  Panorama panorama_;
  std::size_t next_ = 0;  ///< index in the firing order of the next sonar
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("sonar_sensor", ortung::provide<ortung::Sensor, ortung::SonarSensor>("sonar"));
