#pragma once

#include <span>
#include <vector>

#include "ortung/emulators/EmulatedDevice.hpp"

namespace ortung {

/// A device that sends its readings as lines of a record without being asked, as a microcontroller
/// can. Stamps are its clock's. Not thread-safe.
class ORTUNG_API EmulatedLines : public EmulatedDevice {
 public:
  /// @param features features that it measures, borrowed during the call
  /// @param baud speed of its line [bit/s]; nothing: a socket
  explicit EmulatedLines(std::span<const SensorData* const> features,
                         std::optional<int> baud = std::nullopt);
  void receive(std::string_view, Timestamp) override {}
  void sense(const Message& reading, Timestamp now) override;
  bool isMeasuring() const override { return true; }
  std::optional<int> baud() const override { return baud_; }

 private:
  std::vector<SensorId> features_;  ///< features that it measures
  std::optional<int> baud_;         ///< speed of its line [bit/s]
};

}  // namespace ortung
