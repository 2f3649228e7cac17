#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"

namespace ortung {

/// Puts the readings of several devices into the order of their stamps.
///
/// A reading is passed on once every device that is awaited has given one of that time or later, so
/// that nothing earlier can come; or once it is `wait` old, whoever is missing then. What comes
/// later than what was passed on already is dropped and counted. Readings of one stamp come in the
/// order of the devices. Knows no clock: times are passed in. Not thread-safe.
class ORTUNG_API Merger {
 public:
  /// @param wait [s], at least 0
  Merger(std::size_t devices, double wait);

  /// Whether others wait for this device; not before it has given its first reading.
  void await(std::size_t device, bool isAwaited) { lanes_[device].isAwaited = isAwaited; }
  /// Takes a reading; stamps of one device do not run backwards.
  /// Returns false if it was too late, or there are too many, and drops one then.
  bool push(std::size_t device, Message message);
  /// The next reading that may be passed on at @p now, or nothing yet.
  std::optional<Message> pop(Timestamp now);
  /// When pop() has something at the latest if nothing else comes; nothing without readings.
  std::optional<Timestamp> due() const;

  std::uint64_t late(std::size_t device) const { return lanes_[device].late; }
  std::uint64_t lost(std::size_t device) const { return lanes_[device].lost; }

 private:
  struct Lane {
    bool isAwaited = false;
    std::optional<Timestamp> newest;
    std::uint64_t late = 0;
    std::uint64_t lost = 0;
    std::size_t waiting = 0;
  };
  struct Waiting {
    Timestamp stamp;
    std::size_t device;
    std::uint64_t number;  ///< readings of one device and stamp keep their order
    mutable Message message;
    bool operator<(const Waiting& other) const;
  };
  std::vector<Lane> lanes_;
  Timestamp wait_;
  std::set<Waiting> waiting_;
  std::uint64_t pushed_ = 0;
  std::optional<Timestamp> passed_;  ///< stamp of the newest that was passed on
};

}  // namespace ortung
