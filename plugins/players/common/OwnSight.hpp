#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ScanPose.hpp"
#include "Steering.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/mcl_player/SelfLocalization.hpp"

namespace ortung {

/// The source of a player's knowledge of its robot's pose.
enum class SightMode : std::uint8_t {
  kTruth,     ///< the stage, from which everything else is known, too
  kFeatures,  ///< the ground truth feature; all else by its robot's camera
  kScan,      ///< the newest position of a single scan; all else by the camera
  kLocalized  ///< MCL on all that its robot senses; all else by the camera
};

inline const PlayerOption kSeesOption{
    "sees", "truth|features|scan|localized", "truth",
    "the true state; or its camera, with its own pose by ground truth, single scans or MCL"};

/// A sighting by a robot's camera, relative to the robot at that time.
struct Sighting {
  Timestamp stamp = 0;
  Pose2 inRobot;       ///< place in the robot frame, with heading 0 [m]
  double sigma = 0.0;  ///< approximate standard deviation of a coordinate [m]
};

/// A player's own view: its pose from one of four sources, and its camera's sightings.
class OwnSight {
 public:
  explicit OwnSight(SightMode mode) : mode_(mode) {}
  /// Reads the option `sees`. @throws ConfigError
  static SightMode read(const Parameters& p, const std::string& fallback = "truth") {
    static const std::vector<std::string> kModes = {"truth", "features", "scan", "localized"};
    const std::string name = p.choiceOr("sees", fallback, kModes);
    return static_cast<SightMode>(std::find(kModes.begin(), kModes.end(), name) - kModes.begin());
  }

  bool isTruth() const { return mode_ == SightMode::kTruth; }
  bool needsTables() const { return mode_ == SightMode::kLocalized; }
  /// Returns the file of a robot that has the sensors: "NAME.toml", "NAME_scan.toml" or
  /// "NAME_lrf.toml".
  std::string robotFile(const std::string& name) const {
    const char* scanner = mode_ == SightMode::kScan        ? "_scan"
                          : mode_ == SightMode::kLocalized ? "_lrf"
                                                           : "";
    return name + scanner + ".toml";
  }

  /// Begins at a pose that is known with these standard deviations [m], [rad].
  void begin(PlayerSeat& seat, const Pose2& told, double sigma, double sigmaHeading) {
    if (mode_ == SightMode::kScan) scan_.emplace(seat, told);
    if (mode_ == SightMode::kLocalized) {
      if (!self_) self_ = std::make_unique<SelfLocalization>(seat);
      self_->startAt(told, sigma, sigmaHeading);
    }
  }
  /// Updates the view; to be called whenever the player acts, before other functions.
  void update(PlayerSeat& seat) {
    if (scan_) scan_->update(seat);
    if (self_) self_->update(seat);
    stamp_ = seat.now();
    pose_ = poseAt(seat, stamp_);
  }
  /// Turns a pose on the other half of the field to its own. A field looks the same from both ends
  /// to a scanner, and MCL may find the wrong one after the referee has carried the robot.
  /// @param goal middle of the goal that the robot does not leave, in the field frame, whose origin
  ///   is the field's middle
  void keepTo(const FloorPoint& goal) {
    constexpr double kBeyond = 0.5;  // from the middle line [m]
    constexpr double kWithin = 0.2;  // standard deviation of what is turned [m], [rad]
    if (!self_ || !pose_ || pose_->x * (goal.x > 0.0 ? 1.0 : -1.0) > -kBeyond) return;
    pose_ = Pose2{-pose_->x, -pose_->y, wrapAngle(pose_->theta + 0.5 * kTurn)};
    self_->startAt(*pose_, kWithin, kWithin);
  }
  /// Returns the robot's current pose; nothing before the first readings.
  const std::optional<Pose2>& pose() const { return pose_; }
  std::optional<BelievedPose> believed() const {
    return pose_ ? std::optional(BelievedPose{stamp_, *pose_}) : std::nullopt;
  }

  /// Return the ball and the robots in the newest image; each appears once. @throws
  /// std::runtime_error for a robot whose sensors have no feature of that name
  std::optional<Sighting> ball(PlayerSeat& seat) const {
    const auto seen = objects(seat, "ball");
    return seen.empty() ? std::nullopt : std::optional(seen.front());  // false detections are last
  }
  std::vector<Sighting> robots(PlayerSeat& seat) const { return objects(seat, "robots"); }

 private:
  /// Standard deviation of a camera's places at range 0 [m].
  static constexpr double kSigma = 0.02;
  /// Growth of the standard deviation with range [m/m].
  static constexpr double kSigmaPerMetre = 0.03;

  std::optional<Pose2> poseAt(PlayerSeat& seat, Timestamp now) const {
    switch (mode_) {
      case SightMode::kTruth:
        return poseOf(seat);
      case SightMode::kFeatures:
        return seat.container().get<PoseData>({.type = "groundTruth"});
      case SightMode::kScan:
        return scan_ ? std::optional(scan_->at(now)) : std::nullopt;
      case SightMode::kLocalized:
        break;
    }
    const auto estimate = self_ ? self_->estimate(now) : std::nullopt;
    return estimate ? std::optional(estimate->pose) : std::nullopt;
  }

  static std::vector<Sighting> objects(PlayerSeat& seat, const char* feature) {
    const SensorContainer::ReadLock lock = seat.container().read();
    const SensorData* seen = seat.container().find({.feature = feature});
    if (seen == nullptr || !isOf(*seen, formats::kObjects))
      throw std::runtime_error(std::string("its robot has no sensor with a feature '") + feature +
                               "', which it needs unless sees=truth");
    std::vector<Sighting> sightings;
    const auto objects = readingAs<ObjectsData>(*seen).value_or(ObjectsData::Reading());
    for (const ObjectsData::Object& one : objects) {
      const double angle = seen->mount().theta + one.bearing;
      sightings.push_back({seen->stamp(),
                           {seen->mount().x + one.range * std::cos(angle),
                            seen->mount().y + one.range * std::sin(angle), 0.0},
                           kSigma + kSigmaPerMetre * one.range});
    }
    return sightings;
  }

  SightMode mode_;
  std::optional<ScanPose> scan_;
  std::unique_ptr<SelfLocalization> self_;
  Timestamp stamp_ = 0;
  std::optional<Pose2> pose_;  ///< pose at stamp_
};

}  // namespace ortung
