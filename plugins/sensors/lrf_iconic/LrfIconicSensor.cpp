#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "LrfIconicSettings.hpp"
#include "WallMatcher.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/sim_api/Noise.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

/// Scans, takes the scan apart, and compares its straight pieces with the field's walls.
class LrfIconicSensor : public Sensor {
 public:
  explicit LrfIconicSensor(const Parameters& p)
      : settings_(readLrfIconicSettings(p)),
        ranges_(static_cast<std::size_t>(settings_.scan.beams)) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    const ScanData::Config& scan = settings_.scan;
    const Pose2& mount = settings_.mounting.pose;
    cast(world, robot, noise);
    const ScanShapes shapes = shapesOf(ranges_, scan.firstAngle, scan.angleStep, settings_.shapes);
    const std::vector<WallLine> walls =
        wallLinesOf(world, settings_.mounting.z, settings_.shapes.shortest);
    // Matching is no better than the scan's rounding, however little noise there is.
    constexpr double kFinest = 0.005;  // [m]
    const double middle = 0.5 * scan.maxRange;
    const WallMatcher matcher(
        walls, {.rangeSigma =
                    std::max(kFinest, settings_.noiseSigma + settings_.noiseSigmaPerMetre * middle),
                .shareMatched = settings_.shareMatched,
                .mostFixes = settings_.mostFixes});
    const std::vector<PoseFixData::Fix> fixes = matcher.match(shapes.segments, mount);
    for (SensorData* one : data) {
      if (one->id().feature == "position")
        one->setData(now, PoseFixData::encode(fixes));
      else
        one->setData(now, ObstaclesData::encode(obstacles(shapes, matcher, fixes, mount)));
    }
  }

  double period() const override { return settings_.period; }
  double rays() const override {
    constexpr double kMatching = 10.0;  // finding and matching shapes, for each beam
    return kMatching * static_cast<double>(ranges_.size());
  }

 private:
  void cast(const World& world, const RobotState& robot, Random* noise) {
    const ScanData::Config& scan = settings_.scan;
    const Pose2 sensor = robot.pose * settings_.mounting.pose;
    world.castFan({.x = sensor.x,
                   .y = sensor.y,
                   .z = settings_.mounting.z,
                   .firstAngle = sensor.theta + scan.firstAngle,
                   .angleStep = scan.angleStep,
                   .elevation = 0.0,
                   .maxRange = scan.maxRange},
                  robot.number, ranges_);
    for (float& range : ranges_) {
      constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
      const auto truth = static_cast<double>(range);
      if (truth >= scan.maxRange * (1.0 - 1e-6) || truth < scan.minRange) {
        range = kNothing;
      } else if (noise != nullptr) {
        const bool isLost = noise->uniform() < settings_.dropoutShare;
        const double measured =
            noisyRange(truth, settings_.noiseSigma, settings_.noiseSigmaPerMetre, *noise);
        range = isLost ? kNothing : static_cast<float>(measured);
      }
    }
  }

  /// What is no wall; without a position, everything.
  static ObstaclesData::Reading obstacles(const ScanShapes& shapes, const WallMatcher& matcher,
                                          const std::vector<PoseFixData::Fix>& fixes,
                                          const Pose2& mount) {
    ObstaclesData::Reading list;
    for (const ScanCircle& c : shapes.circles)
      list.push_back({.shape = ObstaclesData::Shape::kCircle,
                      .x = c.middle.x,
                      .y = c.middle.y,
                      .radius = c.radius});
    for (const ScanSegment& s : shapes.segments) {
      const bool isWall = std::any_of(fixes.begin(), fixes.end(), [&](const PoseFixData::Fix& fix) {
        return matcher.isOfWall(s, mount, fix.pose);
      });
      if (!isWall)
        list.push_back({.shape = ObstaclesData::Shape::kSegment,
                        .x = s.from.x,
                        .y = s.from.y,
                        .radius = 0.0,
                        .endX = s.to.x,
                        .endY = s.to.y});
    }
    if (list.size() > ObstaclesData::kMostObstacles) list.resize(ObstaclesData::kMostObstacles);
    return list;
  }
  LrfIconicSettings settings_;
  std::vector<float> ranges_;  ///< [m]; NaN: nothing
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lrf_iconic_sensor",
               ortung::provide<ortung::Sensor, ortung::LrfIconicSensor>("lrf_iconic"));
