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
  void execute(const std::string& line, Timestamp now);  ///< answers a command
  void measure(const std::string& line, Timestamp now);  ///< answers a request for scans
  /// Parses a request for scans; nothing if the scanner does not have its steps.
  std::optional<Request> requestOf(const std::string& line) const;
  /// Sends the command, a status of two characters and data, each with its checksum.
  void answer(const std::string& echo, std::string_view status, std::string_view data,
              Timestamp now);
  std::string timeOf(Timestamp now) const;  ///< encodes a time stamp, four characters
  std::string versions() const;             ///< data of the answer to VV
  std::string parameters() const;           ///< data of the answer to PP
  void sendScan(const Request& request, const Message& reading, Timestamp now);

  SensorId id_;
  double maxRange_;                ///< greatest range of the simulated scanner [m]
  int stepsOfTurn_;                ///< number of steps in a turn
  int firstStep_;                  ///< step of the first beam
  int lastStep_;                   ///< step of the last beam
  int frontStep_;                  ///< step of the beam straight ahead
  std::optional<int> baud_;        ///< speed of the line [bit/s]; nothing: a socket
  LineCutter lines_;               ///< commands of the robot's computer
  bool isOn_ = false;              ///< whether the laser is on
  bool measures_ = false;          ///< whether scans are sent
  Request request_;                ///< request for the scans that are sent
  int skipped_ = 0;                ///< number of scans that were skipped since the last one
  std::optional<Message> newest_;  ///< newest scan, for requests of a single one
};

}  // namespace ortung
