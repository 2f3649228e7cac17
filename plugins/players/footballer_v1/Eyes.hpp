#pragma once

// FROZEN, a part of the team footballer-v1: docs/matches.md tells why. Never changed; improvements
// are made in the players of today.

#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include "TeamTalk.hpp"
#include "View.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung::football_v1 {

/// Makes a player's view from its sensors and its mates' messages.
class Eyes {
 public:
  /// Returns the pose that the robot believes to have; nothing: it does not know.
  using Pose = std::function<std::optional<Pose2>(PlayerSeat&)>;

  /// @param pose empty: everything is taken from the stage
  /// @param braking deceleration of a ball [m/s^2]
  Eyes(Pose pose, double braking)
      : pose_(std::move(pose)), braking_(braking), track_(braking, 0.2) {}

  /// Returns the view; nothing as long as its own pose is not known.
  std::optional<View> look(PlayerSeat& seat, const Mates& mates) {
    View view;
    view.now = seat.now();
    view.radius = seat.abilities().radius;
    if (!pose_) {
      lookAtStage(seat, mates, view);
      return view;
    }
    const auto pose = pose_(seat);
    if (!pose) return std::nullopt;
    view.pose = *pose;
    seeBall(seat, view);
    const std::optional<RollingBall> own = view.ball;
    hear(mates, view);
    seeRobots(seat, view);
    if (own) view.ball = own;
    return view;
  }
  /// Returns the ball if it has seen it itself recently.
  const std::optional<RollingBall>& ownBall() const { return own_; }

 private:
  /// Age from which a sighting of the ball is forgotten [us].
  static constexpr Timestamp kForgotten = 1'200'000;
  /// A robot this near to a mate's reported place is that mate [m].
  static constexpr double kSame = 0.7;

  /// Distance from the expected place beyond which a ball is elsewhere [m].
  static constexpr double kFar = 0.8;
  /// Speed at which the ball may have been kicked meanwhile [m/s].
  static constexpr double kFastest = 3.0;
  static constexpr double kSeems = 0.1;          ///< apparent speed of a lying ball [m/s]
  static constexpr double kSeemsPerMetre = 0.1;  ///< growth of that speed with distance [1/s]

  static RollingBall later(const RollingBall& ball, double seconds) {
    RollingBall now = ball;
    const double v = ball.speed();
    const double share = v > 0.0 ? std::max(0.0, 1.0 - ball.braking * seconds / v) : 0.0;
    now.at = ball.later(seconds);
    now.speedX *= share;
    now.speedY *= share;
    return now;
  }

  void lookAtStage(PlayerSeat& seat, const Mates& mates, View& view) {
    for (const StagedRobot& robot : seat.stage()->robots()) {
      if (robot.name == seat.name()) {
        view.pose = robot.pose;
        continue;
      }
      const bool isMate = !seat.team().empty() && robot.team == seat.team();
      view.others.push_back({placeOf(robot.pose),
                             {robot.velocity.x, robot.velocity.y},
                             robot.radius,
                             isMate,
                             isMate && !mates.told().contains(robot.name)});
    }
    for (const StagedThing& thing : seat.stage()->things())
      if (thing.kind == "ball")
        view.ball = RollingBall{placeOf(thing.pose), thing.velocity.x, thing.velocity.y, braking_};
    own_ = view.ball;
  }

  /// The feature if it has a reading, and that.
  static std::pair<const SensorData*, ObjectsData::Reading> find(PlayerSeat& seat,
                                                                 const char* feature) {
    const SensorData* seen = seat.container().find({.feature = feature});
    auto objects = seen == nullptr ? std::nullopt : readingAs<ObjectsData>(*seen);
    if (!objects) return {};
    return {seen, *std::move(objects)};
  }
  static FloorPoint placeOfObject(const Pose2& eye, const ObjectsData::Object& object) {
    return placeOf(eye) + object.range * towards(eye.theta + object.bearing);
  }

  void seeBall(PlayerSeat& seat, View& view) {
    const SensorContainer::ReadLock lock = seat.container().read();
    if (seat.container().find({.feature = "ball"}) == nullptr)
      throw std::runtime_error("its robot has no sensor with a feature 'ball'");
    const auto [seen, balls] = find(seat, "ball");
    if (seen != nullptr && seen->stamp() > newest_ && !balls.empty()) {
      newest_ = seen->stamp();
      // What is imagined comes last, but it may be all that there is.
      const FloorPoint at = placeOfObject(view.pose * seen->mount(), balls.front());
      if (isLikely(at)) track_.see(newest_, at);
    }
    own_.reset();
    if (track_.ball() && view.now - track_.lastSeen() < kForgotten) {
      own_ = later(*track_.ball(), toSeconds(view.now - track_.lastSeen()));
      // A distant ball that lies still seems to move.
      if (own_->speed() < kSeems + kSeemsPerMetre * lengthOf(own_->at - view.place()))
        own_->speedX = own_->speedY = 0.0;
    }
    view.ball = own_;
  }
  /// Returns whether a sighting may be the ball seen before; elsewhere it must be seen twice.
  bool isLikely(const FloorPoint& at) {
    const double passed = toSeconds(newest_ - track_.lastSeen());
    const bool isNear =
        !track_.ball() || lengthOf(track_.ball()->later(passed) - at) < kFar + kFastest * passed;
    const bool isThereAgain = elsewhere_ && lengthOf(*elsewhere_ - at) < kFar;
    elsewhere_ = at;
    return isNear || isThereAgain;
  }
  /// Adds mates at their reported places, and the ball that they report if it is not seen.
  static void hear(const Mates& mates, View& view) {
    Timestamp newest = 0;
    for (const auto& [name, told] : mates.told()) {
      view.others.push_back({told.word.at, {}, view.radius, true, false});
      if (!told.word.ball || told.stamp < newest) continue;
      newest = told.stamp;
      view.ball = later(*told.word.ball, std::max(toSeconds(view.now - told.stamp), 0.0));
    }
  }
  static void seeRobots(PlayerSeat& seat, View& view) {
    const SensorContainer::ReadLock lock = seat.container().read();
    const auto [seen, robots] = find(seat, "robots");
    if (seen == nullptr) return;
    const Pose2 eye = view.pose * seen->mount();
    const std::size_t mates = view.others.size();
    for (const ObjectsData::Object& object : robots) {
      const FloorPoint at = placeOfObject(eye, object);
      const auto end = view.others.begin() + static_cast<std::ptrdiff_t>(mates);
      const auto mate = std::find_if(view.others.begin(), end, [&](const Other& other) {
        return lengthOf(other.at - at) < kSame;
      });
      if (mate != end) {
        mate->at = at;  // newer than its message
      } else {
        view.others.push_back({at, {}, std::max(object.radius, 0.2), false, false});
      }
    }
  }

  Pose pose_;
  double braking_;
  BallTrack track_;
  Timestamp newest_ = -1;
  std::optional<FloorPoint> elsewhere_;  ///< last sighting, whether it was likely or not
  std::optional<RollingBall> own_;
};

}  // namespace ortung::football_v1
