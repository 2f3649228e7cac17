#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ortung/server/BoardCommand.hpp"
#include "ortung/server/PlainWorld.hpp"

namespace ortung {

/// Records with a time line, side by side: each is a robot of this world, with all the readings
/// that are in it, and all begin at time 0. Clients pause, seek and change the speed. Unlike a
/// ServedRecord it lets no robots of clients in: it is for spectators.
/// Not thread-safe.
class ORTUNG_API ServedPlayback : public PlainWorld {
 public:
  /// One record to play.
  struct Run {
    std::filesystem::path record;
    std::string name;  ///< the robot's name: [A-Za-z0-9_-], 1 to 32 characters
    /// What is known of its features; of other features clients get the names alone.
    std::vector<ServedFeature> features = {};
    std::vector<std::string> abilities = {};  ///< lines of DESCRIBE, see ServedWorld
  };
  struct Config {
    std::string name;                        ///< the world's name for clients
    std::vector<Run> runs;                   ///< records to play, 1 to 16
    std::vector<std::string> field = {};     ///< lines of DESCRIBE field
    std::optional<FieldBounds> bounds = {};  ///< field; nothing: the box around all true poses
    double period = 0.02;                    ///< length of a cycle [s], in [0.001, 10]
  };
  /// Something that happened in a run.
  struct Mark {
    Timestamp stamp = 0;  ///< time of the event on the time line [us]
    std::string text;     ///< e.g. "scout: lost"
  };

  /// What a run has of one feature.
  struct Content {
    SensorId id;
    std::uint64_t readings = 0;  ///< how many there are
    Timestamp first = 0;         ///< stamps of the first and the last one on the time line [us]
    Timestamp last = 0;
  };

  /// Reads each record once: which features it has, how long it is, and what happened in it.
  /// @param progress asked now and then with the share done; false: gives up
  /// @throws std::runtime_error if one is no record or has no readings, or when it is given up;
  ///   std::invalid_argument for a configuration that makes no sense
  explicit ServedPlayback(const Config& config, const std::function<bool(double)>& progress = {});
  ~ServedPlayback() override;

  /// When the localization lost itself and found itself again, a robot was carried away, or a
  /// referee decided, in the order of time; at most 10,000.
  const std::vector<Mark>& marks() const;
  Timestamp length() const;  ///< length of the longest run [us]
  /// What a run holds, in the order in which its features first appear. Thread-safe.
  /// @throws ServeError
  const std::vector<Content>& contents(RobotId robot) const;
  /// Readings of a whole run, on the time line: of each feature at most @p most, evenly chosen, the
  /// last one among them, but for readings of more than 8192 words. Reads the record. Thread-safe.
  /// @param queries "MODEL/TYPE/FEATURE", at least one
  /// @param goOn asked often; false: gives up and returns nothing
  /// @throws ServeError, std::runtime_error, std::invalid_argument for a text that is no query
  std::vector<Message> history(RobotId robot, const std::vector<std::string>& queries,
                               std::size_t most, const std::function<bool()>& goOn) const;

  WorldDescription describe() const override;
  std::vector<std::string> plugins() const override { return {}; }
  std::vector<std::string> field() const override;
  std::vector<ServedFeature> truthFeatures() const override;
  std::span<Message> truth() override;
  Timestamp now() const override;
  bool isAtEnd() const override;
  void step() override;
  /// Jumps on the time line of all runs; readings of the seconds before are found, too.
  void seek(Timestamp stamp) override;
  std::vector<Resident> residents() const override;
  /// Robots can't be added or placed: these calls throw ServeErrors.
  ServedRobot addRobot(RobotId robot, RobotWish wish) override;
  std::vector<std::string> abilities(RobotId robot) const override;
  void removeRobot(RobotId robot) override;
  std::span<Message> readings(RobotId robot) override;
  RobotCommands& commands(RobotId robot) override;
  void reset(std::optional<std::uint64_t> seed) override;
  void placeRobot(RobotId robot, const Pose2& pose) override;
  void placeObject(const std::string& object, const Pose2& pose) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// EVENTS, the marks of the time line; CONTENTS and HISTORY, what the records hold.
/// @param playback borrowed
ORTUNG_API std::vector<BoardCommand> playbackCommands(const ServedPlayback& playback);

}  // namespace ortung
