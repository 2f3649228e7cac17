#include "SonarSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ConeData.hpp"

namespace ortung {
namespace {

DeviceData makeSonar(const Parameters& p) {
  const SonarSettings settings = readSonarSettings(p);
  DeviceData data;
  for (std::size_t i = 0; i < settings.mounts.size(); ++i) {
    SensorId id = settings.id;
    id.feature += std::to_string(i);
    data.push_back(std::make_unique<ConeData>(id, settings.mounts[i], settings.cone));
  }
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("sonar_data", ortung::provideData<ortung::makeSonar>("sonar"));
