#pragma once

#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "ortung/server/PlainWorld.hpp"

namespace ortung::test {

/// A world without physics: each robot has a counter of cycles and an image of many words, and
/// remembers what it was told. Cycles take 10 ms, if nothing else is said.
class CountingWorld : public PlainWorld, private RobotCommands {
 public:
  explicit CountingWorld(std::size_t imageWords = 0) : imageWords_(imageWords) {}
  ~CountingWorld() override = default;

  WorldDescription describe() const override {
    return {"counting", "0123456789abcdef", "simulation"};
  }
  std::vector<std::string> plugins() const override { return {"odometry", "lrf"}; }
  Timestamp now() const override { return now_; }
  bool isAtEnd() const override { return lastCycle_ >= 0 && now_ / cycle >= lastCycle_; }
  void step() override {
    if (now_ / cycle == failingCycle_) throw std::runtime_error("the world broke");
    for (auto& [id, frame] : frames_) {
      frame = {{now_, counter_, {static_cast<std::uint32_t>(now_ / cycle), commands_}}};
      if (imageWords_ > 0)
        frame.push_back({now_, image_, std::vector<std::uint32_t>(imageWords_, 4'000'000'000u)});
    }
    now_ += cycle;
  }
  ServedRobot addRobot(RobotId robot, RobotWish wish) override {
    if (wish.name == "unwanted") throw ServeError("no-room", "there is no room");
    frames_[robot];
    return {{{counter_, "[cycle, commands]"}, {image_, "[pixels]"}}, raysPerSecond, raysAtOnce};
  }
  void removeRobot(RobotId robot) override { frames_.erase(robot); }
  std::span<Message> readings(RobotId robot) override { return frames_.at(robot); }
  RobotCommands& commands(RobotId) override { return *this; }
  std::vector<std::string> abilities(RobotId) const override {
    return {"drive nothing", "manipulator kicker rest kicking"};
  }
  void reset(std::optional<std::uint64_t>) override {
    now_ = 0;
    commands_ = 0;
    for (auto& [id, frame] : frames_) frame.clear();
  }
  void placeRobot(RobotId, const Pose2&) override { ++commands_; }
  void placeObject(const std::string&, const Pose2&) override {}

  Timestamp cycle = 10'000;    ///< [us]
  double raysPerSecond = 0.0;  ///< of every robot
  double raysAtOnce = 0.0;     ///< of every robot
  std::uint32_t commands() const { return commands_; }
  /// The last command vector.
  const std::vector<double>& motion() const { return motion_; }
  void endAt(std::int64_t last) { lastCycle_ = last; }
  void failAt(std::int64_t failing) { failingCycle_ = failing; }

 private:
  void setTranslationalVelocity(double) override { ++commands_; }
  void setRotationalVelocity(double) override { ++commands_; }
  void setMotion(std::span<const double> command) override {
    motion_.assign(command.begin(), command.end());
    ++commands_;
  }
  void setManipulator(std::string_view name, std::string_view) override {
    if (name != "kicker") throw std::invalid_argument("there is only a kicker");
    ++commands_;
  }

  const SensorId counter_{"counter", "counter", "cycle"};
  const SensorId image_{"camera", "camera", "image"};
  std::size_t imageWords_;
  std::int64_t lastCycle_ = -1;
  std::int64_t failingCycle_ = -1;
  Timestamp now_ = 0;
  std::uint32_t commands_ = 0;
  std::vector<double> motion_;
  std::map<RobotId, std::vector<Message>> frames_;
};

/// A robot file that the world above takes.
inline const std::string kAnyRobot = "[[sensor]]\nplugin = \"odometry\"\n";

}  // namespace ortung::test
