#include "../common/ScanCaster.hpp"
#include "LrfIconicSettings.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

/// The laser of the device; its scan is processed on the robot (LrfIconicExtractor).
class LrfIconicSensor : public Sensor {
 public:
  explicit LrfIconicSensor(const Parameters& p) : LrfIconicSensor(readLrfIconicSettings(p)) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    if (!ownsScan_) return;
    const std::span<const std::uint32_t> words = caster_.cast(world, robot, noise);
    for (SensorData* one : data)
      if (one->id().feature == LrfIconicSettings::kScan) one->setData(now, words);
  }

  double period() const override { return period_; }
  double rays() const override {
    constexpr double kMatching = 10.0;  // cost of finding and matching shapes, per beam
    return kMatching * caster_.rays();
  }

 private:
  explicit LrfIconicSensor(const LrfIconicSettings& s)
      : caster_(s.scan, s.mounting, {s.noiseSigma, s.noiseSigmaPerMetre, s.dropoutShare}),
        period_(s.period),
        ownsScan_(s.reads.empty()) {}

  ScanCaster caster_;
  double period_;  ///< time between two scans [s]
  bool ownsScan_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lrf_iconic_sensor",
               ortung::provide<ortung::Sensor, ortung::LrfIconicSensor>("lrf_iconic"));
