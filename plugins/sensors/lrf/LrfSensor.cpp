#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "LrfSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

class LrfSensor : public Sensor {
 public:
  explicit LrfSensor(const Parameters& p)
      : settings_(readLrfSettings(p)), ranges_(static_cast<std::size_t>(settings_.scan.beams)) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    const ScanData::Config& scan = settings_.scan;
    const Pose2 sensor = robot.pose * settings_.mounting.pose;
    const RayFan fan{.x = sensor.x,
                     .y = sensor.y,
                     .z = settings_.mounting.z,
                     .firstAngle = sensor.theta + scan.firstAngle,
                     .angleStep = scan.angleStep,
                     .elevation = 0.0,
                     .maxRange = scan.maxRange};
    world.castFan(fan, robot.number, ranges_);
    if (noise != nullptr)
      for (float& range : ranges_) range = measured(range, *noise);
    else
      for (float& range : ranges_) range = expected(range);
    ScanData::encode(ranges_, scan.maxRange, words_);
    for (SensorData* one : data) one->setData(now, words_);
  }

  double period() const override { return settings_.period; }
  double rays() const override { return static_cast<double>(ranges_.size()); }

 private:
  /// A surface nearer than the sensor can measure is learned at the smallest range, since a
  /// direction that was never learned would leave its whole cell without expectation.
  float expected(float range) const {
    const double smallest = std::max(std::ceil(settings_.scan.minRange * 1000.0), 1.0) / 1000.0;
    return std::max(range, static_cast<float>(smallest));
  }

  float measured(float range, Random& noise) const {
    constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();
    if (settings_.dropoutShare > 0.0 && noise.uniform() < settings_.dropoutShare) return kInvalid;
    if (range >= settings_.scan.maxRange) return std::numeric_limits<float>::infinity();
    const double sigma = settings_.noiseSigma + settings_.noiseSigmaPerMetre * range;
    const double value = range + sigma * noise.gaussian();
    return value < std::max(settings_.scan.minRange, 0.001) ? kInvalid : static_cast<float>(value);
  }

  LrfSettings settings_;
  std::vector<float> ranges_;
  std::vector<std::uint32_t> words_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lrf_sensor", ortung::provide<ortung::Sensor, ortung::LrfSensor>("lrf"));
