#pragma once

#include <string>

#include "ortung/devices/BaseLines.hpp"
#include "ortung/emulators/EmulatedDevice.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {

/// A Hokuyo scanner that speaks SCIP 2.0 over a serial line or a socket: VV, PP, II, BM, QT, RS,
/// RT, SS, TM, CR, HS, MD, MS, GD, GS with their checksums, and the stamps of its own clock, which
/// has 24 bits of milliseconds. Its steps are the beams of what it measures. Not thread-safe.
class ORTUNG_API EmulatedHokuyo : public EmulatedDevice {
 public:
  /// @param scan what it measures, borrowed until this returns; the angle between beams divides a
  ///   turn. @throws std::invalid_argument if it does not
  /// @param baud its speed after it was switched on; nothing: a socket
  explicit EmulatedHokuyo(const ScanData& scan, std::optional<int> baud = std::nullopt);

  void receive(std::string_view bytes, Timestamp now) override;
  void sense(const Message& reading, Timestamp now) override;
  bool isMeasuring() const override { return measures_; }
  std::optional<int> baud() const override { return baud_; }

 private:
  struct Request {
    std::string echo;
    int first = 0;  ///< steps
    int last = 0;
    int cluster = 1;
    int skip = 0;          ///< scans between two
    int left = 0;          ///< scans to send; 0: without end
    bool isShort = false;  ///< two characters a range in place of three
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
  double maxRange_;  ///< of the simulated scanner [m]
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
