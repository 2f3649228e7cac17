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

/// The clock of a device: begins somewhere, runs at a rate of its own, and may be set.
struct EmulatedClock {
  double offset = 0.0;    ///< what it shows at time 0 [s]
  double driftPpm = 0.0;  ///< how much faster than ours
  Timestamp at(Timestamp now) const {
    return fromSeconds(offset) + now +
           static_cast<Timestamp>(static_cast<double>(now) * driftPpm * 1e-6);
  }
};

/// A device as its driver sees it: bytes in, bytes out. What it measures is given to it. Knows no
/// clock and no line: times are passed in, [us] from 0, and never run backwards. Not thread-safe.
class ORTUNG_API EmulatedDevice {
 public:
  virtual ~EmulatedDevice();

  /// What the robot's computer says.
  virtual void receive(std::string_view bytes, Timestamp now) = 0;
  /// It measures this now. Readings of other features are passed over.
  virtual void sense(const Message& reading, Timestamp now) = 0;
  /// Whether it has been asked to measure.
  virtual bool isMeasuring() const = 0;
  /// Speed of its line [bit/s]; nothing if it has none.
  virtual std::optional<int> baud() const { return std::nullopt; }

  struct Telegram {
    std::string bytes;
    std::optional<int> baud;  ///< speed at which it was sent
  };
  /// Telegrams that have left it by now, each one whole.
  std::vector<Telegram> takeOutput(Timestamp now);
  /// When the next telegram leaves it, or nothing.
  std::optional<Timestamp> due() const;

  EmulatedClock clock;

 protected:
  /// Puts a telegram on the line, behind what is there; it has left when all of it is sent.
  void send(std::string telegram, Timestamp now);
  bool isBusy(Timestamp now) const { return now < free_; }  ///< the line

 private:
  struct Sent {
    Timestamp due;
    Telegram telegram;
  };
  std::deque<Sent> output_;
  Timestamp free_ = 0;
};

}  // namespace ortung
