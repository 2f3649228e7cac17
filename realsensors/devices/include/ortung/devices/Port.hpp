#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A device that can't be reached (any more): unplugged, switched off, refused.
class ORTUNG_API DeviceAbsent : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~DeviceAbsent() override;
};

/// A stream of bytes from and to a device: a serial line ("/dev/ttyUSB0", 8 data bits, no parity,
/// no flow control) or a server ("tcp:HOST:PORT"). All waits are limited. Not thread-safe.
class ORTUNG_API Port {
 public:
  /// Opens a port.
  /// @param baud speed of a serial line [bit/s]; not used for a server
  /// @throws DeviceAbsent naming the port and why it can't be opened; std::invalid_argument for a
  ///   speed that serial lines do not have, and a text that names no port
  static std::unique_ptr<Port> open(const std::string& name, int baud);
  ~Port();
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// Appends the bytes that have come, at most @p most; waits for the first one for at most
  /// @p patience. @return whether any came
  /// @throws DeviceAbsent if the connection is lost
  bool read(std::string& bytes, std::chrono::milliseconds patience, std::size_t most = 4096);
  /// Drops the bytes that have come and were not read.
  void drop();
  /// Sends all bytes. @throws DeviceAbsent if that takes more than half a second
  void write(std::string_view bytes);

  /// The port's name.
  const std::string& name() const { return name_; }

 private:
  Port(std::string name, int descriptor);
  std::string name_;
  int descriptor_;
};

/// Returns whether Port can set a line to this speed [bit/s].
ORTUNG_API bool isLineSpeed(int baud);

}  // namespace ortung
