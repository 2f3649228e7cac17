#include "ortung/formats/FeatureOf.hpp"

#include <algorithm>
#include <string_view>

#include "ortung/core/ReadingAs.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/ObstaclesData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/formats/TalkData.hpp"

namespace ortung {
namespace {

using Make = std::unique_ptr<SensorData> (*)(const SensorId& id, const Pose2& mount,
                                             const Format& format,
                                             std::span<const std::uint32_t> words);

struct Maker {
  std::string_view name;
  Make make;
};

template <class Data>
constexpr Maker of() {
  return {Data::kFormat,
          [](const SensorId& id, const Pose2& mount, const Format& format,
             std::span<const std::uint32_t> words) -> std::unique_ptr<SensorData> {
            return makeAs<Data>(id, mount, format, words);
          }};
}

constexpr Maker kMakers[] = {of<ScalarData>(),  of<BearingData>(),   of<ConeData>(),
                             of<ScanData>(),    of<LandmarksData>(), of<PointsData>(),
                             of<PoseFixData>(), of<PoseData>(),      of<OdometryData>(),
                             of<ObjectsData>(), of<ObstaclesData>(), of<TalkData>(),
                             of<PlacesData>()};

}  // namespace

bool isOf(const SensorData& feature, const char* format) {
  return feature.format().name() == format;
}

std::unique_ptr<SensorData> featureOf(const SensorId& id, const Pose2& mount, const Format& format,
                                      std::span<const std::uint32_t> words) {
  const auto* const maker =
      std::find_if(std::begin(kMakers), std::end(kMakers),
                   [&](const Maker& one) { return one.name == format.name(); });
  return maker == std::end(kMakers) ? nullptr : maker->make(id, mount, format, words);
}

const SensorData* firstOf(std::span<const std::unique_ptr<SensorData>> features,
                          const char* format) {
  const auto found = std::find_if(features.begin(), features.end(),
                                  [&](const auto& one) { return isOf(*one, format); });
  return found == features.end() ? nullptr : found->get();
}

}  // namespace ortung
