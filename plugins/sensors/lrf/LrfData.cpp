#include "LrfSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {
namespace {

DeviceData makeLrf(const Parameters& p) {
  const LrfSettings settings = readLrfSettings(p);
  DeviceData data;
  data.push_back(std::make_unique<ScanData>(settings.id, settings.mounting.pose, settings.scan));
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("lrf_data", ortung::provideData<ortung::makeLrf>("lrf"));
