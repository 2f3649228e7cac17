// The sensor "@NAME@": one ray, such as an infrared range finder has. Change what is measured in
// generateData(), and what the reading is (ConeData) in makeData(). Build and try it:
//
//   cmake -B build && cmake --build build
//   export ORTUNG_PLUGIN_PATH=build
//   ortung learn --world world.toml --robot @NAME@.toml --out tables.ortung
//   ortung show tables.ortung --robot @NAME@.toml --feature '*/@NAME@/*' --out expected.png
#include <cmath>
#include <limits>

#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/sim_api/Noise.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace {
using namespace ortung;

// The keys of [[sensor]]. Both halves read all of them: what nobody reads is told as misspelt.
struct Settings {
  explicit Settings(const Parameters& p)
      : id(sensorIdOf(p, {"mine", "@NAME@", "front"})),
        mount{p.numberOr("x_m", 0.2, {-1.0, 1.0}), 0.0, 0.0},
        cone{.openingAngle = 0.02,
             .maxRange = p.numberOr("max_range_m", 0.8, {0.1, 10.0}),
             .model = SensorModel::read(p, "sigma_m", {.sigma = 0.02})} {}
  SensorId id;             // the feature's names: model/type/feature
  Pose2 mount;             // where the sensor sits, in the robot's frame [m, m, rad]
  ConeData::Config cone;   // what the reading is, and how it spreads around what is expected
};

// The half that is on every robot: it holds readings, learns what to expect, and weighs.
DeviceData makeData(const Parameters& p) {
  const Settings s(p);
  DeviceData features;
  features.push_back(std::make_unique<ConeData>(s.id, s.mount, s.cone));
  return features;
}

// The half that is in the simulator: it measures. `ortung learn` uses it, too, without noise.
class Simulated : public Sensor {
 public:
  explicit Simulated(const Parameters& p) : s_(p) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> features) override {
    const Pose2 eye = robot.pose * s_.mount;  // field <- robot <- sensor
    const RayFan ray{eye.x, eye.y, 0.1, eye.theta, 0.0, 0.0, s_.cone.maxRange};
    float range = 0.0F;
    world.castFan(ray, robot.number, {&range, 1});
    // Where there is no surface, the greatest range comes back, through a float.
    const bool sees = range < s_.cone.maxRange * (1.0 - 1e-6);
    double seen = sees ? double{range} : std::numeric_limits<double>::infinity();
    if (noise != nullptr && std::isfinite(seen))
      seen = noisyRange(seen, s_.cone.model.sigma, 0.0, *noise);
    const std::uint32_t word = ConeData::encode(seen, s_.cone.maxRange);
    for (SensorData* feature : features) feature->setData(now, {&word, 1});
  }
  double period() const override { return 0.05; }  // between two readings [s]

 private:
  Settings s_;
};
}  // namespace

ORTUNG_PLUGINS("@NAME@", provideData<makeData>("@NAME@"), provide<Sensor, Simulated>("@NAME@"));
