#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// How a device is. What MCL may use comes from kRunning alone.
enum class DeviceState : std::uint8_t {
  kOpening,  ///< it is being connected, or has not measured yet
  kAbsent,   ///< it can't be reached; it is tried again
  kRunning,  ///< it measures
  kStale,    ///< it is connected, but has given no reading for a while
  kFrozen,   ///< it repeats its last reading
  kFailed    ///< what it says does not fit, or its driver has failed; it is tried again
};
ORTUNG_API const char* toText(DeviceState state);

/// What there is to say of a device.
struct DeviceStatus {
  std::string name;  ///< plugin and port
  DeviceState state = DeviceState::kOpening;
  std::string reason;              ///< why it is not running; kept until it runs again
  std::uint64_t readings = 0;      ///< that were taken
  double rate = 0.0;               ///< of these, in the last two seconds [1/s]
  std::optional<double> age;       ///< of the newest one [s]
  std::uint64_t openings = 0;      ///< how often it was connected
  std::uint64_t refused = 0;       ///< what made no sense: damaged telegrams, unknown lines
  std::uint64_t repeated = 0;      ///< readings that repeated the last one, not taken
  std::uint64_t flooded = 0;       ///< readings that came too fast, not taken
  std::uint64_t late = 0;          ///< readings that came after those of later stamps, not taken
  std::uint64_t clockJumps = 0;    ///< how often its clock was set
  std::optional<double> driftPpm;  ///< its clock's; nothing if it has none
};

/// Follows how a device is, and says when it is to be opened and closed. Knows no clock: times are
/// passed in, and never run backwards. Not thread-safe.
class ORTUNG_API DeviceHealth {
 public:
  struct Config {
    double staleAfter = 1.0;     ///< without a reading [s]
    double openAfter = 0.5;      ///< from the first failure to the next try [s]; doubles each time
    double openAfterMost = 8.0;  ///< [s]
    double reopenAfter = 5.0;    ///< without a reading: close it, and try again [s]
  };
  explicit DeviceHealth(const Config& config) : config_(config) {}

  bool isOpen() const { return isOpen_; }
  /// Whether to open it now.
  bool mayOpen(Timestamp now) const { return !isOpen_ && now >= nextTry_; }
  Timestamp nextTry() const { return nextTry_; }
  /// Whether to give it up for now: it has been silent for too long.
  bool mustClose(Timestamp now) const;

  void opened(Timestamp now);
  /// It could not be opened, or is gone. @param isMisfit it is there, and does not fit
  void closed(Timestamp now, bool isMisfit, const std::string& why);
  void tookReading(Timestamp now);
  void sawRepeat(Timestamp now);  ///< it gave its last reading once more

  DeviceState state(Timestamp now) const;
  /// All but name and what others count.
  DeviceStatus status(Timestamp now) const;

 private:
  double since(Timestamp then, Timestamp now) const { return toSeconds(now - then); }
  Config config_;
  bool isOpen_ = false;
  bool isMisfit_ = false;
  bool hasFailed_ = false;  ///< since it last ran
  bool repeats_ = false;
  std::string reason_;
  double wait_ = 0.0;  ///< before the next try [s]
  Timestamp nextTry_ = 0;
  Timestamp openedAt_ = 0;
  std::optional<Timestamp> lastReading_;
  std::optional<Timestamp> lastSign_;  ///< of life: readings, repeated ones, too
  std::deque<Timestamp> recent_;       ///< readings of the last two seconds
  std::uint64_t readings_ = 0;
  std::uint64_t openings_ = 0;
};

}  // namespace ortung
