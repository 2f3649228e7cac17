#include "../iconic/IconicSensor.hpp"
#include "ImageFeaturesSettings.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

IconicSettings forecastOf(const ImageFeaturesSettings& s) {
  IconicSettings iconic;
  iconic.id = s.id;
  iconic.mounting.z = 0.6;
  iconic.see = s.see;
  iconic.maxRange = std::max(s.maxRange, s.lines.maxRange);
  iconic.period = s.period;
  iconic.rays = 180;
  iconic.lines = s.lines;
  iconic.goals = {.kind = "goal", .areIdentified = true, .list = s.goals, .points = {}};
  iconic.posts = {.kind = "post", .areIdentified = false, .list = {}, .points = s.posts};
  iconic.occlusion = false;
  return iconic;
}

/// Generates the features of perfect pictures at a pose, for learning, which would otherwise have
/// to render a picture at every pose. Robots on a field use their cameras.
class ImageFeaturesSensor : public IconicSensor {
 public:
  explicit ImageFeaturesSensor(const Parameters& p)
      : IconicSensor(forecastOf(readImageFeaturesSettings(p))) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    if (robot.number == 0) IconicSensor::generateData(world, robot, noise, now, data);
  }
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("image_features_sensor",
               ortung::provide<ortung::Sensor, ortung::ImageFeaturesSensor>("image_features"));
