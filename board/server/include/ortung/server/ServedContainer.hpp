#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ortung/server/PlainWorld.hpp"

namespace ortung {

/// A running robot for the message board: its container, which others fill from any threads, and
/// its commands. Clients list the robot, read it and subscribe to it;
/// operators command it. There is one robot, number 1, and its time is its own: nothing can be
/// created, placed, paused or reset.
/// The board's thread looks into the container now and then, with the container's read lock held
/// for as long as copying takes. Otherwise not thread-safe: one thread owns it.
class ORTUNG_API ServedContainer : public PlainWorld {
 public:
  struct Config {
    std::string robot = "robot";  ///< its name: [A-Za-z0-9_-], 1 to 32 characters
    std::string fingerprint;      ///< digest of the robot's world; "": no world is known
    double period = 0.05;         ///< time between two looks into the container [s], in [0.001, 10]
    std::vector<std::string> abilities;  ///< lines of DESCRIBE, see ServedWorld::abilities()
    /// Is called with the features that clients ask for, whenever these change; on the board's
    /// thread.
    std::function<void(std::span<const SensorId>)> onWant = {};
    /// @throws std::invalid_argument naming the field, its value and the range
    void check() const;
  };

  /// @param container borrowed; it has all of its features already
  /// @param clock the time in which its readings are stamped; called on the board's thread
  /// @param commands borrowed; called on the board's thread, beside others that command the
  ///   robot; null: clients can't command it
  /// @throws std::invalid_argument for a configuration that makes no sense, or without a clock
  ServedContainer(const SensorContainer& container, std::function<Timestamp()> clock,
                  const Config& config, RobotCommands* commands = nullptr);
  ~ServedContainer() override;

  WorldDescription describe() const override;
  std::vector<std::string> plugins() const override { return {}; }
  Timestamp now() const override { return clock_(); }
  Timestamp livePeriod() const override { return fromSeconds(config_.period); }
  /// Copies the readings that are new since the last step.
  void step() override;
  std::vector<Resident> residents() const override;
  /// Robots can't be created, removed, reset or placed here: these calls throw ServeErrors.
  ServedRobot addRobot(RobotId robot, RobotWish wish) override;
  std::vector<std::string> abilities(RobotId robot) const override;
  void removeRobot(RobotId robot) override;
  void want(RobotId robot, std::span<const SensorId> features) override;
  std::span<Message> readings(RobotId robot) override;
  RobotCommands& commands(RobotId robot) override;
  void reset(std::optional<std::uint64_t> seed) override;
  void placeRobot(RobotId robot, const Pose2& pose) override;
  void placeObject(const std::string& object, const Pose2& pose) override;

 private:
  /// @throws ServeError unless it is the one robot, number 1
  static void check(RobotId robot);

  const SensorContainer& container_;
  std::function<Timestamp()> clock_;
  Config config_;
  RobotCommands* commands_;
  std::vector<std::uint64_t> seen_;  ///< sequence number of the reading last taken, by feature
  std::vector<Message> frame_;
};

}  // namespace ortung
