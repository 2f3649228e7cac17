#include "../common/ScanCaster.hpp"
#include "LrfSettings.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

class LrfSensor : public Sensor {
 public:
  explicit LrfSensor(const Parameters& p) : LrfSensor(readLrfSettings(p)) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    const std::span<const std::uint32_t> words = caster_.cast(world, robot, noise);
    for (SensorData* one : data) one->setData(now, words);
  }

  double period() const override { return period_; }
  double rays() const override { return caster_.rays(); }

 private:
  explicit LrfSensor(const LrfSettings& s)
      : caster_(s.scan, s.mounting, {s.noiseSigma, s.noiseSigmaPerMetre, s.dropoutShare}),
        period_(s.period) {}

  ScanCaster caster_;
  double period_;  ///< time between two scans [s]
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lrf_sensor", ortung::provide<ortung::Sensor, ortung::LrfSensor>("lrf"));
