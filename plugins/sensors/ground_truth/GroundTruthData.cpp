#include "GroundTruthSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/PoseData.hpp"

namespace ortung {
namespace {

DeviceData makeGroundTruth(const Parameters& p) {
  DeviceData data;
  data.push_back(std::make_unique<PoseData>(readGroundTruthSettings(p).id));
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("ground_truth_data", ortung::provideData<ortung::makeGroundTruth>("ground_truth"));
