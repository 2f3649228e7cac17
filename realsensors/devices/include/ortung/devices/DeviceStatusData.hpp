#pragma once

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/devices/DeviceHealth.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// The status of a device as a feature for clients: device/status/NAME. Words: [state as in
/// DeviceState, readings, rate 1/1000 a second, age ms, refused, repeated, flooded, late, clock
/// jumps]; an age of 4294967295: there was no reading. Not thread-safe, see SensorData.
class ORTUNG_API DeviceStatusData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kDevice;
  /// @param number the device's place in the robot file, from 0
  /// @param plugin name of the driver's plugin
  DeviceStatusData(std::size_t number, const std::string& plugin);
  ~DeviceStatusData() override;
  /// Returns the feature's name.
  static SensorId idOf(std::size_t number, const std::string& plugin);
  /// Returns the status as a reading.
  static Message message(const SensorId& id, Timestamp now, const DeviceStatus& status);
  Format format() const override;
  /// Describes the words for users.
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
};

}  // namespace ortung
