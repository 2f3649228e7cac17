#include "ImageFeaturesExtractor.hpp"
#include "ImageFeaturesSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ObjectsData.hpp"

namespace ortung {
namespace {

/// Makes the features, all in the robot frame, so that tables do not depend on the camera's
/// mounting.
DeviceData makeImageFeatures(const Parameters& p) {
  const ImageFeaturesSettings s = readImageFeaturesSettings(p);
  DeviceData data;
  for (const std::string& feature : s.see) {
    SensorId id = s.id;
    id.feature = feature;
    if (feature == "lines")
      data.push_back(std::make_unique<PointsData>(id, Pose2{}, s.lines));
    else if (feature == "posts")
      data.push_back(std::make_unique<PointsData>(id, Pose2{}, s.posts));
    else if (feature == "goals")
      data.push_back(std::make_unique<LandmarksData>(id, Pose2{}, s.goals));
    else
      data.push_back(std::make_unique<ObjectsData>(id));
  }
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS(
    "image_features_data", ortung::provideData<ortung::makeImageFeatures>("image_features"),
    ortung::provide<ortung::Extractor, ortung::ImageFeaturesExtractor>("image_features"));
