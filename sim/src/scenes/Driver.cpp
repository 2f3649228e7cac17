#include "ortung/sim/Driver.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ortung {
namespace {

constexpr double kArrived = 0.05;  // [m]
constexpr double kFacing = 0.35;   // beyond this error of heading it turns on the spot [rad]

/// Turns to a point and drives there.
class Steering {
 public:
  explicit Steering(const DriveLimits& limits) : limits_(limits) {}

  /// Returns whether the robot has arrived; otherwise commands the drive.
  bool steer(const Pose2& pose, const FloorPoint& to, Drive& drive) const {
    const double away = std::hypot(to.x - pose.x, to.y - pose.y);
    if (away < kArrived) return true;
    const double error = wrapAngle(std::atan2(to.y - pose.y, to.x - pose.x) - pose.theta);
    // As fast as half the acceleration can still brake (v^2 = 2 a s).
    const double turn = std::min({limits_.turn, 4.0 * std::abs(error),
                                  std::sqrt(limits_.turnAcceleration * std::abs(error))});
    drive.setRotationalVelocity(error < 0.0 ? -turn : turn);
    const double facing = std::max(1.0 - std::abs(error) / kFacing, 0.0);
    const double braking = std::sqrt(limits_.acceleration * away);
    drive.setTranslationalVelocity(facing * std::min(limits_.speed, braking));
    return false;
  }

  static void stand(Drive& drive) {
    drive.setTranslationalVelocity(0.0);
    drive.setRotationalVelocity(0.0);
  }

  double speed() const { return limits_.speed; }

 private:
  DriveLimits limits_;
};

class Follower : public Driver {
 public:
  Follower(std::vector<FloorPoint> points, const DriveLimits& limits)
      : points_(std::move(points)), steering_(limits) {}

  void command(const Pose2& pose, Timestamp, Drive& drive) override {
    while (next_ < points_.size() && steering_.steer(pose, points_[next_], drive)) ++next_;
    if (next_ == points_.size()) Steering::stand(drive);
  }

 private:
  std::vector<FloorPoint> points_;
  Steering steering_;
  std::size_t next_ = 0;
};

class Wanderer : public Driver {
 public:
  Wanderer(const RoutePlanner& planner, const DriveLimits& limits, const Random& random)
      : planner_(planner), steering_(limits), random_(random) {
    const FieldGrid& grid = planner.grid();
    perBlock_ = std::max(static_cast<int>(std::lround(kBlock / grid.cell)), 1);
    blockColumns_ = (grid.columns + perBlock_ - 1) / perBlock_;
    const int blockRows = (grid.rows + perBlock_ - 1) / perBlock_;
    visited_.assign(static_cast<std::size_t>(blockColumns_) * static_cast<std::size_t>(blockRows),
                    0);
  }

  void command(const Pose2& pose, Timestamp now, Drive& drive) override {
    if (steering_.speed() <= 0.0) return Steering::stand(drive);
    markVisited(pose);
    if (isStuck(pose, now)) {
      route_.clear();
      backUntil_ = now + kBackTime;
    }
    if (now < backUntil_) {
      drive.setTranslationalVelocity(-0.3 * steering_.speed());
      drive.setRotationalVelocity(0.0);
      return;
    }
    constexpr int kTries = 4;  // a goal may be where the robot already is
    for (int i = 0; i < kTries; ++i) {
      while (next_ < route_.size() && steering_.steer(pose, route_[next_], drive)) ++next_;
      if (next_ < route_.size()) return;
      route_ = planner_.route({pose.x, pose.y}, chooseGoal(pose));
      next_ = 0;
    }
    Steering::stand(drive);
  }

 private:
  static constexpr double kBlock = 0.8;              // covered once it was entered [m]
  static constexpr Timestamp kPatience = 4'000'000;  // without moving [us]
  static constexpr Timestamp kBackTime = 500'000;    // [us]

  std::size_t blockOf(std::size_t cell) const {
    const auto columns = static_cast<std::size_t>(planner_.grid().columns);
    const auto per = static_cast<std::size_t>(perBlock_);
    return cell / columns / per * static_cast<std::size_t>(blockColumns_) + cell % columns / per;
  }

  void markVisited(const Pose2& pose) {
    const std::ptrdiff_t cell = planner_.grid().cellAt(pose.x, pose.y);
    if (cell >= 0) visited_[blockOf(static_cast<std::size_t>(cell))] = 1;
  }

  /// The nearest of a few random cells in blocks not yet visited.
  FloorPoint chooseGoal(const Pose2& pose) {
    constexpr int kDraws = 64;
    constexpr int kCandidates = 3;
    std::optional<FloorPoint> best;
    FloorPoint last;
    double bestWay = 0.0;
    int found = 0;
    for (int draw = 0; draw < kDraws && found < kCandidates; ++draw) {
      const std::size_t cell = planner_.cells()[random_.below(planner_.cells().size())];
      last = {planner_.grid().centreX(cell), planner_.grid().centreY(cell)};
      if (visited_[blockOf(cell)] != 0) continue;
      ++found;
      const double way = std::hypot(last.x - pose.x, last.y - pose.y);
      if (best && way >= bestWay) continue;
      best = last;
      bestWay = way;
    }
    if (best) return *best;
    std::fill(visited_.begin(), visited_.end(), std::uint8_t{0});  // all was seen: once more
    return last;
  }

  bool isStuck(const Pose2& pose, Timestamp now) {
    constexpr double kMoved = 0.05;  // [m]
    if (!anchor_ || distance(pose, *anchor_) > kMoved) {
      anchor_ = pose;
      anchorTime_ = now;
    }
    if (now - anchorTime_ < kPatience) return false;
    anchorTime_ = now;
    return true;
  }

  const RoutePlanner& planner_;
  Steering steering_;
  Random random_;
  int perBlock_ = 1;  ///< cells along the edge of a block
  int blockColumns_ = 1;
  std::vector<std::uint8_t> visited_;  ///< by block
  std::vector<FloorPoint> route_;
  std::size_t next_ = 0;
  std::optional<Pose2> anchor_;  ///< where it was last seen moving
  Timestamp anchorTime_ = 0;
  Timestamp backUntil_ = 0;
};

}  // namespace

Driver::~Driver() = default;

std::unique_ptr<Driver> makeWanderer(const RoutePlanner& planner, const DriveLimits& limits,
                                     const Random& random) {
  return std::make_unique<Wanderer>(planner, limits, random);
}

std::unique_ptr<Driver> makeFollower(std::vector<FloorPoint> points, const DriveLimits& limits) {
  return std::make_unique<Follower>(std::move(points), limits);
}

}  // namespace ortung
