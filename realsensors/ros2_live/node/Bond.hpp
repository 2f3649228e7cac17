#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "Participant.hpp"

namespace ortung::ros2 {

/// This side of a bond (the package bond): says again and again that it lives, so that a lifecycle
/// manager notices if it does not, and that it ends. Thread-safe.
class Bond {
 public:
  using Clock = std::chrono::steady_clock;
  /// @param id of the bond, the node's name @param period between two heartbeats [s]
  Bond(std::string id, double period);

  void connect(Participant& node);
  void start(Clock::time_point now = Clock::now());
  void stop(Clock::time_point now = Clock::now());
  /// Says that it lives, if it is time to; called now and then.
  void tick(Clock::time_point now = Clock::now());
  /// Hears what a side says, as bytes (CDR): if the other one ends, so does this.
  void hear(std::string_view cdr, Clock::time_point now = Clock::now());
  /// In place of connect(), for tests.
  void sendBy(Participant::Sender send);

  /// How long the other side may hear nothing, as nav2's nodes have it.
  static constexpr std::chrono::seconds kTimeout{4};

 private:
  void say(Clock::time_point now);

  const std::string id_;
  const std::chrono::duration<double> period_;
  std::mutex mutex_;
  Participant::Sender send_;
  std::string instance_;
  bool isActive_ = false;
  Clock::time_point next_;   ///< heartbeat
  Clock::time_point until_;  ///< of the last word that it has ended
};

}  // namespace ortung::ros2
