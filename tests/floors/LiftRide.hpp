#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "DrawnBuilding.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::testing {

/// A robot of kRoundRobot that drives through a DrawnBuilding, and rides its lift, of which neither
/// odometry nor its scans tell: the cabin's door is closed meanwhile.
class LiftRide {
 public:
  static constexpr double kPeriod = 0.2;  ///< of scans [s]

  LiftRide(const SimWorld& world, std::uint64_t seed)
      : world_(world.another()), building_(world_->region(0.5, {}).building), random_(seed, 77) {
    Primitive leaf;
    leaf.halfX = 0.7;
    leaf.halfY = 0.04;
    leaf.zHigh = 2.0;
    MovingBody door;
    door.kind = "door";
    door.pieces = {leaf};
    door_ = world_->addBody(door, kAway);
  }

  void standAt(std::size_t floor, const Pose2& pose) {
    floor_ = floor;
    pose_ = pose;
  }
  void closeDoor() { world_->moveBody(door_, at({15.0, 6.95, 0.0})); }
  void openDoor() { world_->moveBody(door_, kAway); }
  /// The lift carries the robot to another floor. @pre the door is closed
  void rideTo(std::size_t floor) {
    floor_ = floor;
    closeDoor();
  }
  std::size_t floor() const { return floor_; }
  /// The robot's pose in the field.
  Pose2 truth() const { return at(pose_); }

  bool isInCorridor() const { return pose_.y > 7.3; }

  /// Turns and drives to a point of the floor. @param take is given what is read meanwhile
  template <class Take>
  void driveTo(double x, double y, Take& take) {
    turn(wrapAngle(std::atan2(y - pose_.y, x - pose_.x) - pose_.theta), take);
    constexpr double kMost = 0.6 * kPeriod;
    for (double left = std::hypot(x - pose_.x, y - pose_.y); left > 1e-3; left -= kMost)
      take(step({std::min(left, kMost), 0, 0}));
  }
  /// Turns where it stands [rad].
  template <class Take>
  void turn(double angle, Take& take) {
    constexpr double kMost = 1.0 * kPeriod;
    for (double left = std::abs(angle); left > 1e-6; left -= kMost)
      take(step({0, 0, std::copysign(std::min(left, kMost), angle)}));
  }
  template <class Take>
  void stand(double seconds, Take& take) {
    for (double left = seconds; left > 0.0; left -= kPeriod) take(step({}));
  }

 private:
  static constexpr Pose2 kAway{-500.0, 0.0, 0.0};

  Pose2 at(const Pose2& pose) const { return building_.floors[floor_].toField(pose); }

  /// Moves the robot by a small motion, whose odometry errs. @returns what it reads then
  std::vector<Message> step(const Pose2& motion) {
    pose_ = pose_ * motion;
    const double way = std::hypot(motion.x, motion.y);
    const double turn = std::abs(motion.theta);
    odometry_ = odometry_ * Pose2{motion.x + 0.02 * std::sqrt(way) * random_.gaussian(), motion.y,
                                  motion.theta + (0.02 * std::sqrt(way) + 0.03 * std::sqrt(turn)) *
                                                     random_.gaussian()};
    now_ += fromSeconds(kPeriod);
    OdometryData::Reading moved;
    moved.pose = odometry_;
    return {{now_, {"odometry", "odometry", "pose"}, OdometryData::encode(moved)},
            {now_, {"lidar", "LRF", "scan"}, scan()}};
  }

  std::vector<std::uint32_t> scan() {
    std::vector<float> ranges(240);
    const Pose2 place = truth();
    world_->castFan(
        {place.x, place.y, 0.3, place.theta - std::numbers::pi, radians(1.5), 0.0, 12.0}, 0,
        ranges);
    for (float& range : ranges) {
      if (range >= 12.0F) range = std::numeric_limits<float>::infinity();
      range += static_cast<float>(0.02 * random_.gaussian());
      // People and glass.
      if (random_.uniform() < 0.05) range *= static_cast<float>(random_.uniform(0.2, 1.0));
    }
    std::vector<std::uint32_t> words;
    ScanData::encode(ranges, 12.0, words);
    return words;
  }

  std::unique_ptr<SimWorld> world_;
  Building building_;
  Random random_;
  RobotNumber door_ = 0;
  std::size_t floor_ = 0;
  Pose2 pose_;      ///< on the floor
  Pose2 odometry_;  ///< as odometry has it
  Timestamp now_ = 0;
};

}  // namespace ortung::testing
