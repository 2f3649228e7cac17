#include "ortung/mcl_player/SelfLocalization.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "ortung/mcl/MclConfig.hpp"
#include "ortung/run/Robot.hpp"

namespace ortung {
namespace {

void checkTaught(PlayerSeat& seat) {
  const std::string who = "robot " + seat.name() + " can't localize itself: ";
  const auto& features = seat.container().all();
  if (std::none_of(features.begin(), features.end(),
                   [](const auto& data) { return data->localizes(); }))
    throw std::runtime_error(who + "it has no feature that localizes");
  if (!seat.taught().region)
    throw std::runtime_error(who +
                             "it has no tables for this world (tables=FILE in the simulator, "
                             "--tables FILE of ortung play)");
}

MclConfig readConfig(PlayerSeat& seat) {
  MclConfig config = MclConfig::read(seat.taught().mcl);
  const std::uint64_t high = seat.random().next();
  config.seed = (high << 32) | seat.random().next();
  config.threads = 1;  // there may be many players
  return config;
}

/// Makes the motion model by a plugin. Plugins are searched only once per thread, since a player
/// may live for a few seconds only.
std::unique_ptr<MotionModel> makeMotion(const Parameters& motion) {
  thread_local PluginFactory factory(PluginFactory::standardFolders());
  return ortung::makeMotion(motion, factory);
}

std::unique_ptr<Mcl> makeMcl(PlayerSeat& seat) {
  checkTaught(seat);
  return std::make_unique<Mcl>(readConfig(seat), *seat.taught().region,
                               makeMotion(seat.taught().motion));
}

}  // namespace

SelfLocalization::SelfLocalization(PlayerSeat& seat) : mcl_(makeMcl(seat)) { mcl_->startGlobal(); }

SelfLocalization::SelfLocalization(PlayerSeat& seat, const Pose2& truth, double sigmaPosition,
                                   double sigmaHeading)
    : mcl_(makeMcl(seat)) {
  startNear(truth, sigmaPosition, sigmaHeading, seat.random());
}

SelfLocalization::~SelfLocalization() = default;

void SelfLocalization::startGlobal() { mcl_->startGlobal(); }

void SelfLocalization::startAt(const Pose2& pose, double sigmaPosition, double sigmaHeading) {
  mcl_->startAt(pose, sigmaPosition, sigmaHeading);
}

void SelfLocalization::startNear(const Pose2& truth, double sigmaPosition, double sigmaHeading,
                                 Random& random) {
  Pose2 told = truth;
  told.x += sigmaPosition * random.gaussian();
  told.y += sigmaPosition * random.gaussian();
  told.theta = wrapAngle(truth.theta + sigmaHeading * random.gaussian());
  startAt(told, sigmaPosition, sigmaHeading);
}

void SelfLocalization::setPose(const Pose2& pose, const PoseCovariance& covariance) {
  mcl_->setPose(pose, covariance);
}

bool SelfLocalization::update(PlayerSeat& seat) { return mcl_->update(seat.container()); }

}  // namespace ortung
