#include <cmath>

#include "LrfCylindersSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

/// Gives the learner the places of cylinders: all within range, identified and without noise. A
/// simulated robot finds them in its scan, as a real one does (LrfCylindersExtractor).
class LrfCylindersSensor : public Sensor {
 public:
  explicit LrfCylindersSensor(const Parameters& p) : settings_(readLrfCylindersSettings(p)) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    if (noise != nullptr) return;
    const Pose2 sensor = robot.pose * settings_.mounting.pose;
    LandmarksData::Reading reading;
    for (const Landmark& landmark : world.landmarks()) {
      if (landmark.kind != settings_.kind) continue;
      const double dx = landmark.x - sensor.x;
      const double dy = landmark.y - sensor.y;
      const double range = std::hypot(dx, dy);
      if (range <= settings_.landmarks.maxRange)
        reading.push_back({landmark.identity, range, wrapAngle(std::atan2(dy, dx) - sensor.theta)});
    }
    for (SensorData* one : data) one->setData(now, LandmarksData::encode(reading));
  }

  double period() const override { return 0.0; }
  double rays() const override {
    return static_cast<double>(settings_.landmarks.identities.size());
  }

 private:
  LrfCylindersSettings settings_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lrf_cylinders_sensor",
               ortung::provide<ortung::Sensor, ortung::LrfCylindersSensor>("lrf_cylinders"));
