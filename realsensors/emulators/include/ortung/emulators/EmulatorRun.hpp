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

/// Emulated devices that measure what a source says, in real time. Not thread-safe.
class ORTUNG_API EmulatorRun {
 public:
  struct Config {
    double speed = 1.0;      ///< of the source's time
    bool waits = true;       ///< time begins when all devices have been asked to measure
    std::uint64_t seed = 1;  ///< of what goes wrong
  };
  /// One device at the end of its line.
  struct Line {
    std::unique_ptr<EmulatedDevice> device;
    std::unique_ptr<Endpoint> endpoint;
    std::vector<EmulatorFault> faults = {};
  };
  /// @param source borrowed
  EmulatorRun(std::vector<Line> lines, Source& source, const Config& config);

  /// Plays the source to its end, or until @p goesOn, asked every now and then, says no.
  /// @throws std::runtime_error of the source
  void run(const std::function<bool()>& goesOn);

 private:
  Timestamp now() const;  ///< of the devices: since this was made [us]
  struct State {
    bool wasFaulty = false;
    bool isOdd = false;
    bool hasJumped = false;
    std::vector<Message> frozen;  ///< last readings before it froze
  };
  bool everybodyMeasures() const;
  void feed(Timestamp now);
  void sense(std::size_t line, const Message& message, Timestamp now);
  void exchange(std::size_t line, Timestamp now);
  void switchFaults(std::size_t line, Timestamp now);
  bool has(std::size_t line, EmulatorFault::Kind kind, Timestamp now) const;
  void wait(Timestamp now) const;

  std::vector<Line> lines_;
  std::vector<State> states_;
  FrameReader reader_;
  Config config_;
  Random random_;
  std::vector<Message> frame_;  ///< the next moment of the source
  bool isAtEnd_ = false;
  Timestamp first_ = 0;               ///< stamp of the source's first moment
  Timestamp switchedOn_;              ///< real time [us]
  std::optional<Timestamp> beganAt_;  ///< when the source's first moment is, of now()
};

}  // namespace ortung
