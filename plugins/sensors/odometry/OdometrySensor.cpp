#include "OdometrySettings.hpp"
#include "ortung/container/Formats.hpp"
#include "ortung/container/Plugin.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

class OdometrySensor : public Sensor {
 public:
  explicit OdometrySensor(const Parameters& p) : period_(readOdometrySettings(p).period) {}

  void generateData(const World&, const RobotState& robot, Random*, Timestamp now,
                    std::span<SensorData* const> data) override {
    const std::vector<std::uint32_t> words =
        OdometryData::encode({robot.odometry,
                              robot.translationalVelocity,
                              robot.rotationalVelocity,
                              {robot.motionData.begin(), robot.motionData.end()}});
    for (SensorData* one : data) one->setData(now, words);
  }

  double period() const override { return period_; }

 private:
  double period_;  ///< [s]
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("odometry_sensor",
               ortung::provide<ortung::Sensor, ortung::OdometrySensor>("odometry"));
