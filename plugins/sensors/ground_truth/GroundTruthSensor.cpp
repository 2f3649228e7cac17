#include "GroundTruthSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

class GroundTruthSensor : public Sensor {
 public:
  explicit GroundTruthSensor(const Parameters& p) : period_(readGroundTruthSettings(p).period) {}

  void generateData(const World&, const RobotState& robot, Random*, Timestamp now,
                    std::span<SensorData* const> data) override {
    const std::vector<std::uint32_t> words = PoseData::encode(robot.pose);
    for (SensorData* one : data) one->setData(now, words);
  }

  double period() const override { return period_; }

 private:
  double period_;  ///< time between two readings [s]
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("ground_truth_sensor",
               ortung::provide<ortung::Sensor, ortung::GroundTruthSensor>("ground_truth"));
