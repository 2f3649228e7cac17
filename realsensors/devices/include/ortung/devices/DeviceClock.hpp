#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// Puts the stamps of a device's own clock on ours.
///
/// Arrival minus device time is the offset of the two clocks and a delay that is never negative. So
/// the offset is the lower envelope of that difference: the edge of the lower convex hull of the
/// newest minute's minima that lies below their middle, whose slope is the drift of the clocks.
/// (Moon, Skelly, Towsley: Estimation and removal of clock skew from network delay measurements,
/// 1999; the hull's edge solves their linear program.)
/// The stamps that it gives never run backwards and are never later than the arrival. A clock that
/// was set is noticed, and the estimate starts over. Not thread-safe.
class ORTUNG_API DeviceClock {
 public:
  struct Config {
    double latency = 0.0;   ///< [s]: what the shortest delay is known to be
    double jump = 0.5;      ///< [s]: more than the delays of readings that come in time
    double patience = 2.0;  ///< [s]: readings later than `jump` for so long are a clock set back
  };
  DeviceClock() = default;
  explicit DeviceClock(const Config& config) : config_(config) {}

  /// Our time of a reading that the device measured at @p device on its clock, and that came at
  /// @p arrival on ours. Readings of one device time have one stamp.
  Timestamp toHost(Timestamp device, Timestamp arrival);
  /// The same of a device without a clock: its arrival, later than all before.
  Timestamp toHost(Timestamp arrival);

  /// The device was opened anew: its clock may have begun again. Stamps go on rising.
  void restart();

  std::uint64_t jumps() const { return jumps_; }  ///< how often the device's clock was set
  /// How much faster the device's clock runs than ours, parts per million; 0 before 10 s are known.
  double driftPpm() const { return -1e6 * slope_; }
  /// Our time minus the device's at its newest reading [us]; nothing without one.
  std::optional<Timestamp> offset() const;

 private:
  struct Least {
    Timestamp begin = 0;      ///< of a second
    Timestamp device = 0;     ///< of its reading with the shortest delay
    double difference = 0.0;  ///< arrival minus device time, minus base_ [us]
  };
  double envelope(Timestamp device) const;
  bool hasJumped(Timestamp device, Timestamp arrival, double above);
  void note(Timestamp device, double difference);
  void fit();
  Timestamp inOrder(Timestamp stamp, Timestamp arrival);

  Config config_;
  std::deque<Least> least_;  ///< by seconds of the device, in the order of time
  Timestamp base_ = 0;       ///< difference of the first reading, so that numbers stay small [us]
  double slope_ = 0.0;       ///< of the envelope [us/us]
  double intercept_ = 0.0;   ///< at device time 0 of least_.front() [us]
  std::optional<Timestamp> device_;     ///< newest device time
  std::optional<Timestamp> lateSince_;  ///< arrival of the first of the readings that are late
  std::optional<Timestamp> stamp_;      ///< newest stamp that was given
  std::uint64_t jumps_ = 0;
};

}  // namespace ortung
