#include "ortung/formats/LandmarksData.hpp"

#include "LandmarksSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ScalarData.hpp"

namespace ortung {
namespace {

void addEach(const LandmarksSettings& s, DeviceData& data) {
  for (const std::uint32_t identity : s.identities) {
    SensorId id = s.id;
    id.feature = s.kind + std::to_string(identity) + kDistanceEnding;
    data.push_back(std::make_unique<ScalarData>(
        id, s.mounting.pose,
        ScalarData::Config{
            .maxRange = s.maxRange, .fieldOfView = s.fieldOfView, .model = s.range}));
    id.feature = s.kind + std::to_string(identity) + kBearingEnding;
    data.push_back(std::make_unique<BearingData>(
        id, s.mounting.pose,
        BearingData::Config{.fieldOfView = s.fieldOfView, .model = s.bearing}));
  }
}

DeviceData makeLandmarks(const Parameters& p) {
  const LandmarksSettings s = readLandmarksSettings(p);
  DeviceData data;
  if (!s.isList) {
    addEach(s, data);
    return data;
  }
  LandmarksData::Config config;
  config.identities = s.identities;
  config.maxRange = s.maxRange;
  config.fieldOfView = s.fieldOfView;
  config.range = s.range;
  config.bearing = s.bearing;
  data.push_back(std::make_unique<LandmarksData>(s.id, s.mounting.pose, config));
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("landmarks_data", ortung::provideData<ortung::makeLandmarks>("landmarks"));
