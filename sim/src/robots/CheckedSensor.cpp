#include "CheckedSensor.hpp"

namespace ortung {
namespace {

constexpr double kLongestPeriod = 1e6;  ///< longest period of a sensor [s]
constexpr double kMostRays = 1e12;      ///< greatest number of rays per reading

std::string nameOf(const Device& device, const std::string& robot) {
  std::string name = "the sensor plugin '" + device.config->plugin + "'";
  if (!robot.empty()) name += " of robot " + robot;
  if (device.data.empty()) return name;
  name += " (" + toText(device.data.front()->id());
  if (device.data.size() > 1)
    name += " and " + std::to_string(device.data.size() - 1) + " more features";
  return name + ")";
}

}  // namespace

CheckedSensor::CheckedSensor(std::unique_ptr<Sensor> sensor, const Device& device,
                             const std::string& robot)
    : sensor_(std::move(sensor)), guard_(nameOf(device, robot)) {}
CheckedSensor::~CheckedSensor() = default;

double CheckedSensor::period() const {
  const double period = guard_("period", [&] { return sensor_->period(); });
  if (!(period >= 0.0 && period <= kLongestPeriod))
    guard_.fail("period", "it gave " + std::to_string(period) + " s, expected 0 to 1e6");
  return period;
}

double CheckedSensor::rays() const {
  const double rays = guard_("rays", [&] { return sensor_->rays(); });
  if (!(rays >= 0.0 && rays <= kMostRays))
    guard_.fail("rays", "it gave " + std::to_string(rays) + ", expected 0 to 1e12");
  return rays;
}

std::unique_ptr<Sensor> makeSensor(const Device& device, PluginFactory& factory,
                                   const std::string& robot) {
  const SensorConfig& config = *device.config;
  std::unique_ptr<Sensor> sensor =
      device.hasExtractor ? factory.makeIfThere<Sensor>(config.plugin, config.parameters)
                          : factory.make<Sensor>(config.plugin, config.parameters);
  if (sensor) sensor = std::make_unique<CheckedSensor>(std::move(sensor), device, robot);
  return sensor;
}

}  // namespace ortung
