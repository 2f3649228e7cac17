#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// The clock of a device: it has an offset and a drift, and may be set.
struct EmulatedClock {
  double offset = 0.0;    ///< time that it shows at time 0 [s]
  double driftPpm = 0.0;  ///< how much faster it runs than real time [ppm]
  /// Returns the time that it shows at @p now [us].
  Timestamp at(Timestamp now) const {
    return fromSeconds(offset) + now +
           static_cast<Timestamp>(static_cast<double>(now) * driftPpm * 1e-6);
  }
};

/// A device as its driver sees it: bytes in, bytes out. What it measures is passed in. It has no
/// clock and no line: times are passed in, [us] from 0, and never decrease. Not thread-safe.
class ORTUNG_API EmulatedDevice {
 public:
  virtual ~EmulatedDevice();

  /// Takes bytes that the robot's computer has sent.
  virtual void receive(std::string_view bytes, Timestamp now) = 0;
  /// Takes a reading that it measures now. Readings of other features are ignored.
  virtual void sense(const Message& reading, Timestamp now) = 0;
  /// Whether the driver has asked it to measure.
  virtual bool isMeasuring() const = 0;
  /// Speed to which it has set its line [bit/s]; nothing if the line has no speed.
  virtual std::optional<int> baud() const { return std::nullopt; }

  /// A whole telegram to the driver.
  struct Telegram {
    std::string bytes;        ///< the telegram
    std::optional<int> baud;  ///< speed at which it was sent [bit/s]
  };
  /// Takes the telegrams that it has sent completely by now.
  std::vector<Telegram> takeOutput(Timestamp now);
  /// Time at which the next telegram is sent completely, or nothing.
  std::optional<Timestamp> due() const;

  EmulatedClock clock;  ///< clock of its time stamps

 protected:
  /// Queues a telegram. It takes the time to send all bytes before it and its own.
  void send(std::string telegram, Timestamp now);
  /// Drops the telegrams that were not sent completely.
  void dropOutput(Timestamp now);
  /// Whether the line is still sending.
  bool isBusy(Timestamp now) const { return now < free_; }

 private:
  struct Sent {
    Timestamp due;  ///< time at which it is sent completely
    Telegram telegram;
  };
  std::deque<Sent> output_;  ///< telegrams that were not taken yet
  Timestamp free_ = 0;       ///< time from which on the line is free
};

}  // namespace ortung
