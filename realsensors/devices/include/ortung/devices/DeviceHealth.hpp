#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// The state of a device. MCL may use its readings in kRunning only.
enum class DeviceState : std::uint8_t {
  kOpening,  ///< the device is being connected, or has not measured yet
  kAbsent,   ///< the device can't be reached; it is tried again
  kRunning,  ///< the device measures
  kStale,    ///< the device is connected, but has sent no reading for a while
  kFrozen,   ///< the device repeats its last reading
  kFailed,   ///< the device does not fit, or its driver has failed; it is tried again
  kLate,     ///< the device's readings are too old when they arrive; they are not used
  kLast = kLate
};
/// Returns the state in a word, e.g. "running".
ORTUNG_API const char* toText(DeviceState state);

/// State and counters of a device.
struct DeviceStatus {
  std::string name;                           ///< plugin and port
  DeviceState state = DeviceState::kOpening;  ///< its state now
  std::string reason;                         ///< why it is not running; kept until it runs again
  std::uint64_t readings = 0;                 ///< number of readings that were accepted
  double rate = 0.0;                          ///< their rate in the last two seconds [1/s]
  std::optional<double> age;                  ///< time since the newest one [s]
  std::uint64_t openings = 0;                 ///< how often it was connected
  std::uint64_t refused = 0;                  ///< damaged telegrams, unknown lines, invalid words
  std::uint64_t repeated = 0;  ///< readings dropped because they repeated the last one
  std::uint64_t flooded = 0;   ///< readings dropped because they came too fast
  /// Readings dropped because they were too old, or because later ones were passed on.
  std::uint64_t late = 0;
  std::uint64_t clockJumps = 0;    ///< how often its clock was set
  std::optional<double> driftPpm;  ///< drift of its clock [ppm]; nothing if it has none
  bool driftsTooMuch = false;      ///< whether its clock drifts by more than is followed
};

/// Tracks the state of a device, and decides when it is opened and closed. It has no clock: times
/// are passed in, and never decrease. Not thread-safe.
class ORTUNG_API DeviceHealth {
 public:
  struct Config {
    double staleAfter = 1.0;       ///< time without a reading after which it is stale [s]
    double openAfter = 0.25;       ///< wait after the first failure [s]; doubles with each one
    double openAfterMost = 1.0;    ///< greatest wait for a device that is absent [s]
    double misfitAfterMost = 8.0;  ///< greatest wait for one that does not fit [s]
    double refreshAfter = 0.75;  ///< time of late readings after which it is refreshed [s]; doubles
    double refreshAfterMost = 8.0;  ///< greatest time between two refreshes [s]
    double reopenAfter = 5.0;       ///< time without a reading after which it is reopened [s]
  };
  explicit DeviceHealth(const Config& config) : config_(config) {}

  /// Whether the device is open.
  bool isOpen() const { return isOpen_; }
  /// Whether the device is to be opened now.
  bool mayOpen(Timestamp now) const { return !isOpen_ && now >= nextTry_; }
  /// Time at which it may be opened again.
  Timestamp nextTry() const { return nextTry_; }
  /// Whether the device is to be closed now: it has been silent for too long.
  bool mustClose(Timestamp now) const;

  /// Whether what waits at the device is to be dropped now: its readings have been late for long.
  bool mustRefresh(Timestamp now) const;

  /// Reports that it was opened.
  void opened(Timestamp now);
  /// Reports that it could not be opened, or was closed.
  /// @param isMisfit whether the device is there, but does not fit
  void closed(Timestamp now, bool isMisfit, const std::string& why);
  void tookReading(Timestamp now);  ///< reports a reading
  void sawRepeat(Timestamp now);    ///< reports a reading that repeats the last one
  /// Reports a reading that is late. @param delay by how much [s]; nothing: it is not known
  void sawLate(Timestamp now, std::optional<double> delay);
  void refreshed(Timestamp now);  ///< reports that what waited at the device was dropped

  DeviceState state(Timestamp now) const;  ///< the state
  /// Returns the status without the name and the counters that others keep.
  DeviceStatus status(Timestamp now) const;

 private:
  double since(Timestamp then, Timestamp now) const { return toSeconds(now - then); }
  Config config_;
  bool isOpen_ = false;
  bool isMisfit_ = false;               ///< whether the device did not fit when it was closed
  bool hasFailed_ = false;              ///< whether it has failed since it last ran
  bool repeats_ = false;                ///< whether the newest reading was a repeated one
  std::optional<Timestamp> lateSince_;  ///< begin of the time of late readings
  std::optional<double> delay_;         ///< lateness of the newest one [s], if known
  Timestamp nextRefresh_ = 0;
  double refreshWait_ = 0.0;  ///< wait before the refresh after the next one [s]
  std::string reason_;
  double wait_ = 0.0;  ///< wait before the next try [s]
  Timestamp nextTry_ = 0;
  Timestamp openedAt_ = 0;
  std::optional<Timestamp> lastReading_;
  std::optional<Timestamp> lastSign_;  ///< time of the newest reading, repeated or not
  std::deque<Timestamp> recent_;       ///< times of the readings of the last two seconds
  std::uint64_t readings_ = 0;
  std::uint64_t openings_ = 0;
};

}  // namespace ortung
