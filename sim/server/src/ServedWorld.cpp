#include "ortung/server/ServedWorld.hpp"

namespace ortung {

ServeError::~ServeError() = default;
ServedWorld::~ServedWorld() = default;

std::vector<ServedFeature> servedFeatures(const SensorContainer& container) {
  std::vector<ServedFeature> features;
  for (const std::unique_ptr<SensorData>& data : container.all())
    features.push_back({data->id(), data->wordsHelp(), data->mount()});
  return features;
}

}  // namespace ortung
