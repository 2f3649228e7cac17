#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung {

/// Records of robots, begun and ended while these run: files of one folder, whose names are made of
/// those of the robots and a number above all that there are, so a client that asks for a record
/// can't choose the file. A record that can't be written any more ends, and its robot's state says
/// why. Thread-safe; who gives readings never waits for a disk that closes another record.
class ORTUNG_API Recordings {
 public:
  struct Config {
    std::filesystem::path folder;  ///< made if it is not there; "": nothing is recorded
    std::size_t most = 64;         ///< open at a time
    /// Is called with what could not be written; from any thread. May be empty.
    std::function<void(const std::string&)> onProblem = {};
  };
  /// Whether a robot is recorded, and into which file.
  struct State {
    enum class Kind : std::uint8_t { kOff, kOn, kFailed };
    Kind kind = Kind::kOff;
    std::string file = {};  ///< name of the present record, or of the last one; "": there was none
    std::size_t moments = 0;  ///< time steps written to the record
    std::string text = {};    ///< reason of kFailed
  };

  /// @throws std::runtime_error if the folder can't be made, or nothing can be written there
  explicit Recordings(Config config);
  ~Recordings();  ///< ends all
  Recordings(const Recordings&) = delete;
  Recordings& operator=(const Recordings&) = delete;

  /// Goes on if it is on already.
  /// @param name of the robot; any text
  /// @param worldFingerprint "": of no known world
  /// @throws ServeError without a folder, for too many records, or if no file can be made
  void begin(RobotId robot, const std::string& name, const std::string& worldFingerprint,
             FeatureFormats formats = {});
  /// One moment of a robot; of one that is not recorded, and without readings, nothing is done.
  /// @param more what else belongs to the moment
  void write(RobotId robot, std::span<const Message> moment, std::span<const Message> more = {});
  /// Makes the record whole, if there is one. @throws ServeError if it could not be written
  void end(RobotId robot);
  /// How the robot's record is; kOff if it never had one.
  State state(RobotId robot) const;

  /// The robot has left for good: ends its record and forgets it.
  void forget(RobotId robot);
  /// Ends all that are on; errors go to onProblem. @returns how they are now
  std::vector<State> endAll();

 private:
  struct Record {
    std::unique_ptr<RecordWriter> writer;  ///< null unless it is on
    State state;
    Timestamp last = 0;  ///< stamp of the newest reading
  };
  /// Makes a file of a name that was not in use: the robot's name and a number. @returns the name
  std::string newFile(const std::string& name);
  void noteFiles();
  static void write(Record& record, std::span<const Message> readings);
  /// Ends a record; returns what went wrong, or "".
  std::string close(RobotId robot);

  const Config config_;
  mutable std::mutex mutex_;  ///< guards the members below
  std::map<RobotId, Record> records_;
  std::map<std::string, int> numbers_;  ///< greatest number in use, by what stands before it
};

/// "off", "on", "failed".
ORTUNG_API const char* nameOf(Recordings::State::Kind kind);

}  // namespace ortung
