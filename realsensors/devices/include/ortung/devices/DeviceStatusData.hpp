#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/devices/DeviceHealth.hpp"

namespace ortung {

/// How a device is, as a feature for clients: device/status/NAME. Words: [state as in DeviceState,
/// readings, rate 1/1000 a second, age ms, refused, repeated, flooded, late, clock jumps]; an age
/// of 4294967295: there was no reading. Not thread-safe, see SensorData.
class ORTUNG_API DeviceStatusData : public SensorData {
 public:
  /// @param number from 0, the device's place in the robot file
  DeviceStatusData(std::size_t number, const std::string& plugin);
  ~DeviceStatusData() override;
  static SensorId idOf(std::size_t number, const std::string& plugin);
  static Message message(const SensorId& id, Timestamp now, const DeviceStatus& status);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
};

}  // namespace ortung
