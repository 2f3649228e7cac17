#include "TeammateExtractor.hpp"
#include "TeammateSettings.hpp"
#include "ortung/core/Plugin.hpp"

namespace ortung {
namespace {

DeviceData makeTeammate(const Parameters& p) {
  const TeammateSettings s = readTeammateSettings(p);
  const auto named = [&](const char* feature) { return SensorId{s.id.model, s.id.type, feature}; };
  DeviceData data;
  data.push_back(std::make_unique<PoseFixData>(named("position"), s.fix));
  data.push_back(std::make_unique<PlacesData>(named("robots")));
  data.push_back(std::make_unique<PlacesData>(named("balls")));
  data.push_back(std::make_unique<TalkData>(named(TeammateSettings::kTalk)));
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("teammate_data", ortung::provideData<ortung::makeTeammate>("teammate"),
               ortung::provide<ortung::Extractor, ortung::TeammateExtractor>("teammate"));
