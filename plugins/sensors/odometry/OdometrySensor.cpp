#include "OdometrySettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

class OdometrySensor : public Sensor {
 public:
  explicit OdometrySensor(const Parameters& p) : period_(readOdometrySettings(p).period) {}

  void generateData(const World&, const RobotState& robot, Random*, Timestamp now,
                    std::span<SensorData* const> data) override {
    reading_.pose = robot.odometry;
    reading_.translationalVelocity = robot.translationalVelocity;
    reading_.rotationalVelocity = robot.rotationalVelocity;
    reading_.lateralVelocity = robot.lateralVelocity;
    reading_.motionData.assign(robot.motionData.begin(), robot.motionData.end());
    OdometryData::encode(reading_, words_);
    for (SensorData* one : data) one->setData(now, words_);
  }

  double period() const override { return period_; }

 private:
  double period_;                  ///< time between two readings [s]
  OdometryData::Reading reading_;  ///< reused, like words_, so that a cycle allocates nothing
  std::vector<std::uint32_t> words_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("odometry_sensor",
               ortung::provide<ortung::Sensor, ortung::OdometrySensor>("odometry"));
