#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include "ortung/base/Time.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung::ros2 {

/// What comes of each scanner, so that a moment waits for those whose reading of that time is still
/// on its way: devices are not equally late. Not thread-safe.
class ReadingStreams {
 public:
  using Clock = std::chrono::steady_clock;

  /// A device that will tell readings. It is waited for from the first reading of any on.
  void expect(const SensorId& id) { streamOf(id); }
  void take(const SensorId& id, Timestamp stamp, Clock::time_point now);
  /// Times begin anew.
  void forget();

  /// Whether a reading of up to @p stamp has yet to come, as far as can be known: of a device whose
  /// next reading is due by then, unless nothing has come of it for a while.
  bool isAwaited(Timestamp stamp, Clock::time_point now) const;

 private:
  struct Stream {
    SensorId id;
    std::optional<Timestamp> newest;
    Clock::time_point arrived;
    std::array<Timestamp, 8> periods{};  ///< times between the newest readings, as a ring [us]
    std::size_t count = 0;               ///< number of periods so far
  };
  Stream& streamOf(const SensorId& id);
  static Timestamp periodOf(const Stream& stream);

  std::vector<Stream> streams_;
  std::optional<Clock::time_point> begin_;  ///< time at which the first reading came
};

}  // namespace ortung::ros2
