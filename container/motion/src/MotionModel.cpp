#include "ortung/motion/MotionModel.hpp"

#include <stdexcept>

namespace ortung {
namespace {

/// Length of odometry that is kept [s]: twice the greatest age of readings.
constexpr double kKept = 6.0;

}  // namespace

MotionModel::MotionModel() : track_(kKept) {}
MotionModel::~MotionModel() = default;

void MotionModel::follow(Timestamp stamp, const OdometryView& reading) {
  track_.add(stamp, reading.pose, reading.translationalVelocity, reading.rotationalVelocity,
             reading.lateralVelocity);
}

std::optional<Pose2> MotionModel::odometryAt(Timestamp stamp) const {
  return track_.at(stamp - fromSeconds(delay_));
}

void MotionModel::forget() { track_.clear(); }

void MotionModel::learnMotion(const Pose2&, const Pose2&) {}
void MotionModel::endDrive() {}
double MotionModel::endLearning() {
  throw std::runtime_error("this motion model has nothing to learn");
}
Parameters MotionModel::settings() const { return Parameters("motion model"); }

}  // namespace ortung
