#include "ortung/formats/FeatureOf.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

#include "ortung/base/Angles.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/ObstaclesData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PlacesData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/TalkData.hpp"

namespace ortung {
namespace {

struct Described {
  const SensorId& id;
  const Pose2& mount;
  const Format& format;
  std::span<const std::uint32_t> words;
};
using Make = std::unique_ptr<SensorData> (*)(const Described&);

std::unique_ptr<SensorData> makeRange(const Described& it) {
  ScalarData::Config config;
  if (it.format.has("max_m")) config.maxRange = it.format.number("max_m");
  return std::make_unique<ScalarData>(it.id, it.mount, config);
}

std::unique_ptr<SensorData> makeCone(const Described& it) {
  ConeData::Config config;
  config.openingAngle = it.format.angle("opening_deg");
  config.maxRange = it.format.number("max_m");
  return std::make_unique<ConeData>(it.id, it.mount, config);
}

std::unique_ptr<SensorData> makeLandmarks(const Described& it) {
  std::set<std::uint32_t> identities;
  for (std::size_t i = 0; i < it.words.size(); i += 3) identities.insert(it.words[i]);
  if (identities.empty()) identities.insert(0);
  return std::make_unique<LandmarksData>(
      it.id, it.mount,
      LandmarksData::Config{.identities = {identities.begin(), identities.end()}, .range = {}});
}

/// Makes features that need nothing but their names.
template <class Data>
std::unique_ptr<SensorData> make(const Described& it) {
  if constexpr (requires { Data(it.id, it.mount, {}); })
    return std::make_unique<Data>(it.id, it.mount, typename Data::Config{});
  else if constexpr (requires { Data(it.id, it.mount); })
    return std::make_unique<Data>(it.id, it.mount);
  else
    return std::make_unique<Data>(it.id);
}

struct Maker {
  std::string_view name;
  Make make;
};
constexpr Maker kMakers[] = {
    {formats::kRange, makeRange},
    {formats::kBearing, make<BearingData>},
    {formats::kCone, makeCone},
    {formats::kScan,
     [](const Described& it) -> std::unique_ptr<SensorData> {
       return std::make_unique<ScanData>(it.id, it.mount, scanOf(it.format));
     }},
    {formats::kLandmarks, makeLandmarks},
    {formats::kPoints, make<PointsData>},
    {formats::kFix,
     [](const Described& it) -> std::unique_ptr<SensorData> {
       return std::make_unique<PoseFixData>(it.id, PoseFixData::Config{});
     }},
    {formats::kPose, make<PoseData>},
    {formats::kOdometry, make<OdometryData>},
    {formats::kObjects, make<ObjectsData>},
    {formats::kObstacles, make<ObstaclesData>},
    {formats::kTalk, make<TalkData>},
    {formats::kPlaces, make<PlacesData>},
};

/// Returns a feature of the class with the words of another one; null if the format differs.
template <class Data>
std::unique_ptr<Data> copyOf(const SensorData& feature, const char* name) {
  try {
    const Format format = feature.format();
    if (format.name() != name) return nullptr;
    auto made = featureOf(feature.id(), feature.mount(), format, feature.getData());
    made->setData(feature.stamp(), feature.getData());
    return std::unique_ptr<Data>(static_cast<Data*>(made.release()));
  } catch (const std::invalid_argument&) {
    return nullptr;  // it only claims to have the format
  }
}

}  // namespace

bool isOf(const SensorData& feature, const char* format) {
  return feature.format().name() == format;
}

ScanData::Config scanOf(const Format& format) {
  ScanData::Config scan;
  const double beams = format.number("beams");
  constexpr double kMost = 8192;  // as ScanData has it
  if (!(beams >= 1.0 && beams <= kMost && beams == std::floor(beams)))
    throw std::invalid_argument("found a scan of " + format.text("beams") + " beams");
  scan.beams = static_cast<int>(beams);
  scan.firstAngle = format.angle("first_deg");
  scan.angleStep = format.angle("step_deg");
  scan.maxRange = format.number("max_m");
  if (format.has("min_m")) scan.minRange = format.number("min_m");
  return scan;
}

std::unique_ptr<SensorData> featureOf(const SensorId& id, const Pose2& mount, const Format& format,
                                      std::span<const std::uint32_t> words) {
  const auto* const maker =
      std::find_if(std::begin(kMakers), std::end(kMakers),
                   [&](const Maker& one) { return one.name == format.name(); });
  return maker == std::end(kMakers) ? nullptr : maker->make({id, mount, format, words});
}

const SensorData* firstOf(std::span<const std::unique_ptr<SensorData>> features,
                          const char* format) {
  const auto found = std::find_if(features.begin(), features.end(),
                                  [&](const auto& one) { return isOf(*one, format); });
  return found == features.end() ? nullptr : found->get();
}

std::unique_ptr<ScalarData> ScalarData::like(const SensorData& feature) {
  return copyOf<ScalarData>(feature, formats::kRange);
}
std::unique_ptr<BearingData> BearingData::like(const SensorData& feature) {
  return copyOf<BearingData>(feature, formats::kBearing);
}
std::unique_ptr<ConeData> ConeData::like(const SensorData& feature) {
  return copyOf<ConeData>(feature, formats::kCone);
}
std::unique_ptr<ScanData> ScanData::like(const SensorData& feature) {
  return copyOf<ScanData>(feature, formats::kScan);
}
std::unique_ptr<LandmarksData> LandmarksData::like(const SensorData& feature) {
  return copyOf<LandmarksData>(feature, formats::kLandmarks);
}
std::unique_ptr<PointsData> PointsData::like(const SensorData& feature) {
  return copyOf<PointsData>(feature, formats::kPoints);
}
std::unique_ptr<PoseFixData> PoseFixData::like(const SensorData& feature) {
  return copyOf<PoseFixData>(feature, formats::kFix);
}
std::unique_ptr<PoseData> PoseData::like(const SensorData& feature) {
  return copyOf<PoseData>(feature, formats::kPose);
}
std::unique_ptr<OdometryData> OdometryData::like(const SensorData& feature) {
  return copyOf<OdometryData>(feature, formats::kOdometry);
}
std::unique_ptr<ObjectsData> ObjectsData::like(const SensorData& feature) {
  return copyOf<ObjectsData>(feature, formats::kObjects);
}
std::unique_ptr<ObstaclesData> ObstaclesData::like(const SensorData& feature) {
  return copyOf<ObstaclesData>(feature, formats::kObstacles);
}
std::unique_ptr<TalkData> TalkData::like(const SensorData& feature) {
  return copyOf<TalkData>(feature, formats::kTalk);
}
std::unique_ptr<PlacesData> PlacesData::like(const SensorData& feature) {
  return copyOf<PlacesData>(feature, formats::kPlaces);
}

}  // namespace ortung
