#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// Converts the time stamps of a device's clock to the host's clock.
///
/// Arrival minus device time is the offset of the two clocks plus a delay that is never negative.
/// So the offset is the lower envelope of that difference: the edge of the lower convex hull of the
/// newest minute's minima that lies below their middle, whose slope is the drift of the clocks.
/// (Moon, Skelly, Towsley: Estimation and removal of clock skew from network delay measurements,
/// 1999; the hull's edge solves their linear program.)
/// The stamps that it returns never decrease and are never later than the arrival. If the device's
/// clock was set, the estimate starts over. Not thread-safe.
class ORTUNG_API DeviceClock {
 public:
  /// The greatest time of a device, before or after its zero [us]: 36,000 years, so that sums of
  /// two of them fit. What lies beyond is no time; toHost() takes it for this one.
  static constexpr Timestamp kFarthest = Timestamp{1} << 60;
  struct Config {
    double latency = 0.0;   ///< the shortest delay [s], if it is known
    double jump = 0.5;      ///< least change of the difference that may be a clock set [s]
    double patience = 2.0;  ///< duration of delays above `jump` after which it was set back [s]
    double longest = 10.0;  ///< longest delay [s]; beyond it the clock was set back, or stood still
  };
  DeviceClock() = default;
  explicit DeviceClock(const Config& config) : config_(config) {}

  /// Returns the host time of a reading. Readings of one device time have one stamp, unless they
  /// arrive so late that the clock stands still.
  /// @param device  time of measurement by the device's clock
  /// @param arrival time of arrival by the host's clock
  Timestamp toHost(Timestamp device, Timestamp arrival);
  /// Returns the stamp of a device without a clock: the arrival, but later than all stamps before.
  Timestamp toHost(Timestamp arrival);

  /// Call after the device was reopened: its clock may have restarted. Stamps go on increasing.
  void restart();

  std::uint64_t jumps() const { return jumps_; }  ///< how often the device's clock was set
  /// How much faster the device's clock runs than the host's [ppm]; 0 in the first 10 s.
  double driftPpm() const { return -1e6 * slope_; }
  /// Host time minus device time at the newest reading [us]; nothing before the first one.
  std::optional<Timestamp> offset() const;

 private:
  struct Least {
    Timestamp begin = 0;      ///< begin of a second of the device
    Timestamp device = 0;     ///< device time of that second's reading with the shortest delay
    double difference = 0.0;  ///< arrival minus device time, minus base_ [us]
  };
  double envelope(Timestamp device) const;
  bool standsStill(Timestamp arrival) const;
  bool hasJumped(Timestamp device, Timestamp arrival, double above);
  void note(Timestamp device, double difference);
  void fit();
  Timestamp inOrder(Timestamp stamp, Timestamp arrival);

  Config config_;
  std::deque<Least> least_;  ///< one for each second of the device, by time
  Timestamp base_ = 0;       ///< difference of the first reading, so that numbers stay small [us]
  double slope_ = 0.0;       ///< slope of the envelope [us/us]
  double intercept_ = 0.0;   ///< the envelope at least_.front().device [us]
  std::optional<Timestamp> device_;     ///< newest device time
  std::optional<Timestamp> lateSince_;  ///< arrival of the first late reading
  std::optional<Timestamp> stamp_;      ///< newest stamp that was returned
  std::uint64_t jumps_ = 0;
};

}  // namespace ortung
