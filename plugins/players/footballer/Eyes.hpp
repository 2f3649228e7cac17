#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include "TeamTalk.hpp"
#include "View.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung::football {

/// Makes a view of what a player senses and is told.
class Eyes {
 public:
  /// Where the robot believes to be; nothing: it does not know.
  using Pose = std::function<std::optional<Pose2>(PlayerSeat&)>;

  /// @param pose empty: everything is taken from the stage @param braking of a ball [m/s^2]
  Eyes(Pose pose, double braking)
      : pose_(std::move(pose)), braking_(braking), track_(braking, 0.2) {}

  /// Nothing as long as its own pose is not known.
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
  /// The ball as it has seen it itself, lately.
  const std::optional<RollingBall>& ownBall() const { return own_; }

 private:
  static constexpr Timestamp kForgotten = 1'200'000;  ///< a ball that nobody sees [us]
  static constexpr double kSame = 0.7;  ///< a robot so near to where a mate says he is, is he [m]

  static constexpr double kFar = 0.8;            ///< from where it was expected [m]
  static constexpr double kFastest = 3.0;        ///< it is kicked meanwhile [m/s]
  static constexpr double kSeems = 0.1;          ///< to move [m/s]
  static constexpr double kSeemsPerMetre = 0.1;  ///< [1/s]

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
      // From far it seems to move when it lies.
      if (own_->speed() < kSeems + kSeemsPerMetre * lengthOf(own_->at - view.place()))
        own_->speedX = own_->speedY = 0.0;
    }
    view.ball = own_;
  }
  /// Whether it may be the ball that it has seen before; elsewhere only if it is there twice.
  bool isLikely(const FloorPoint& at) {
    const double passed = toSeconds(newest_ - track_.lastSeen());
    const bool isNear =
        !track_.ball() || lengthOf(track_.ball()->later(passed) - at) < kFar + kFastest * passed;
    const bool isThereAgain = elsewhere_ && lengthOf(*elsewhere_ - at) < kFar;
    elsewhere_ = at;
    return isNear || isThereAgain;
  }
  /// Mates tell where they are, and the ball for who does not see it.
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
        mate->at = at;  // newer than what he said
      } else {
        view.others.push_back({at, {}, std::max(object.radius, 0.2), false, false});
      }
    }
  }

  Pose pose_;
  double braking_;
  BallTrack track_;
  Timestamp newest_ = -1;
  std::optional<FloorPoint> elsewhere_;  ///< where it was seen last, likely or not
  std::optional<RollingBall> own_;
};

}  // namespace ortung::football
