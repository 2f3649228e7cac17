#include <cmath>
#include <limits>
#include <stdexcept>

#include "ortung/core/Plugin.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/sim_api/Drive.hpp"
#include "ortung/sim_api/Sensor.hpp"

/// Plugins that can be made, but fail at their work.
namespace ortung {
namespace {

int readAfter(const Parameters& p) {
  p.textOr("plugin", "");
  return static_cast<int>(p.integerOr("after", 0, {0, 1000}));
}

DeviceData makeThrower(const Parameters& p) {
  readAfter(p);
  DeviceData data;
  data.push_back(std::make_unique<PoseData>(SensorId{"bad", "thrower", "pose"}));
  return data;
}

class Thrower : public Sensor {
 public:
  explicit Thrower(const Parameters& p) : left_(readAfter(p)) {}
  void generateData(const World&, const RobotState& robot, Random*, Timestamp now,
                    std::span<SensorData* const> data) override {
    if (left_-- == 0) throw std::runtime_error("out of luck");
    data[0]->setData(now, PoseData::encode(robot.pose));
  }

 private:
  int left_;
};

/// Throws, or gives numbers that are none.
class StrangeDrive : public Drive {
 public:
  explicit StrangeDrive(const Parameters& p) : nan_(p.flagOr("nan", false)) {
    p.textOr("plugin", "");
  }
  void setTranslationalVelocity(double) override {}
  void setRotationalVelocity(double) override {}
  void setCommand(std::span<const double>) override {}
  std::size_t commandSize() const override { return 0; }
  std::string kind() const override { return "none"; }
  std::string commandHelp() const override { return "nothing"; }
  DriveLimits limits() const override { return {}; }
  Pose2 relocate(double, Random*) override {
    if (!nan_) throw std::runtime_error("a wheel came off");
    return {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};
  }
  Twist velocity() const override { return {}; }
  void setVelocity(const Twist&) override {}
  Pose2 measure(const Pose2& change, Random*) override { return change; }

 private:
  bool nan_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("thrower", ortung::provideData<ortung::makeThrower>("thrower"),
               ortung::provide<ortung::Sensor, ortung::Thrower>("thrower"),
               ortung::provide<ortung::Drive, ortung::StrangeDrive>("strange_drive"));
