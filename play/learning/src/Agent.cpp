#include "Agent.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung::learning {
namespace {

constexpr Timestamp kTrueSights = 40'000;  ///< period of looks at the true ball [us]
constexpr double kNearPosition = 0.2;      ///< standard deviation of its start pose [m]
constexpr double kNearHeading = 0.09;      ///< standard deviation of its start heading [rad]

}  // namespace

Agent::Agent(const Settings& settings, bool kicks, double speed, const SimRobot& robot)
    : settings_(settings), kicks_(kicks), speed_(speed), robot_(robot) {}

void Agent::begin(PlayerSeat& seat) {
  seat_ = &seat;
  if (settings_.sight != Sight::kTruth) {
    const auto feature = [&](std::string_view name) {
      const SensorData* data = seat.container().find({.feature = name});
      return data != nullptr && isOf(*data, formats::kObjects) ? data : nullptr;
    };
    ball_ = feature("ball");
    others_ = feature("robots");
    if (ball_ == nullptr) throw std::runtime_error("its robot has no feature 'ball'");
  }
  if (settings_.sight != Sight::kLocalized) return;
  if (settings_.startsAnywhere)
    self_.emplace(seat);
  else
    self_.emplace(seat, robot_.state().pose, kNearPosition, kNearHeading);
}

void Agent::setAction(std::span<const float> action) {
  for (std::size_t i = 0; i < action.size(); ++i) action_[i] = std::clamp(action[i], -1.0f, 1.0f);
  hasNewAction_ = true;
}

bool Agent::senseAndAct(PlayerSeat& seat) {
  if (!hasNewAction_) return true;
  hasNewAction_ = false;
  seat.robot().setTranslationalVelocity(speed_ * static_cast<double>(action_[0]));
  seat.robot().setRotationalVelocity(kTurnSpeed * static_cast<double>(action_[1]));
  if (kicks_ && action_[2] > 0.0f) seat.robot().setManipulator("kicker", "kick");
  return true;
}

/// Sights and observations ask for the same time.
const std::optional<PoseEstimate>& Agent::beliefAt(Timestamp stamp) {
  if (!believed_ || believed_->stamp != stamp)
    believed_.emplace(Believed{stamp, self_->estimate(stamp)});
  return believed_->estimate;
}

/// Returns its pose as it believes it.
Pose2 Agent::poseAt(Timestamp stamp) {
  if (!self_) return robot_.state().pose;
  const auto& estimate = beliefAt(stamp);
  return estimate ? estimate->pose : Pose2{};
}

void Agent::see(Timestamp stamp, double x, double y) {
  std::move_backward(sights_.begin(), sights_.end() - 1, sights_.end());
  sights_.front() = Seen{stamp, x - kGoalLine, y};
}

void Agent::look(Timestamp now) {
  if (self_) {
    self_->update(*seat_);
    believed_.reset();
  }
  lookForBall(now);
  lookForOther(now);
}

void Agent::lookForBall(Timestamp now) {
  if (settings_.sight == Sight::kTruth) {
    if (sights_.front() && now - sights_.front()->stamp < kTrueSights) return;
    for (const StagedThing& thing : seat_->stage()->things())
      if (thing.kind == "ball") return see(now, thing.pose.x, thing.pose.y);
    return;
  }
  if (ball_->sequence() == ballSequence_) return;
  ballSequence_ = ball_->sequence();
  const auto reading = *readingAs<ObjectsData>(*ball_);
  if (reading.empty()) return;
  const Pose2 eye = poseAt(ball_->stamp()) * ball_->mount();
  const double angle = eye.theta + reading.front().bearing;
  see(ball_->stamp(), eye.x + reading.front().range * std::cos(angle),
      eye.y + reading.front().range * std::sin(angle));
}

void Agent::lookForOther(Timestamp now) {
  if (settings_.sight == Sight::kTruth) {
    for (const StagedRobot& robot : seat_->stage()->robots())
      if (robot.name != seat_->name()) other_ = Seen{now, robot.pose.x - kGoalLine, robot.pose.y};
    return;
  }
  if (others_ == nullptr || others_->sequence() == othersSequence_) return;
  othersSequence_ = others_->sequence();
  const auto reading = *readingAs<ObjectsData>(*others_);
  if (reading.empty()) return;
  const Pose2 eye = poseAt(others_->stamp()) * others_->mount();
  const double angle = eye.theta + reading.front().bearing;
  other_ = Seen{others_->stamp(), eye.x + reading.front().range * std::cos(angle) - kGoalLine,
                eye.y + reading.front().range * std::sin(angle)};
}

void Agent::write(const std::optional<Seen>& seen, Timestamp now, ObservationWriter& out) {
  out.add(seen ? seen->x : 0.0, kFar);
  out.add(seen ? seen->y : 0.0, kFar);
  out.add(seen ? toSeconds(now - seen->stamp) : static_cast<double>(kOld), kOld);
}

void Agent::observe(Timestamp now, double timeLeft, std::span<float> out) {
  ObservationWriter writer(out);
  const auto estimate = self_ ? beliefAt(now) : std::nullopt;
  const Pose2 pose = estimate ? estimate->pose : self_ ? Pose2{} : robot_.state().pose;
  const RobotState& state = robot_.state();
  writer.add(pose.x - kGoalLine, kFar);
  writer.add(pose.y, kFar);
  writer.add(std::cos(pose.theta), 1.0f);
  writer.add(std::sin(pose.theta), 1.0f);
  writer.add(state.translationalVelocity, kFast);
  writer.add(state.lateralVelocity, kFast);
  writer.add(state.rotationalVelocity, kFast);
  writer.add(std::max(timeLeft, 0.0), 120.0f);
  for (const auto& sight : sights_) write(sight, now, writer);
  write(other_, now, writer);
  if (writer.size() == out.size()) return;
  const bool isThere = estimate.has_value();
  const auto sigma = [&](std::size_t i) {
    return std::sqrt(std::max(estimate->covariance[i], 0.0));
  };
  writer.add(isThere ? std::hypot(sigma(0), sigma(4)) : kFar, kFar);
  writer.add(isThere ? sigma(8) : kFar, kFar);
  writer.add(isThere && estimate->status == TrackStatus::kTracking ? 1.0 : 0.0, 1.0f);
}

}  // namespace ortung::learning
