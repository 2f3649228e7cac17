#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/emulators/EmulatedDevice.hpp"
#include "ortung/emulators/EmulatorFault.hpp"
#include "ortung/emulators/Endpoint.hpp"

namespace ortung {

/// Runs emulated devices that measure the readings of a source, in real time. Not thread-safe.
class ORTUNG_API EmulatorRun {
 public:
  struct Config {
    double speed = 1.0;      ///< emulated time / real time
    bool waits = true;       ///< whether to wait until all devices were asked to measure
    std::uint64_t seed = 1;  ///< seed of the faults' random numbers
  };
  /// One device at the end of its line.
  struct Line {
    std::unique_ptr<EmulatedDevice> device;  ///< the device
    std::unique_ptr<Endpoint> endpoint;      ///< its end of the line
    std::vector<EmulatorFault> faults = {};  ///< faults of the device and its line
  };
  /// Reads the source's first readings. @param source borrowed for as long as this lives
  EmulatorRun(std::vector<Line> lines, Source& source, const Config& config);

  /// Plays the source to its end, or until @p goesOn returns false; it is called every 20 ms or
  /// more often.
  /// @throws std::runtime_error if the source does
  void run(const std::function<bool()>& goesOn);

 private:
  Timestamp now() const;  ///< emulated time since the construction [us]
  struct State {
    bool isOdd = false;           ///< whether the last telegram's number was odd
    bool hasJumped = false;       ///< whether its clock was set
    std::vector<Message> frozen;  ///< last readings before it froze
  };
  bool everybodyMeasures() const;  ///< whether all devices were asked to measure
  void feed(Timestamp now);        ///< passes the readings that are due to the devices
  /// Passes a reading to a device, with the faults of now.
  void sense(std::size_t line, const Message& message, Timestamp now);
  /// Moves bytes between a device and its line, with the faults of now.
  void exchange(std::size_t line, Timestamp now);
  /// Unplugs and plugs a line, and sets its device's clock, as its faults say.
  void switchFaults(std::size_t line, Timestamp now);
  /// Whether a line has a fault now.
  bool has(std::size_t line, EmulatorFault::Kind kind, Timestamp now) const;
  void wait(Timestamp now) const;

  std::vector<Line> lines_;
  std::vector<State> states_;
  FrameReader reader_;
  Config config_;
  Random random_;
  std::vector<Message> frame_;  ///< the source's next readings of one time
  bool isAtEnd_ = false;
  Timestamp first_ = 0;               ///< stamp of the source's first readings
  Timestamp switchedOn_;              ///< real time of the construction [us]
  std::optional<Timestamp> beganAt_;  ///< emulated time of the source's first readings
};

}  // namespace ortung
