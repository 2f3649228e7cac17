#pragma once

#include <string>

#include "ortung/emulators/EmulatedDevice.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {

/// Returns the checksum of SICK's telegrams (LMS 2xx).
ORTUNG_API std::uint16_t sickChecksum(std::string_view bytes);
/// Returns a telegram: STX, address, length, data, checksum.
/// @param address 0: to the scanner; 0x80: from it
ORTUNG_API std::string sickTelegram(unsigned char address, std::string_view data);

/// A SICK LMS 200 on a serial line: status, modes (installation, monitoring on request and
/// continuous), configuration, angles, speeds, and measured values with their checksum, as of
/// SICK's list of telegrams for the LMS 2xx. It sends a scan when the line is free, so a slow line
/// has fewer of them. Not thread-safe.
class ORTUNG_API EmulatedSick : public EmulatedDevice {
 public:
  /// @param scan feature that it measures, borrowed during the call
  /// @param baud speed after it was switched on: 9600, 38400 or 500000 [bit/s]
  /// @throws std::invalid_argument for a number of beams that no SICK has
  explicit EmulatedSick(const ScanData& scan, int baud = 9600);

  void receive(std::string_view bytes, Timestamp now) override;
  void sense(const Message& reading, Timestamp now) override;
  bool isMeasuring() const override { return isContinuous_; }
  std::optional<int> baud() const override { return baud_; }

 private:
  void execute(std::string_view command, Timestamp now);     ///< answers a command
  void answer(std::string data, Timestamp now);              ///< sends a telegram
  void changeMode(std::string_view command, Timestamp now);  ///< answers a change of mode
  std::size_t beams() const;  ///< number of beams in the current field of view

  SensorId id_;
  double maxRange_;            ///< greatest range of the simulated scanner [m]
  int baud_;                   ///< speed of the line [bit/s]
  std::string bytes_;          ///< bytes of a telegram that is not complete
  std::string settings_;       ///< configuration, 34 bytes
  bool isInstalling_ = false;  ///< whether it is in the mode for changes of its settings
  bool isContinuous_ = false;  ///< whether it sends all scans
  int fieldOfView_ = 180;      ///< field of view [degrees]
  int resolution_ = 100;       ///< angle between beams [1/100 degree]
};

}  // namespace ortung
