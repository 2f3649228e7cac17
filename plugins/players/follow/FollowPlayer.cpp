// Drives straight from point to point and stops at the last.
#include <optional>
#include <vector>

#include "Steering.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung {
namespace {

std::vector<FloorPoint> pointsOption(const Parameters& p) {
  const std::vector<double> numbers = p.numbers("waypoints_m", -1, {-1e4, 1e4});
  if (numbers.empty() || numbers.size() % 2 != 0)
    p.fail("waypoints_m", "must be x1, y1, x2, y2, ... in metres");
  std::vector<FloorPoint> points;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    points.push_back({numbers[i], numbers[i + 1]});
  return points;
}

class FollowPlayer : public Player {
 public:
  explicit FollowPlayer(const Parameters& p) : points_(pointsOption(p)), speed_(speedOption(p)) {}

  bool needsStage() const override { return true; }
  void begin(PlayerSeat& seat) override { steering_.emplace(limitsOf(seat, speed_)); }
  bool senseAndAct(PlayerSeat& seat) override {
    const Pose2 pose = poseOf(seat);
    while (next_ < points_.size() && steering_->steer(pose, points_[next_], seat.robot())) ++next_;
    if (next_ == points_.size()) Steering::stand(seat.robot());
    return true;
  }

 private:
  std::vector<FloorPoint> points_;
  std::optional<double> speed_;
  std::optional<Steering> steering_;
  std::size_t next_ = 0;
};

struct FollowHelp : PlayerHelp {
  explicit FollowHelp(const Parameters&)
      : PlayerHelp("goes straight from point to point, and stops at the last",
                   {{"waypoints_m", "x1,y1,x2,y2,... in m", "", "points to drive through"},
                    kSpeedOption}) {}
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("follow", ortung::provide<ortung::Player, ortung::FollowPlayer>("follow"),
               ortung::provide<ortung::PlayerHelp, ortung::FollowHelp>("follow"));
