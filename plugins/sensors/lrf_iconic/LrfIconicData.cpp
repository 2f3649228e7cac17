#include "LrfIconicExtractor.hpp"
#include "LrfIconicSettings.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

DeviceData makeLrfIconic(const Parameters& p) {
  const LrfIconicSettings s = readLrfIconicSettings(p);
  DeviceData data;
  SensorId id = s.id;
  id.feature = "obstacles";
  data.push_back(std::make_unique<ObstaclesData>(id, s.mounting.pose));
  id.feature = "position";
  data.push_back(std::make_unique<PoseFixData>(id, s.fix));
  if (s.reads.empty()) {
    id.feature = LrfIconicSettings::kScan;
    data.push_back(std::make_unique<ScanData>(id, s.mounting.pose, s.scan));
  }
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lrf_iconic_data", ortung::provideData<ortung::makeLrfIconic>("lrf_iconic"),
               ortung::provide<ortung::Extractor, ortung::LrfIconicExtractor>("lrf_iconic"));
