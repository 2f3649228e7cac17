#include "NeuralSettings.hpp"
#include "ortung/core/Plugin.hpp"
#include "ortung/formats/Words.hpp"
#include "ortung/motion/MotionMoments.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung {
namespace {

constexpr double kKept = 6.0;          ///< how much of the past is kept [s]
constexpr double kLongestPause = 2.0;  ///< longest gap between commands that is bridged [s]

/// Returns the keys of [motion] that the network does not read.
Parameters withoutNetwork(const Parameters& motion) {
  Parameters rest(motion.where());
  for (const std::string& key : motion.keys()) {
    if (key != "network_file" && key != "plugin") rest.set(key, motion.number(key));
  }
  return rest;
}

/// Odometry by a network, which predicts how the base executes commands. Commands come with
/// odometry's readings; the noise is that of the odometry model.
class NeuralMotion final : public OdometryMotion, public MotionMoments {
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
    // A command holds until the next one, so the previous one holds up to this one's time.
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

  std::optional<MotionChange> moments(const Pose2& odometryChange) const override {
    return expectedChange(noise(), correction(), odometryChange);
  }

 private:
  /// Restarts the prediction. The pose continues from its last value, so that samples do not jump.
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
  Velocities command_;      ///< newest command
  Velocities stepCommand_;  ///< command that holds at now_, as in the network's training
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("neural_motion",
               ortung::provide<ortung::MotionModel, ortung::NeuralMotion>("neural"));
