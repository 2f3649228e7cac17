#pragma once

#include <functional>
#include <span>
#include <vector>

#include "ortung/devices/BaseLines.hpp"
#include "ortung/emulators/EmulatedDevice.hpp"

namespace ortung {

/// A base with wheels and sonars that speaks BaseLines. It measures from the beginning, whether
/// anybody listens or not. Not thread-safe.
class ORTUNG_API EmulatedBase : public EmulatedDevice {
 public:
  /// @param features sonars in the order of their numbers, and odometry; borrowed
  /// @throws std::invalid_argument for other features
  EmulatedBase(std::span<const SensorData* const> features, int baud);

  void receive(std::string_view bytes, Timestamp now) override;
  void sense(const Message& reading, Timestamp now) override;
  bool isMeasuring() const override { return wasAsked_; }
  std::optional<int> baud() const override { return baud_; }
  /// The newest command; nothing before the first one, and half a second after the last one.
  std::optional<base_lines::Velocity> command(Timestamp now) const;

 private:
  struct Sonar {
    SensorId id;
    double maxRange;
  };
  std::uint32_t timeOf(Timestamp now) const;
  std::vector<Sonar> sonars_;
  std::optional<SensorId> odometry_;
  int baud_;
  LineCutter lines_;
  bool wasAsked_ = false;
  base_lines::Velocity velocity_;
  std::optional<Timestamp> toldAt_;
};

}  // namespace ortung
