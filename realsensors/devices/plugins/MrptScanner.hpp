#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ortung/devices/ChildProcess.hpp"
#include "ortung/devices/DeviceDriver.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {

/// A laser scanner behind a driver of MRPT, which runs in a program of its own, ortung-mrpt-device:
/// its hundreds of libraries are not loaded here, and what a damaged telegram does to it, such as
/// writing beyond its buffers, ends that program alone. Then it is started anew.
class MrptScanner : public DeviceDriver {
 public:
  /// @param arguments of the program
  MrptScanner(std::string name, std::vector<std::string> arguments);

  void serve(std::span<const SensorData* const> features) override;
  void open() override;
  void read(std::chrono::milliseconds patience, std::vector<DeviceReading>& readings) override;
  void close() noexcept override { child_.reset(); }
  std::uint64_t refused() const override { return refused_; }
  /// Noise never gives the same scan so often.
  std::size_t repeatsOfFrozen() const override { return 10; }

 private:
  void take(const std::string& line, std::vector<DeviceReading>& readings);
  void matchBeams(double firstAngle, double angleStep, std::size_t beams);

  std::string name_;
  std::vector<std::string> arguments_;
  SensorId id_;
  ScanData::Config scan_;
  std::unique_ptr<ChildProcess> child_;
  std::vector<std::size_t> beams_;  ///< of the scanner, by beam of the feature; empty: not known
  std::size_t given_ = 0;           ///< beams of the scanner
  std::uint64_t refused_ = 0;
};

}  // namespace ortung
