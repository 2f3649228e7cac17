#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "IconicSettings.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/sim_api/Colour.hpp"
#include "ortung/sim_api/Noise.hpp"
#include "ortung/sim_api/Rays2.hpp"
#include "ortung/sim_api/Sensor.hpp"
#include "ortung/sim_api/Sight.hpp"

namespace ortung {

/// A camera that delivers the objects in its image instead of the image (paper, section 4).
class IconicSensor : public Sensor {
 public:
  explicit IconicSensor(IconicSettings settings)
      : settings_(std::move(settings)),
        noise_{.rangeSigma = settings_.noiseRangeSigma,
               .rangeSigmaPerMetre = settings_.noiseRangeSigmaPerMetre,
               .bearingSigma = settings_.noiseBearingSigma,
               .missedShare = settings_.missedShare,
               .falseShare = settings_.falseShare} {}

  void generateData(const World& world, const RobotState& robot, Random* noise, Timestamp now,
                    std::span<SensorData* const> data) override {
    world_ = &world;
    random_ = noise;
    eye_ = {.pose = robot.pose * settings_.mounting.pose,
            .z = settings_.mounting.z,
            .fieldOfView = settings_.fieldOfView,
            .minRange = settings_.minRange,
            .maxRange = settings_.maxRange,
            .robot = robot.number};
    for (SensorData* one : data) {
      see(one->id().feature);
      one->setData(now, words_);
    }
  }

  double period() const override { return settings_.period; }
  double rays() const override {
    constexpr double kCrossings =
        20.0;  // intersections of a scan line with lines of the floor, each tested for visibility
    return kCrossings * settings_.rays;
  }

 private:
  /// Writes the words of a feature into words_.
  void see(std::string_view feature) {
    if (feature == "lines") return lines();
    if (feature == "goals") return landmarks(settings_.goals);
    if (feature == "posts") return landmarks(settings_.posts);
    if (feature == "robots") return objects("robot");
    if (feature == "obstacles") return objects("obstacle");
    objects("ball");
  }

  std::optional<Sighting> sensed(const Sighting& truth) const {
    return random_ == nullptr ? truth : detected(truth, noise_, *random_);
  }
  std::optional<Sighting> imagined(double maxRange) const {
    if (random_ == nullptr) return std::nullopt;
    Eye eye = eye_;
    eye.maxRange = maxRange;
    return falseSighting(eye, noise_, *random_);
  }

  /// Finds the points where scan lines, which radiate from the camera, cross lines on the floor.
  void lines() {
    points_.clear();
    near_.clear();
    for (const FieldLine& line : world_->lines())
      if (leastRange(eye_.pose.x, eye_.pose.y, line) <= settings_.lines.maxRange)
        near_.push_back(&line);
    const bool isAround = settings_.fieldOfView >= kTurn;
    const int gaps = isAround ? settings_.rays : std::max(settings_.rays - 1, 1);
    for (int i = 0; i < settings_.rays; ++i) {
      const double bearing =
          settings_.rays == 1 ? 0.0 : settings_.fieldOfView * (static_cast<double>(i) / gaps - 0.5);
      follow(wrapAngle(bearing));
      if (const auto nothing = imagined(settings_.lines.maxRange); nothing)
        points_.push_back({nothing->range, nothing->bearing});
    }
    if (points_.size() > PointsData::kMostPoints) points_.resize(PointsData::kMostPoints);
    PointsData::encode(points_, words_);
  }

  void follow(double bearing) {
    const Ray2 ray = rayAlong(eye_.pose.x, eye_.pose.y, eye_.pose.theta + bearing);
    crossings_.clear();
    for (const FieldLine* line : near_) addCrossings(ray, *line, crossings_);
    for (const double range : crossings_) {
      if (range < settings_.minRange || range > settings_.lines.maxRange) continue;
      constexpr double kFlat = 0.01;  // slack so that the floor does not hide itself [m]
      if (settings_.occlusion &&
          !isVisible(*world_, eye_, ray.x + range * ray.dx, ray.y + range * ray.dy, 0.0, kFlat))
        continue;
      if (const auto point = sensed({range, bearing}))
        points_.push_back({point->range, point->bearing});
    }
  }

  void landmarks(const IconicLandmarks& kind) {
    sightings_.clear();
    const double maxRange = kind.areIdentified ? kind.list.maxRange : kind.points.maxRange;
    for (const Landmark& landmark : world_->landmarks()) {
      if (landmark.kind != kind.kind || !isWanted(kind, landmark.identity)) continue;
      const auto truth = lookAt(eye_, landmark.x, landmark.y);
      if (!truth || truth->range > maxRange) continue;
      if (settings_.occlusion &&
          !isVisible(*world_, eye_, landmark.x, landmark.y, landmark.z, settings_.slack))
        continue;
      if (const auto seen = sensed(*truth))
        sightings_.push_back({landmark.identity, seen->range, seen->bearing});
    }
    if (const auto nothing = imagined(maxRange))
      sightings_.push_back({anyIdentity(kind), nothing->range, nothing->bearing});
    if (kind.areIdentified) return LandmarksData::encode(sightings_, words_);
    points_.clear();
    for (const auto& sighting : sightings_) points_.push_back({sighting.range, sighting.bearing});
    PointsData::encode(points_, words_);
  }

  static bool isWanted(const IconicLandmarks& kind, std::uint32_t identity) {
    const auto& wanted = kind.list.identities;
    return !kind.areIdentified || std::find(wanted.begin(), wanted.end(), identity) != wanted.end();
  }
  std::uint32_t anyIdentity(const IconicLandmarks& kind) const {
    const auto& known = kind.list.identities;
    return known.empty() ? 0 : known[random_->below(known.size())];
  }

  void objects(std::string_view kind) {
    objects_.clear();
    for (const WorldObject& object : world_->objects()) {
      if (object.kind != kind) continue;
      const bool isOwn = object.robot != 0 && object.robot == eye_.robot;
      if (isOwn || objects_.size() + 1 >= ObjectsData::kMostObjects) continue;
      const auto truth = lookAt(eye_, object.pose.x, object.pose.y);
      if (!truth) continue;
      if (settings_.occlusion) {
        const double share = visibleShare(*world_, eye_, object);
        if (share <= 0.0 || share < settings_.visibleShare) continue;
      }
      if (const auto seen = sensed(*truth))
        objects_.push_back({0, rgbOf(object.colour).value_or(ObjectsData::kNoColour), seen->range,
                            seen->bearing, object.radius});
    }
    if (const auto nothing = imagined(settings_.maxRange))
      objects_.push_back({0, ObjectsData::kNoColour, nothing->range, nothing->bearing, 0.0});
    ObjectsData::encode(objects_, words_);
  }

  IconicSettings settings_;
  SightingNoise noise_;
  // The arguments of the current call of generateData().
  const World* world_ = nullptr;
  Random* random_ = nullptr;  ///< random numbers of the noise; null: without noise
  Eye eye_;
  std::vector<const FieldLine*> near_;  ///< lines within range
  // Buffers, which are reused so that a look allocates nothing.
  std::vector<double> crossings_;  ///< ranges at which a scan line crosses lines [m]
  std::vector<PointsData::Point> points_;
  LandmarksData::Reading sightings_;
  std::vector<ObjectsData::Object> objects_;
  std::vector<std::uint32_t> words_;
};

}  // namespace ortung
