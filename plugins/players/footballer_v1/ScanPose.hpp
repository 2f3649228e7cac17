#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <cmath>
#include <optional>
#include <stdexcept>

#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {

/// A pose from single scans: the newest position from one of them (lrf_iconic), extrapolated by
/// odometry. Earlier positions are used only to choose among places that look alike.
class ScanPose {
 public:
  /// @param told start pose
  /// @throws std::runtime_error for a robot without positions
  ScanPose(PlayerSeat& seat, const Pose2& told) : fix_(told), since_(seat.now()) {
    if (find(seat) == nullptr)
      throw std::runtime_error(
          "its robot has no sensor with a feature 'position', which sees=scan needs (lrf_iconic)");
  }

  void update(PlayerSeat& seat) {
    const SensorContainer::ReadLock lock = seat.container().read();
    const SensorData* odometry = seat.container().find({.type = "odometry"});
    if (const auto moved =
            odometry == nullptr ? std::nullopt : readingAs<OdometryData>(*odometry)) {
      if (!last_) atFix_ = moved->pose;
      last_ = moved;
      lastStamp_ = odometry->stamp();
    }
    const SensorData* position = find(seat);
    if (position == nullptr || position->sequence() == seen_) return;
    seen_ = position->sequence();
    const Pose2 expected = at(position->stamp());
    const PoseFixData::Fix* nearest = nullptr;
    const auto fixes = readingAs<PoseFixData>(*position).value_or(PoseFixData::Reading());
    for (const PoseFixData::Fix& fix : fixes)
      if (nearest == nullptr || away(fix.pose, expected) < away(nearest->pose, expected))
        nearest = &fix;
    if (nearest == nullptr) return;
    fix_ = nearest->pose;
    since_ = position->stamp();
    atFix_ = odometryAt(since_);
  }
  Pose2 at(Timestamp stamp) const {
    return last_ ? fix_ * (inverse(atFix_) * odometryAt(stamp)) : fix_;
  }

 private:
  static const SensorData* find(PlayerSeat& seat) {
    const SensorData* data = seat.container().find({.feature = "position"});
    return data != nullptr && isOf(*data, formats::kFix) ? data : nullptr;
  }
  static double away(const Pose2& a, const Pose2& b) {
    return distance(a, b) + std::abs(wrapAngle(a.theta - b.theta));
  }
  /// Returns the odometry pose at a time, extrapolated forwards or backwards with the last
  /// velocity.
  Pose2 odometryAt(Timestamp stamp) const {
    const double dt = toSeconds(stamp - lastStamp_);
    const double turn = last_->rotationalVelocity * dt;
    const double c = std::cos(0.5 * turn);
    const double s = std::sin(0.5 * turn);
    const double x = last_->translationalVelocity * dt;
    const double y = last_->lateralVelocity * dt;
    return last_->pose * Pose2{c * x - s * y, s * x + c * y, turn};
  }

  Pose2 fix_;
  Timestamp since_;
  Pose2 atFix_;  ///< odometry pose at since_
  std::optional<OdometryData::Reading> last_;
  Timestamp lastStamp_ = 0;
  std::uint64_t seen_ = 0;
};

}  // namespace ortung
