#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"

namespace ortung {

/// Merges the readings of several devices in the order of their stamps.
///
/// A reading is passed on once every device that is awaited has sent one of that time or later, so
/// that no earlier one can come; or, whichever device is missing, once it is `wait` old. A reading
/// that is earlier than one that was passed on is dropped and counted. Readings of one stamp come
/// in the order of the devices. It has no clock: times are passed in. Not thread-safe.
class ORTUNG_API Merger {
 public:
  /// @param devices number of devices
  /// @param wait greatest time that a reading waits for those of other devices [s], at least 0
  Merger(std::size_t devices, double wait);

  /// Sets whether others wait for this device; they never wait for its first reading.
  void await(std::size_t device, bool isAwaited) { lanes_[device].isAwaited = isAwaited; }
  /// Takes a reading. @pre the stamps of one device do not decrease
  /// @return false if one was dropped: it was too late, or too many wait
  bool push(std::size_t device, Message message);
  /// Returns the next reading that may be passed on at @p now, or nothing.
  std::optional<Message> pop(Timestamp now);
  /// Returns the time at which pop() has a reading if no other one comes; nothing without readings.
  std::optional<Timestamp> due() const;

  /// Number of the device's readings that were dropped because they were too late.
  std::uint64_t late(std::size_t device) const { return lanes_[device].late; }
  /// Number of the device's readings that were dropped because too many waited.
  std::uint64_t lost(std::size_t device) const { return lanes_[device].lost; }

 private:
  struct Lane {
    bool isAwaited = false;           ///< whether others wait for the device
    std::optional<Timestamp> newest;  ///< newest stamp
    std::uint64_t late = 0;           ///< number of readings dropped because they were too late
    std::uint64_t lost = 0;           ///< number of readings dropped because too many waited
    std::size_t waiting = 0;          ///< number of readings that wait
  };
  struct Waiting {
    Timestamp stamp;
    std::size_t device;
    std::uint64_t number;  ///< order of arrival
    mutable Message message;
    bool operator<(const Waiting& other) const;
  };
  std::vector<Lane> lanes_;
  Timestamp wait_;
  std::set<Waiting> waiting_;
  std::uint64_t pushed_ = 0;
  std::optional<Timestamp> passed_;  ///< newest stamp that was passed on
};

}  // namespace ortung
