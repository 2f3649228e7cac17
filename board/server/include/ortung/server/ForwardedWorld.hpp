#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung {

/// Another served world as it is: for worlds that add something to it. Not thread-safe.
class ORTUNG_API ForwardedWorld : public ServedWorld {
 public:
  /// @param world borrowed
  explicit ForwardedWorld(ServedWorld& world) : world_(world) {}
  ~ForwardedWorld() override;

  WorldDescription describe() const override { return world_.describe(); }
  std::vector<std::string> plugins() const override { return world_.plugins(); }
  std::vector<std::string> players() const override { return world_.players(); }
  std::vector<std::string> robotKinds() const override { return world_.robotKinds(); }
  Timestamp now() const override { return world_.now(); }
  Timestamp livePeriod() const override { return world_.livePeriod(); }
  bool isReady() const override { return world_.isReady(); }
  bool isAtEnd() const override { return world_.isAtEnd(); }
  void step() override { world_.step(); }
  std::vector<std::string> field() const override { return world_.field(); }
  std::vector<ServedFeature> truthFeatures() const override { return world_.truthFeatures(); }
  std::span<Message> truth() override { return world_.truth(); }
  std::vector<Resident> residents() const override { return world_.residents(); }
  std::uint64_t residentsVersion() const override { return world_.residentsVersion(); }
  ServedRobot addRobot(RobotId robot, RobotWish wish) override {
    return world_.addRobot(robot, std::move(wish));
  }
  std::vector<std::string> abilities(RobotId robot) const override {
    return world_.abilities(robot);
  }
  void removeRobot(RobotId robot) override { world_.removeRobot(robot); }
  std::string side(RobotId robot) const override { return world_.side(robot); }
  void want(RobotId robot, std::span<const SensorId> features) override {
    world_.want(robot, features);
  }
  std::span<Message> readings(RobotId robot) override { return world_.readings(robot); }
  std::vector<Message> lateReadings(RobotId robot) override { return world_.lateReadings(robot); }
  RobotCommands& commands(RobotId robot) override { return world_.commands(robot); }
  void tell(RobotId robot, std::string_view text) override { world_.tell(robot, text); }
  std::vector<ServedTalk> takeHeard(RobotId robot) override { return world_.takeHeard(robot); }
  void seek(Timestamp stamp) override { world_.seek(stamp); }
  std::optional<std::uint64_t> seed() const override { return world_.seed(); }
  void reset(std::optional<std::uint64_t> seed) override { world_.reset(seed); }
  void placeRobot(RobotId robot, const Pose2& pose) override { world_.placeRobot(robot, pose); }
  void placeObject(const std::string& object, const Pose2& pose) override {
    world_.placeObject(object, pose);
  }

 protected:
  /// The world that is served, for derived classes.
  ServedWorld& world() const { return world_; }

 private:
  ServedWorld& world_;
};

}  // namespace ortung
