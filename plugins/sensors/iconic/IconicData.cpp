#include "IconicSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/LandmarksData.hpp"

namespace ortung {
namespace {

std::unique_ptr<SensorData> makeLandmarks(const SensorId& id, const Pose2& mount,
                                          const IconicLandmarks& landmarks) {
  if (landmarks.areIdentified) return std::make_unique<LandmarksData>(id, mount, landmarks.list);
  return std::make_unique<PointsData>(id, mount, landmarks.points);
}

std::unique_ptr<SensorData> makeFeature(const IconicSettings& s, const std::string& feature) {
  SensorId id = s.id;
  id.feature = feature;
  if (feature == "lines") return std::make_unique<PointsData>(id, s.mounting.pose, s.lines);
  if (feature == "goals") return makeLandmarks(id, s.mounting.pose, s.goals);
  if (feature == "posts") return makeLandmarks(id, s.mounting.pose, s.posts);
  return std::make_unique<ObjectsData>(id, s.mounting.pose);
}

DeviceData makeFeatures(const IconicSettings& s) {
  DeviceData data;
  for (const std::string& feature : s.see) data.push_back(makeFeature(s, feature));
  return data;
}

DeviceData makeOmnivision(const Parameters& p) { return makeFeatures(readOmnivisionSettings(p)); }
DeviceData makeCamera(const Parameters& p) { return makeFeatures(readCameraSettings(p)); }

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("iconic_data", ortung::provideData<ortung::makeOmnivision>("iconic_omnivision"),
               ortung::provideData<ortung::makeCamera>("iconic_camera"));
