#include "MapTransform.hpp"

#include <utility>

#include "ortung/ros2/Messages.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {
namespace {

/// A stamp that is farther back is not repeated: somebody has set the clock [us].
constexpr Timestamp kClockWasSet = 1'000'000;

}  // namespace

void MapTransform::sendBy(std::function<void(std::string_view)> send) {
  const std::lock_guard lock(mutex_);
  send_ = std::move(send);
}

void MapTransform::setTold(bool isTold) {
  const std::lock_guard lock(mutex_);
  isTold_ = isTold;
}

void MapTransform::setAhead(double ahead) {
  const std::lock_guard lock(mutex_);
  ahead_ = ahead;
}

void MapTransform::tell(Timestamp stamp) {
  if (!send_ || !odomInMap_ || !isTold_) return;
  told_ = stamp;
  TfMessage message;
  message.transforms.push_back(
      {{1000 * stamp, options_.map}, options_.odom, fromPose2(*odomInMap_)});
  send_(toCdr(message));
}

void MapTransform::follow(Timestamp odometry) {
  const std::lock_guard lock(mutex_);
  followed_ = odometry;
  const Timestamp stamp = odometry + static_cast<Timestamp>(ahead_ * 1e6);
  if (told_ && stamp <= *told_ && *told_ - stamp < kClockWasSet) return;
  tell(stamp);
}

void MapTransform::correct(const Pose2& odomInMap) {
  const std::lock_guard lock(mutex_);
  const bool isSame = odomInMap_ && odomInMap_->x == odomInMap.x && odomInMap_->y == odomInMap.y &&
                      odomInMap_->theta == odomInMap.theta;
  if (isSame) return;
  odomInMap_ = odomInMap;
  if (!followed_) return;
  const Timestamp stamp = *followed_ + static_cast<Timestamp>(ahead_ * 1e6);
  const bool isRepeated = told_ && stamp <= *told_ && *told_ - stamp < kClockWasSet;
  tell(isRepeated ? *told_ + 1 : stamp);
}

bool MapTransform::isKnown() const {
  const std::lock_guard lock(mutex_);
  return odomInMap_.has_value();
}

}  // namespace ortung::ros2
