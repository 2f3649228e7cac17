#include "ortung/formats/LandmarksData.hpp"

#include "LandmarksSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ScalarData.hpp"

namespace ortung {
namespace {

/// A format whose distances are not those along the floor: tables hold readings, so they depend on
/// the kind of measurement.
template <class Format>
class Measured : public Format {
 public:
  Measured(const LandmarksSettings& s, const SensorId& id, const typename Format::Config& config)
      : Format(id, s.mounting.pose, config) {
    if (s.slant) key_ += " slant_from_m=" + std::to_string(s.mounting.z);
    if (s.rangeScale != 1.0) key_ += " range_scale=" + std::to_string(s.rangeScale);
  }
  std::string learningKey() const override { return Format::learningKey() + key_; }

 private:
  std::string key_;
};

void addEach(const LandmarksSettings& s, DeviceData& data) {
  for (const std::uint32_t identity : s.identities) {
    SensorId id = s.id;
    if (s.hasDistances) {
      id.feature = s.kind + std::to_string(identity) + kDistanceEnding;
      data.push_back(std::make_unique<Measured<ScalarData>>(
          s, id,
          ScalarData::Config{
              .maxRange = s.maxRange, .fieldOfView = s.fieldOfView, .model = s.range}));
    }
    if (s.hasBearings) {
      id.feature = s.kind + std::to_string(identity) + kBearingEnding;
      data.push_back(std::make_unique<BearingData>(
          id, s.mounting.pose,
          BearingData::Config{.fieldOfView = s.fieldOfView, .model = s.bearing}));
    }
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
  config.identified = s.isIdentified;
  config.maxRange = s.maxRange;
  config.fieldOfView = s.fieldOfView;
  config.range = s.range;
  config.bearing = s.bearing;
  config.bias = s.bias;
  data.push_back(std::make_unique<Measured<LandmarksData>>(s, s.id, config));
  return data;
}

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("landmarks_data", ortung::provideData<ortung::makeLandmarks>("landmarks"));
