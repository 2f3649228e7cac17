#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "LandmarksSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {
namespace {

using Sighting = LandmarksData::Sighting;

class LandmarksSensor : public Sensor {
 public:
  explicit LandmarksSensor(const Parameters& p) : settings_(readLandmarksSettings(p)) {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    look(world, robot, noise);
    for (SensorData* one : data) {
      words_.clear();
      if (settings_.isList)
        encodeAll();
      else
        encodeOne(one->id().feature);
      one->setData(now, words_);
    }
  }

  double period() const override { return settings_.period; }
  double rays() const override { return static_cast<double>(settings_.identities.size()); }

 private:
  /// Writes the visible landmarks into seen_. A landmark's distance and bearing are detected, or
  /// missed, together.
  void look(const World& world, const RobotState& robot, Random* noise) {
    const Pose2 sensor = robot.pose * settings_.mounting.pose;
    seen_.clear();
    for (const std::uint32_t identity : settings_.identities) {
      const std::optional<Sighting> sighting = truth(world, sensor, robot.number, identity);
      if (!sighting) continue;
      if (noise == nullptr)
        seen_.push_back(*sighting);
      else if (!(noise->uniform() < settings_.missedShare))
        seen_.push_back(measured(*sighting, *noise));
    }
  }

  std::optional<Sighting> truth(const World& world, const Pose2& sensor, RobotNumber robot,
                                std::uint32_t identity) const {
    const Landmark* landmark = find(world, identity);
    if (landmark == nullptr) return std::nullopt;
    const double dx = landmark->x - sensor.x;
    const double dy = landmark->y - sensor.y;
    const double dz = settings_.slant ? landmark->z - settings_.mounting.z : 0.0;
    const Sighting sighting{identity, settings_.rangeScale * std::hypot(dx, dy, dz),
                            wrapAngle(std::atan2(dy, dx) - sensor.theta)};
    const bool isInView =
        settings_.fieldOfView >= kTurn || std::abs(sighting.bearing) <= settings_.fieldOfView / 2.0;
    if (!isInView || sighting.range < settings_.minRange || sighting.range > settings_.maxRange)
      return std::nullopt;
    if (settings_.occlusion &&
        !world.isVisible(sensor.x, sensor.y, settings_.mounting.z, landmark->x, landmark->y,
                         landmark->z, robot, settings_.slack))
      return std::nullopt;
    return sighting;
  }

  const Landmark* find(const World& world, std::uint32_t identity) const {
    for (const Landmark& landmark : world.landmarks())
      if (landmark.identity == identity && landmark.kind == settings_.kind) return &landmark;
    return nullptr;
  }

  Sighting measured(Sighting sighting, Random& noise) const {
    if (!settings_.isIdentified) sighting.identity = LandmarksData::kUnknown;
    if (noise.uniform() < settings_.falseShare) {
      sighting.range = noise.uniform(settings_.minRange, settings_.maxRange);
      sighting.bearing = wrapAngle(settings_.fieldOfView * (noise.uniform() - 0.5));
      return sighting;
    }
    const SightingBias::Sight biased = settings_.bias.measured({sighting.range, sighting.bearing});
    sighting.range = biased.range;
    sighting.bearing = biased.bearing;
    const double sigma =
        settings_.noiseRangeSigma + settings_.noiseRangeSigmaPerMetre * sighting.range;
    sighting.range = std::max(sighting.range + sigma * noise.gaussian(), 0.0);
    sighting.bearing = wrapAngle(sighting.bearing + settings_.noiseBearingSigma * noise.gaussian());
    return sighting;
  }

  void encodeAll() {
    for (const Sighting& sighting : seen_) {
      words_.push_back(sighting.identity);
      words_.push_back(words::fromMetres(sighting.range));
      words_.push_back(words::fromAngle(sighting.bearing));
    }
  }

  /// Encodes one feature. @param feature its name, e.g. "post3Distance"
  void encodeOne(std::string_view feature) {
    feature.remove_prefix(std::min(settings_.kind.size(), feature.size()));
    std::uint32_t identity = 0;
    const char* end = feature.data() + feature.size();
    const char* ending = std::from_chars(feature.data(), end, identity).ptr;
    for (const Sighting& sighting : seen_) {
      if (sighting.identity != identity) continue;
      const bool isDistance =
          std::string_view(ending, static_cast<std::size_t>(end - ending)) == kDistanceEnding;
      words_.push_back(isDistance ? words::fromMetres(sighting.range)
                                  : words::fromAngle(sighting.bearing));
    }
  }

  LandmarksSettings settings_;
  std::vector<Sighting> seen_;
  std::vector<std::uint32_t> words_;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("landmarks_sensor",
               ortung::provide<ortung::Sensor, ortung::LandmarksSensor>("landmarks"));
