#include "ortung/server/ServedWorld.hpp"

#include <cmath>
#include <numbers>

#include "ortung/formats/PoseData.hpp"

namespace ortung {

ServeError::~ServeError() = default;
ServedField::~ServedField() = default;
ServedTime::~ServedTime() = default;
ServedRobots::~ServedRobots() = default;
ServedWorld::~ServedWorld() = default;

std::uint32_t headingWord(double radians) {
  const double turns = radians / (2.0 * std::numbers::pi);
  return static_cast<std::uint32_t>(std::lround((turns - std::floor(turns)) * 36000.0)) % 36000u;
}

std::array<std::uint32_t, 5> robotWords(RobotId robot, const Pose2& poseInField,
                                        std::uint32_t states) {
  const std::vector<std::uint32_t> pose = PoseData::encode(poseInField);
  return {robot, pose[0], pose[1], headingWord(poseInField.theta), states};
}

std::vector<ServedFeature> servedFeatures(const SensorContainer& container) {
  std::vector<ServedFeature> features;
  for (const std::unique_ptr<SensorData>& data : container.all())
    features.push_back({data->id(), data->wordsHelp(), data->mount(), data->format().toText()});
  return features;
}

}  // namespace ortung
