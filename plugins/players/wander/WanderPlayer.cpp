// Drives endlessly from one random place to another, preferring unvisited ones, and so covers
// everything it can reach. It uses its true pose; navigation by its own estimate would be another
// player.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "Steering.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {
namespace {

/// The path of a robot that covers everything it can reach.
class Wandering {
 public:
  Wandering(std::shared_ptr<const FloorPlan> plan, const DriveLimits& limits)
      : plan_(std::move(plan)), steering_(limits) {
    const FieldGrid& grid = plan_->grid();
    perBlock_ = std::max(static_cast<int>(std::lround(kBlock / grid.cell)), 1);
    blockColumns_ = (grid.columns + perBlock_ - 1) / perBlock_;
    const int blockRows = (grid.rows + perBlock_ - 1) / perBlock_;
    visited_.assign(static_cast<std::size_t>(blockColumns_) * static_cast<std::size_t>(blockRows),
                    0);
  }

  void command(const Pose2& pose, Timestamp now, Random& random, RobotCommands& robot) {
    if (steering_.speed() <= 0.0) return Steering::stand(robot);
    markVisited(pose);
    if (isStuck(pose, now)) {
      route_.clear();
      backUntil_ = now + kBackTime;
    }
    if (now < backUntil_) {
      robot.setTranslationalVelocity(-0.3 * steering_.speed());
      robot.setRotationalVelocity(0.0);
      return;
    }
    constexpr int kTries = 4;  // a goal may be where the robot already is
    for (int i = 0; i < kTries; ++i) {
      while (next_ < route_.size() && steering_.steer(pose, route_[next_], robot)) ++next_;
      if (next_ < route_.size()) return;
      route_ = plan_->route({pose.x, pose.y}, chooseGoal(pose, random));
      next_ = 0;
    }
    Steering::stand(robot);
  }

 private:
  static constexpr double kBlock =
      0.8;  // edge length of a block, which counts as visited once entered [m]
  static constexpr Timestamp kPatience = 4'000'000;  // time without motion until it is stuck [us]
  static constexpr Timestamp kBackTime = 500'000;    // [us]

  std::size_t blockOf(std::size_t cell) const {
    const auto columns = static_cast<std::size_t>(plan_->grid().columns);
    const auto per = static_cast<std::size_t>(perBlock_);
    return cell / columns / per * static_cast<std::size_t>(blockColumns_) + cell % columns / per;
  }

  void markVisited(const Pose2& pose) {
    const std::ptrdiff_t cell = plan_->grid().cellAt(pose.x, pose.y);
    if (cell >= 0) visited_[blockOf(static_cast<std::size_t>(cell))] = 1;
  }

  /// Returns the nearest of some random cells in unvisited blocks.
  FloorPoint chooseGoal(const Pose2& pose, Random& random) {
    constexpr int kDraws = 64;
    constexpr int kCandidates = 3;
    std::optional<FloorPoint> best;
    FloorPoint last;
    double bestWay = 0.0;
    int found = 0;
    for (int draw = 0; draw < kDraws && found < kCandidates; ++draw) {
      const std::size_t cell = plan_->cells()[random.below(plan_->cells().size())];
      last = {plan_->grid().centreX(cell), plan_->grid().centreY(cell)};
      if (visited_[blockOf(cell)] != 0) continue;
      ++found;
      const double way = std::hypot(last.x - pose.x, last.y - pose.y);
      if (best && way >= bestWay) continue;
      best = last;
      bestWay = way;
    }
    if (best) return *best;
    std::fill(visited_.begin(), visited_.end(),
              std::uint8_t{0});  // everything was visited: it starts again
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

  std::shared_ptr<const FloorPlan> plan_;
  Steering steering_;
  int perBlock_ = 1;  ///< number of cells along the edge of a block
  int blockColumns_ = 1;
  std::vector<std::uint8_t> visited_;  ///< whether each block was visited
  std::vector<FloorPoint> route_;
  std::size_t next_ = 0;
  std::optional<Pose2> anchor_;  ///< pose at which it last moved
  Timestamp anchorTime_ = 0;
  Timestamp backUntil_ = 0;
};

class WanderPlayer : public Player {
 public:
  explicit WanderPlayer(const Parameters& p) : speed_(speedOption(p)) {}

  bool needsStage() const override { return true; }
  void begin(PlayerSeat& seat) override {
    wandering_.emplace(seat.stage()->floorPlan({seat.abilities().radius, seat.abilities().height}),
                       limitsOf(seat, speed_));
  }
  bool senseAndAct(PlayerSeat& seat) override {
    wandering_->command(poseOf(seat), seat.now(), seat.random(), seat.robot());
    return true;
  }

 private:
  std::optional<double> speed_;
  std::optional<Wandering> wandering_;
};

struct WanderHelp : PlayerHelp {
  explicit WanderHelp(const Parameters&)
      : PlayerHelp("drives endlessly to random places, preferring unvisited ones", {kSpeedOption}) {
  }
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("wander", ortung::provide<ortung::Player, ortung::WanderPlayer>("wander"),
               ortung::provide<ortung::PlayerHelp, ortung::WanderHelp>("wander"));
