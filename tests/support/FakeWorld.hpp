#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ortung/sim/SimWorld.hpp"

namespace ortung {

/// A rectangular room around the origin with round posts in it, all of endless height. Everything
/// is answered in closed form.
class FakeWorld : public SimWorld {
 public:
  struct Post {
    double x = 0.0;       ///< [m]
    double y = 0.0;       ///< [m]
    double radius = 0.1;  ///< [m]
  };

  FakeWorld(double width, double height) : halfWidth_(width / 2.0), halfHeight_(height / 2.0) {}

  void addPost(const Post& post) { posts_.push_back(post); }
  /// A robot, which its own rays ignore.
  RobotNumber addRound(double radius, double x, double y) {
    robots_[++lastRobot_] = {x, y, radius};
    return lastRobot_;
  }
  void addLandmark(const Landmark& landmark) { landmarks_.push_back(landmark); }
  void addLine(const FieldLine& line) { lines_.push_back(line); }
  /// Something to be recognised; a body that rays hit it has only with addPost() or addRound().
  /// Without pieces it gets one of its extent, as what stands in a simulator's world has.
  void addObject(const WorldObject& object) {
    objects_.push_back(object);
    if (!object.pieces.empty()) return;
    WorldPiece& piece = objects_.back().pieces.emplace_back();
    piece.shape = object.isRound ? WorldPiece::Shape::kEllipse : WorldPiece::Shape::kRectangle;
    piece.halfX = object.halfX;
    piece.halfY = object.halfY;
    piece.zLow = object.zLow;
    piece.zHigh = object.zHigh;
  }

  /// A wall that is known; rays meet those of the room alone.
  void addWall(double x, double y, double halfX, double halfY) {
    WorldObject wall;
    wall.kind = "wall";
    wall.pose = {x, y, 0};
    wall.halfX = halfX;
    wall.halfY = halfY;
    wall.zHigh = 1.0;
    addObject(wall);
  }
  /// Makes all four walls of the room known, 0.1 m thick.
  void addWallsOfRoom() {
    for (const double side : {1.0, -1.0}) {
      addWall(side * (halfWidth_ + 0.05), 0.0, 0.05, halfHeight_ + 0.1);
      addWall(0.0, side * (halfHeight_ + 0.05), halfWidth_ + 0.1, 0.05);
    }
  }

  /// Range along one horizontal ray [m], infinite in no direction of a room.
  double range(double x, double y, double angle) const {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    double nearest = std::numeric_limits<double>::infinity();
    if (c != 0.0) nearest = std::min(nearest, ((c > 0.0 ? halfWidth_ : -halfWidth_) - x) / c);
    if (s != 0.0) nearest = std::min(nearest, ((s > 0.0 ? halfHeight_ : -halfHeight_) - y) / s);
    for (const Post& post : posts_) nearest = std::min(nearest, rangeOf(post, x, y, c, s));
    for (const auto& [number, robot] : robots_)
      if (number != ignored_) nearest = std::min(nearest, rangeOf(robot, x, y, c, s));
    return nearest;
  }

  void castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const override {
    ignored_ = ignore;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double angle = fan.firstAngle + static_cast<double>(i) * fan.angleStep;
      const double way = range(fan.x, fan.y, angle) / std::cos(fan.elevation);
      ranges[i] = static_cast<float>(std::min(way, fan.maxRange));
    }
    ignored_ = 0;
    rays_ += ranges.size();
  }

  bool isVisible(double x0, double y0, double, double x1, double y1, double, RobotNumber ignore,
                 double slack) const override {
    const double way = std::hypot(x1 - x0, y1 - y0);
    ignored_ = ignore;
    const bool isSeen = range(x0, y0, std::atan2(y1 - y0, x1 - x0)) >= way - slack;
    ignored_ = 0;
    return isSeen;
  }

  std::span<const Landmark> landmarks() const override { return landmarks_; }
  std::span<const FieldLine> lines() const override { return lines_; }
  std::span<const WorldObject> objects() const override { return objects_; }

  bool isFree(double x, double y, const RobotSize& size) const override {
    const double radius = size.radius;
    const bool isInside = std::abs(x) + radius <= halfWidth_ && std::abs(y) + radius <= halfHeight_;
    return isInside && std::none_of(posts_.begin(), posts_.end(), [&](const Post& post) {
             return std::hypot(x - post.x, y - post.y) < post.radius + radius;
           });
  }

  const std::string& name() const override { return name_; }
  const PhysicsConfig& physics() const override { return physics_; }
  std::string fingerprint() const override { return "0123456789abcdef"; }

  FieldRegion region(double cell, const RobotSize& robot) const override {
    FieldRegion region;
    region.grid = {-halfWidth_, -halfHeight_, cell,
                   static_cast<int>(std::lround(std::ceil(2.0 * halfWidth_ / cell - 1e-9))),
                   static_cast<int>(std::lround(std::ceil(2.0 * halfHeight_ / cell - 1e-9)))};
    for (std::size_t i = 0; i < region.grid.size(); ++i) {
      const double x = region.grid.centreX(i);
      const double y = region.grid.centreY(i);
      region.open.push_back(isFree(x, y, {0.0}) ? 1 : 0);
      region.standable.push_back(isFree(x, y, robot) ? 1 : 0);
    }
    return region;
  }

  RobotNumber addBody(const MovingBody& body, const Pose2& pose) override {
    const RobotNumber number = ++lastRobot_;
    double reach = 0.0;
    for (const Primitive& piece : body.pieces) reach = std::max(reach, reachOf(piece));
    robots_[number] = {pose.x, pose.y, reach};
    return number;
  }
  void moveBody(RobotNumber body, const Pose2& pose, const Twist&) override {
    robots_.at(body).x = pose.x;
    robots_.at(body).y = pose.y;
  }
  void reshapeBody(RobotNumber, std::span<const Primitive>) override {}
  void removeBody(RobotNumber body) override { robots_.erase(body); }

  std::unique_ptr<SimWorld> another() const override { return std::make_unique<FakeWorld>(*this); }
  Solids solids() const override {
    Solids solids;
    solids.bounds = {-halfWidth_, halfWidth_, -halfHeight_, halfHeight_};
    for (const Post& post : posts_) {
      Primitive circle;
      circle.shape = Primitive::Shape::kEllipse;
      circle.centre = {post.x, post.y};
      circle.halfX = circle.halfY = post.radius;
      solids.primitives.push_back(circle);
    }
    return solids;
  }

  std::size_t rays() const { return rays_; }  ///< cast so far

 private:
  static double rangeOf(const Post& post, double x, double y, double c, double s) {
    const double dx = post.x - x;
    const double dy = post.y - y;
    const double along = dx * c + dy * s;
    const double across = dx * s - dy * c;
    const double inside = post.radius * post.radius - across * across;
    if (inside < 0.0 || along < 0.0) return std::numeric_limits<double>::infinity();
    return std::max(along - std::sqrt(inside), 0.0);
  }

  double halfWidth_;   ///< [m]
  double halfHeight_;  ///< [m]
  std::vector<Post> posts_;
  std::vector<Landmark> landmarks_;
  std::vector<FieldLine> lines_;
  std::vector<WorldObject> objects_;
  std::map<RobotNumber, Post> robots_;
  RobotNumber lastRobot_ = 0;
  std::string name_ = "room";
  PhysicsConfig physics_;
  mutable RobotNumber ignored_ = 0;
  mutable std::size_t rays_ = 0;
};

}  // namespace ortung
