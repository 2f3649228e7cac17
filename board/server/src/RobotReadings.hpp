#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "Output.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung::server {

/// "LMS200/LRF/*", owned. @throws ServeError
struct Query {
  explicit Query(const std::string& text);
  std::string model;
  std::string type;
  std::string feature;
  bool matches(const SensorId& id) const;
};

/// How a client wants readings.
struct Choice {
  std::vector<Query> queries;  ///< none: all features
  bool again = false;          ///< true: also readings that the client has got already
  bool binary = false;
  bool wants(const SensorId& id) const;
};

/// How many readings were written, and how many were not, since they are too large for a line.
struct Written {
  std::size_t readings = 0;
  std::size_t leftOut = 0;
};

/// The newest reading of each feature of one robot: written by the thread that owns the world, read
/// by the thread that talks to clients. Neither waits for the other longer than a copy takes.
/// Thread-safe.
class RobotReadings {
 public:
  RobotReadings(RobotId robot, std::string name, std::vector<ServedFeature> features);

  RobotId robot() const { return robot_; }
  const std::string& name() const { return name_; }
  const std::vector<ServedFeature>& features() const { return features_; }

  /// Takes the words of large readings out of @p frame.
  void publish(std::span<Message> frame);
  /// The features that clients have asked for in the last kPatience cycles, each by its name or for
  /// binary readings; nothing if they are the same as when it was called last.
  std::optional<std::vector<SensorId>> takeWanted();
  static constexpr std::uint64_t kPatience = 500;
  /// The robot has left the field.
  void retire() { isRetired_ = true; }
  bool isRetired() const { return isRetired_; }
  /// Time starts over: there is no newest reading.
  void forget();

  /// Appends the chosen readings, oldest first: lines of a record, or in binary form a line without
  /// words, then the words as 32 bits each, the least significant byte first.
  /// @param sent by feature: count of the last reading this client got; brought up to date
  /// Called by one thread.
  Written write(const Choice& choice, std::vector<std::uint64_t>& sent, Output& out);

 private:
  struct Entry {
    Message newest;  ///< the newest reading, whose words are in `large` if there are many
    std::shared_ptr<const Message> large;
    std::string line;         ///< text of the newest reading; "": no client has asked yet
    std::uint64_t count = 0;  ///< number of readings so far
    bool isThere = false;
  };
  void append(Entry& entry, bool binary, Output& out) const;

  const RobotId robot_;
  const std::string name_;
  const std::vector<ServedFeature> features_;
  std::atomic<bool> isRetired_{false};
  std::mutex mutex_;
  std::vector<Entry> entries_;
  std::uint64_t cycle_ = 0;
  std::vector<std::uint64_t> wantedUntil_;  ///< cycle, by feature
  std::vector<char> told_;                  ///< whether takeWanted() reported it last, by feature
  std::vector<std::size_t> chosen_;         ///< scratch space of write(), which one thread calls
};

}  // namespace ortung::server
