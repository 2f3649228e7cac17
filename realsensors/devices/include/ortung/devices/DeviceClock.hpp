#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/devices/SteadyDelay.hpp"

namespace ortung {

/// Converts the time stamps of a device's clock to the host's clock, and finds readings that were
/// held up.
///
/// Arrival minus device time is the offset of the two clocks plus a delay that is never negative.
/// So the offset is the lower envelope of that difference: the edge of the lower convex hull of the
/// newest minute's minima that lies below their middle, whose slope is the drift of the clocks.
/// (Moon, Skelly, Towsley: Estimation and removal of clock skew from network delay measurements,
/// 1999; the hull's edge solves their linear program.)
///
/// A reading far above the envelope is late: it was held up in a queue, or the device's clock was
/// set back. A queue makes delays grow as time passes, no faster; a clock that is set does so at
/// once, and for good. So the clock was set if the lateness came in one step and then stays the
/// same; until that is known, and in any other case, readings are late. They never move the
/// envelope, unless they stay late by the same time for so long that another way of the line
/// explains it. Stamps never decrease and are never later than the arrival. Not thread-safe.
class ORTUNG_API DeviceClock {
 public:
  /// The greatest time of a device, before or after its zero [us]: 36,000 years, so that sums of
  /// two of them fit. What lies beyond is no time; toHost() takes it for this one.
  static constexpr Timestamp kFarthest = Timestamp{1} << 60;
  struct Config {
    double latency = 0.0;    ///< the shortest delay [s], if it is known
    double lateAfter = 0.5;  ///< delay beyond it that makes a reading late [s]
  };
  DeviceClock() = default;
  explicit DeviceClock(const Config& config) : config_(config) {}

  /// Returns the host time of a reading; nothing if it is late, or older than one that was used.
  /// Readings of one device time have one stamp.
  /// @param device  time of measurement by the device's clock
  /// @param arrival time of arrival by the host's clock
  std::optional<Timestamp> toHost(Timestamp device, Timestamp arrival);
  /// Returns the stamp of a device without a clock: the arrival, but later than all stamps before.
  Timestamp toHost(Timestamp arrival);

  /// Call after the device was reopened: its clock may have restarted, or readings may still wait
  /// that it sent before. Stamps go on increasing.
  void restart();

  std::uint64_t jumps() const { return jumps_; }  ///< how often the device's clock was set
  /// How much faster the device's clock runs than the host's [ppm], at most kMostDriftPpm; 0 in
  /// the first 10 s.
  double driftPpm() const { return -1e6 * slope_; }
  /// The greatest drift that is followed [ppm]; crystals are 100 times better.
  static constexpr double kMostDriftPpm = 1000.0;
  /// Whether the last half minute drifted by more: stamps are then off by what is not followed.
  bool driftsTooMuch() const { return driftsTooMuch_; }
  /// By how much the newest reading's delay exceeds the shortest one [s]; nothing while a queue is
  /// emptied of which no reading came in time, so the shortest one is not known.
  std::optional<double> delay() const;
  /// Host time minus device time at the newest reading [us]; nothing before the first one.
  std::optional<Timestamp> offset() const;

 private:
  struct Least {
    Timestamp begin = 0;      ///< begin of a second of the device
    Timestamp device = 0;     ///< device time of that second's reading with the shortest delay
    double difference = 0.0;  ///< arrival minus device time, minus base_ [us]
  };
  /// How lateness began.
  enum class Late : std::uint8_t {
    kNot,    ///< the newest reading was in time
    kStep,   ///< lateness began with an earlier device time: no queue does that
    kGap,    ///< lateness began after a time without readings
    kCreep,  ///< lateness began little by little
  };
  /// A fall of the difference.
  struct Fall {
    double from = 0.0;     ///< the envelope at the begin of a window of time, plus base_ [us]
    Timestamp fromAt = 0;  ///< begin of the window
    bool isOn = false;     ///< whether it fell by more than a clock could
    double to = 0.0;       ///< least difference, plus base_ [us]
    Timestamp device = 0;  ///< its device time
    Timestamp toAt = 0;    ///< its arrival
  };
  double envelope(Timestamp device) const;
  void startOver(Timestamp difference, Timestamp arrival);
  bool isLate(Timestamp device, Timestamp arrival, double above);
  bool isEmptied(Timestamp device, Timestamp arrival);
  void note(Timestamp device, double difference);
  void fit();
  Timestamp inOrder(Timestamp stamp, Timestamp arrival);

  Config config_;
  std::deque<Least> least_;  ///< one for each second of the device, by time
  Timestamp base_ = 0;       ///< difference of the first reading, so that numbers stay small [us]
  double slope_ = 0.0;       ///< slope of the envelope [us/us]
  double intercept_ = 0.0;   ///< the envelope at least_.front().device [us]
  bool driftsTooMuch_ = false;
  std::optional<Timestamp> device_;  ///< newest device time
  std::optional<Timestamp> used_;    ///< newest device time of a reading that was not late
  double above_ = 0.0;               ///< delay of the newest reading above the envelope [us]
  Late late_ = Late::kNot;
  SteadyDelay steady_;  ///< the readings since it began
  Fall fall_;
  bool isReopened_ = false;         ///< whether no reading has come since restart()
  std::optional<Timestamp> stamp_;  ///< newest stamp that was returned
  std::uint64_t jumps_ = 0;
};

}  // namespace ortung
