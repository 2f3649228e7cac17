#include <cmath>
#include <stdexcept>

#include "LrfCylindersSettings.hpp"
#include "ortung/core/Extractor.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {
namespace {

DeviceData makeLrfCylinders(const Parameters& p) {
  const LrfCylindersSettings s = readLrfCylindersSettings(p);
  DeviceData data;
  data.push_back(std::make_unique<LandmarksData>(s.id, s.mounting.pose, s.landmarks));
  return data;
}

/// Finds cylinders in simulated, recorded and real scans alike. They are not identified.
class LrfCylindersExtractor : public Extractor {
 public:
  explicit LrfCylindersExtractor(const Parameters& p) : settings_(readLrfCylindersSettings(p)) {}

  std::vector<std::string> inputs() const override { return {settings_.reads}; }

  void take(std::span<const SensorData* const> inputs) override {
    auto scan = readingAs<ScanData>(*inputs[0]);
    if (!scan)
      throw std::invalid_argument(toText(inputs[0]->id()) + " is not a scan, expected one");
    scan_ = *std::move(scan);
    mount_ = inputs[0]->mount();
  }

  void extract(const FieldModel&, std::span<std::optional<Words>> words) override {
    const Pose2 fromScanner = inverse(settings_.mounting.pose) * mount_;
    LandmarksData::Reading reading;
    for (const Cylinder& one :
         findCylinders(scan_.ranges, scan_.firstAngle, scan_.angleStep, settings_.looks)) {
      const Pose2 axis = fromScanner * Pose2{one.range * std::cos(one.bearing),
                                             one.range * std::sin(one.bearing), 0.0};
      const double range = std::hypot(axis.x, axis.y);
      if (range > settings_.landmarks.maxRange) continue;
      reading.push_back({LandmarksData::kUnknown, range, std::atan2(axis.y, axis.x)});
    }
    words[0] = LandmarksData::encode(reading);
  }

 private:
  LrfCylindersSettings settings_;
  ScanData::Reading scan_;
  Pose2 mount_;  ///< pose of the scanner in the robot frame
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lrf_cylinders_data", ortung::provideData<ortung::makeLrfCylinders>("lrf_cylinders"),
               ortung::provide<ortung::Extractor, ortung::LrfCylindersExtractor>("lrf_cylinders"));
