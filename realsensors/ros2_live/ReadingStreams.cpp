#include "ReadingStreams.hpp"

#include <algorithm>

namespace ortung::ros2 {
namespace {

/// How long a device is waited for from which nothing has come yet.
constexpr std::chrono::seconds kFirst{1};
/// The least time without a reading after which a device is not waited for: what sees something
/// only at times holds others up that long.
constexpr std::chrono::milliseconds kSilent{500};
constexpr Timestamp kLongest = 60'000'000;  ///< period that is believed [us]

}  // namespace

ReadingStreams::Stream& ReadingStreams::streamOf(const SensorId& id) {
  const auto known = std::find_if(streams_.begin(), streams_.end(),
                                  [&](const Stream& stream) { return stream.id == id; });
  if (known != streams_.end()) return *known;
  streams_.emplace_back().id = id;
  return streams_.back();
}

void ReadingStreams::take(const SensorId& id, Timestamp stamp, Clock::time_point now) {
  if (!begin_) begin_ = now;
  Stream& stream = streamOf(id);
  stream.arrived = now;
  if (stream.newest && stamp <= *stream.newest) return;
  if (stream.newest)
    stream.periods[stream.count++ % stream.periods.size()] =
        std::min(stamp - *stream.newest, kLongest);
  stream.newest = stamp;
}

void ReadingStreams::forget() {
  for (Stream& stream : streams_) {
    stream.newest.reset();
    stream.count = 0;
  }
  begin_.reset();
}

/// Returns the least time between two of the newest readings [us]; 0 if that is unknown.
Timestamp ReadingStreams::periodOf(const Stream& stream) {
  const std::size_t count = std::min(stream.count, stream.periods.size());
  if (count == 0) return 0;
  return *std::min_element(stream.periods.begin(), stream.periods.begin() + count);
}

bool ReadingStreams::isAwaited(Timestamp stamp, Clock::time_point now) const {
  if (!begin_) return false;
  return std::any_of(streams_.begin(), streams_.end(), [&](const Stream& stream) {
    if (!stream.newest) return now - *begin_ < kFirst;
    if (stamp <= *stream.newest) return false;
    const Timestamp period = periodOf(stream);
    const std::chrono::microseconds due(3 * period);
    if (now - stream.arrived >= std::max<Clock::duration>(kSilent, due)) return false;
    // Periods are not exact: a fifth earlier may be on time.
    return *stream.newest + period - period / 5 <= stamp;
  });
}

}  // namespace ortung::ros2
