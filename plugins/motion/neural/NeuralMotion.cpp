#include "NeuralSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

constexpr double kKept = 6.0;          ///< of the past [s]
constexpr double kLongestPause = 2.0;  ///< of commands that is bridged [s]

/// What is left of [motion] when the network has read its part.
Parameters withoutNetwork(const Parameters& motion) {
  Parameters rest(motion.where());
  for (const std::string& key : motion.keys()) {
    if (key != "network_file" && key != "plugin") rest.set(key, motion.number(key));
  }
  return rest;
}

/// Odometry by a network: not what the robot was told to do, but what it has learned that the base
/// makes of it. Commands come with odometry's readings; noise is that of the odometry model.
class NeuralMotion : public OdometryMotion {
 public:
  explicit NeuralMotion(const Parameters& motion)
      : OdometryMotion(withoutNetwork(motion)),
        network_(readNetworkOf(motion)),
        robot_(network_),
        track_(kKept) {
    motion.textOr("plugin", "");
  }

  void follow(Timestamp stamp, const OdometryView& reading) override {
    const Timestamp step = fromSeconds(network_.step);
    if (track_.empty() || stamp < now_ - step || toSeconds(stamp - now_) > kLongestPause)
      restart(stamp);
    // A command is in force until the next one, so up to this one's time it is the one before.
    while (now_ + step <= stamp) {
      pose_ = pose_ * robot_.step(stepCommand_);
      now_ += step;
      stepCommand_ = command_;
      track_.add(now_, pose_, robot_.velocity().translational, robot_.velocity().rotational);
    }
    command_ = commandOf(reading);
    if (stamp == now_) stepCommand_ = command_;
  }

  std::optional<Pose2> odometryAt(Timestamp stamp) const override {
    return track_.at(stamp - fromSeconds(delay()));
  }

  void forget() override { track_.clear(); }

 private:
  /// The pose goes on from where it was, so that samples do not jump.
  void restart(Timestamp stamp) {
    track_.clear();
    robot_.reset();
    command_ = stepCommand_ = {};
    now_ = stamp;
    track_.add(now_, pose_, 0.0, 0.0);
  }

  Velocities commandOf(const OdometryView& reading) const {
    if (network_.fromVelocities) return {reading.translationalVelocity, reading.rotationalVelocity};
    const std::size_t n = reading.motionData.size();
    if (n < 2) return {};
    return {words::toSignedMetres(reading.motionData[n - 2]),
            words::toRate(reading.motionData[n - 1])};
  }

  const MotionNetwork network_;
  NeuralRobot robot_;
  OdometryTrack track_;
  Timestamp now_ = 0;
  Pose2 pose_;
  Velocities command_;      ///< newest
  Velocities stepCommand_;  ///< in force at now_, as the network was trained
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("neural_motion",
               ortung::provide<ortung::MotionModel, ortung::NeuralMotion>("neural"));
