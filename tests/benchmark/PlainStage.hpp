#pragma once

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "FakeWorld.hpp"
#include "SeatOnStage.hpp"
#include "ortung/sim_api/Stage.hpp"

namespace ortung::test {

/// What a player has done, as text to a millionth: the last bits of sines may differ between
/// computers.
struct Notes : RobotCommands {
  std::string text;
  void note(const char* what, double value) {
    char line[64];
    std::snprintf(line, sizeof line, "%s %.6f\n", what, value + 0.0);
    text += line;
  }
  void setTranslationalVelocity(double v) override { note("v", v); }
  void setRotationalVelocity(double w) override { note("w", w); }
  void setMotion(std::span<const double> numbers) override {
    for (const double number : numbers) note("m", number);
  }
  void setManipulator(std::string_view manipulator, std::string_view state) override {
    text += std::string(manipulator) + " " + std::string(state) + "\n";
  }
};

/// A stage without physics: a striker, a keeper and a ball, which move as a test says.
struct PlainStage : Stage {
  Notes* notes = nullptr;
  Timestamp time = 0;
  FakeWorld field{14.0, 10.0};
  std::vector<StagedRobot> all = {{"me", "yellow", {3.0, 0.0, 3.0}, {}, 0.36},
                                  {"keeper", "blue", {-5.5, 0.0, 1.5}, {}, 0.32}};
  std::vector<StagedThing> balls = {{"ball", "ball", {}, {}}};

  Timestamp now() const override { return time; }
  double cycle() const override { return 0.02; }
  const World& world() const override { return field; }
  std::span<const StagedRobot> robots() const override { return all; }
  std::span<const StagedThing> things() const override { return balls; }
  void placeRobot(std::string_view, const Pose2& pose) override {
    all[0].pose = pose;
    notes->note("x", pose.x), notes->note("y", pose.y), notes->note("theta", pose.theta);
  }
  void placeThing(std::string_view, const Pose2& pose, const Twist& velocity) override {
    balls[0].pose = pose;
    notes->note("ball x", pose.x), notes->note("ball y", pose.y);
    notes->note("ball v", std::hypot(velocity.x, velocity.y));
  }
  std::shared_ptr<const FloorPlan> floorPlan(const RobotSize&) override { return nullptr; }
};

/// A striker's seat on it, between goals at both ends of x.
struct Play {
  explicit Play(std::uint64_t seed) : seat(stands, notes, seed) {
    stands.notes = &notes;
    seat.known.landmarks = {{1, "goal", -6.0, 0.0, 0.5}, {2, "goal", 6.0, 0.0, 0.5}};
  }
  Play(const Play&) = delete;
  Play& operator=(const Play&) = delete;

  Notes notes;
  PlainStage stands;
  SeatOnStage seat;
};

}  // namespace ortung::test
