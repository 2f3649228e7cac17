#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/server/BoardCommand.hpp"
#include "ortung/server/ForwardedWorld.hpp"
#include "ortung/server/Recordings.hpp"

namespace ortung {

/// A served world whose robots clients record: LIST robots says whose record is under way. While a
/// robot is recorded it senses all that it can. Records end with their robots, and where time
/// starts over. Not thread-safe: one thread owns it.
class ORTUNG_API RecordedWorld final : public ForwardedWorld {
 public:
  struct Config {
    /// Whether records take what readings() gives. If not, the host writes their time steps itself.
    bool takesReadings = true;
    /// What else belongs to the present cycle in each record; may be empty.
    std::function<std::vector<Message>()> also = {};
  };

  /// @param world borrowed, as are @p recordings
  RecordedWorld(ServedWorld& world, Recordings& recordings, Config config);
  ~RecordedWorld() override;

  /// All that can be recorded.
  std::vector<RobotId> robots();
  /// @throws ServeError as Recordings does, or if there is no such robot
  /// Begins a record of a robot, or goes on with the one under way.
  void begin(RobotId robot);
  /// Ends the record of a robot, if there is one.
  void end(RobotId robot);
  /// State of a robot's record.
  Recordings::State state(RobotId robot);

  void step() override;
  ServedRobot addRobot(RobotId robot, RobotWish wish) override;
  void removeRobot(RobotId robot) override;
  std::string side(RobotId robot) const override;
  /// Remembers what clients want; while a robot is recorded, all of its features stay wanted.
  void want(RobotId robot, std::span<const SensorId> features) override;
  /// Readings of the world, which are written into the robot's record.
  std::span<Message> readings(RobotId robot) override;
  /// Jumps of time end all records.
  void seek(Timestamp stamp) override;
  void reset(std::optional<std::uint64_t> seed) override;

 private:
  /// A robot that can be recorded.
  struct Robot {
    std::string name;
    std::vector<SensorId> features;
    FeatureFormats formats;  ///< as far as they are known
    bool isResident = false;
    std::vector<SensorId> wanted = {};  ///< features that clients ask for
  };
  /// Notes which robots of the world came and left; a record ends with its robot.
  void meetResidents();
  /// @throws ServeError if there is no such robot
  Robot& find(RobotId robot);

  Recordings& recordings_;
  const Config config_;
  std::optional<std::uint64_t> version_;  ///< residentsVersion() at the last meetResidents()
  std::map<RobotId, Robot> robots_;
};

/// RECORD of docs/protocol.md.
/// @param world borrowed, for as long as the board that has the command
ORTUNG_API BoardCommand recordCommand(RecordedWorld& world);

}  // namespace ortung
