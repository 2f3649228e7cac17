#include "CompassSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

class CompassSensor : public Sensor {
 public:
  explicit CompassSensor(const Parameters& p) : settings_(readCompassSettings(p)) {}

  void generateData(const World&, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    double bearing = settings_.north - robot.pose.theta - settings_.mounting.pose.theta;
    if (noise != nullptr) bearing += settings_.noiseSigma * noise->gaussian();
    const std::uint32_t word = words::fromAngle(bearing);
    for (SensorData* one : data) one->setData(now, {&word, 1});
  }

  double period() const override { return settings_.period; }

 private:
  CompassSettings settings_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("compass_sensor", ortung::provide<ortung::Sensor, ortung::CompassSensor>("compass"));
