#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ortung/sim/SimWorld.hpp"
#include "ortung/sim_api/Stage.hpp"

namespace ortung::test {

/// What stands on the field of a world file, and robots and balls that are told where they are.
class StageWorld final : public World {
 public:
  explicit StageWorld(const std::filesystem::path& file);

  void castFan(const RayFan& fan, RobotNumber ignore, std::span<float> ranges) const override {
    field_->castFan(fan, ignore, ranges);
  }
  bool isVisible(double x0, double y0, double z0, double x1, double y1, double z1,
                 RobotNumber ignore, double slack) const override {
    return field_->isVisible(x0, y0, z0, x1, y1, z1, ignore, slack);
  }
  std::span<const Landmark> landmarks() const override { return field_->landmarks(); }
  std::span<const FieldLine> lines() const override { return field_->lines(); }
  std::span<const WorldObject> objects() const override { return objects_; }
  bool isFree(double x, double y, const RobotSize& size) const override {
    return field_->isFree(x, y, size);
  }

  /// Outlines of what stands on the field, low enough for a ball to meet it.
  const std::vector<std::vector<FloorPoint>>& obstacles() const { return obstacles_; }
  /// Replaces all that moves: round bodies.
  void show(std::span<const StagedRobot> robots, std::span<const StagedThing> things,
            double ballRadius);

 private:
  std::unique_ptr<SimWorld> field_;
  std::vector<WorldObject> objects_;
  std::size_t fixed_ = 0;
  std::vector<std::vector<FloorPoint>> obstacles_;
};

/// A stage without a physics engine: robots go straight as they are told, balls roll, slow down and
/// bounce off robots, goals, posts and walls. Enough for a referee.
class FakeStage final : public Stage {
 public:
  static constexpr double kBallRadius = 0.11;   // [m]
  static constexpr double kRestitution = 0.5;   // of a ball that bounces
  static constexpr double kDeceleration = 0.3;  // of a ball that rolls [m/s^2]

  FakeStage(const std::filesystem::path& world, double cycle);

  Timestamp now() const override { return now_; }
  double cycle() const override { return cycle_; }
  const World& world() const override { return world_; }
  std::span<const StagedRobot> robots() const override { return robots_; }
  std::span<const StagedThing> things() const override { return things_; }
  void placeRobot(std::string_view robot, const Pose2& pose) override;
  void placeThing(std::string_view thing, const Pose2& pose, const Twist& velocity) override;
  std::shared_ptr<const FloorPlan> floorPlan(const RobotSize& size) override;

  /// Whatever is in the way: scenarios put things where they like.
  void set(const StagedRobot& robot);
  void set(const StagedThing& thing);
  void remove(std::string_view robot);
  StagedRobot* find(std::string_view robot);
  StagedThing* ball() { return things_.empty() ? nullptr : &things_.front(); }
  /// The next cycle. @param isHeld which robots do not move
  template <class Held>
  void step(const Held& isHeld) {
    std::vector<bool> held;
    for (const StagedRobot& robot : robots_) held.push_back(isHeld(robot.name));
    move(held);
  }

 private:
  void move(const std::vector<bool>& held);
  void moveBall(StagedThing& ball, double dt, const std::vector<bool>& held) const;
  void checkRoom(std::string_view self, double x, double y, double radius) const;
  void show() { world_.show(robots_, things_, kBallRadius); }

  StageWorld world_;
  double cycle_;
  Timestamp now_ = 0;
  std::vector<StagedRobot> robots_;
  std::vector<StagedThing> things_;
};

}  // namespace ortung::test
