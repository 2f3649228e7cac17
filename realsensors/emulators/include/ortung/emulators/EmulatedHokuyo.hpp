#pragma once

#include <string>

#include "ortung/devices/BaseLines.hpp"
#include "ortung/emulators/EmulatedDevice.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {

/// A Hokuyo scanner that speaks SCIP 2.0 over a serial line or a socket: VV, PP, II, BM, QT, RS,
/// RT, SS, TM, CR, HS, MD, MS, GD, GS with their checksums, and stamps of its own clock, which has
/// 24 bits of milliseconds. Its steps are the beams of the scans. Not thread-safe.
class ORTUNG_API EmulatedHokuyo : public EmulatedDevice {
 public:
  /// @param scan feature that it measures, borrowed during the call; the angle between its beams
  ///   divides a turn, and one beam points straight ahead
  /// @param baud speed after it was switched on [bit/s]; nothing: a socket
  /// @throws std::invalid_argument for other beams
  explicit EmulatedHokuyo(const ScanData& scan, std::optional<int> baud = std::nullopt);

  void receive(std::string_view bytes, Timestamp now) override;
  void sense(const Message& reading, Timestamp now) override;
  bool isMeasuring() const override { return measures_; }
  std::optional<int> baud() const override { return baud_; }

 private:
  struct Request {
    std::string echo;      ///< the command, which answers repeat
    int first = 0;         ///< first step
    int last = 0;          ///< last step
    int cluster = 1;       ///< number of steps for each range
    int skip = 0;          ///< number of scans that are skipped between two
    int left = 0;          ///< number of scans to send; 0: no limit
    bool isShort = false;  ///< whether a range has two characters, not three
  };
  void execute(const std::string& line, Timestamp now);
  void measure(const std::string& line, Timestamp now);
  std::optional<Request> requestOf(const std::string& line) const;
  void answer(const std::string& echo, std::string_view status, std::string_view data,
              Timestamp now);
  std::string timeOf(Timestamp now) const;
  std::string versions() const;
  std::string parameters() const;
  void sendScan(const Request& request, const Message& reading, Timestamp now);

  SensorId id_;
  double maxRange_;  ///< greatest range of the simulated scanner [m]
  int stepsOfTurn_;
  int firstStep_;
  int lastStep_;
  int frontStep_;
  std::optional<int> baud_;
  LineCutter lines_;
  bool isOn_ = false;
  bool measures_ = false;
  Request request_;
  int skipped_ = 0;
  std::optional<Message> newest_;
};

}  // namespace ortung
