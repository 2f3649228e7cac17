#include "CompassSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/BearingData.hpp"

namespace ortung {
namespace {

DeviceData makeCompass(const Parameters& p) {
  const CompassSettings s = readCompassSettings(p);
  DeviceData data;
  data.push_back(
      std::make_unique<BearingData>(s.id, s.mounting.pose, BearingData::Config{.model = s.model}));
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("compass_data", ortung::provideData<ortung::makeCompass>("compass"));
