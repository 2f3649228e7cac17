#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A device that can't be reached, or is there no more: unplugged, switched off, refused.
class ORTUNG_API DeviceAbsent : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~DeviceAbsent() override;
};

/// Bytes from and to a device: a serial line ("/dev/ttyUSB0", 8 data bits, no parity, no flow
/// control) or a server ("tcp:HOST:PORT"). Nothing waits longer than it is told. Not thread-safe.
class ORTUNG_API Port {
 public:
  /// @param baud speed of a serial line [bit/s]; a server has none
  /// @throws DeviceAbsent naming the port and why it can't be opened; std::invalid_argument for a
  ///   speed that serial lines do not have, and a text that is no port
  static std::unique_ptr<Port> open(const std::string& name, int baud);
  ~Port();
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// Appends what has come, at most @p most bytes, having waited for the first one until
  /// @p patience is over. Returns whether anything came.
  /// @throws DeviceAbsent if the other side is gone
  bool read(std::string& bytes, std::chrono::milliseconds patience, std::size_t most = 4096);
  /// @throws DeviceAbsent if not all of it could be sent within half a second
  void write(std::string_view bytes);

  const std::string& name() const { return name_; }

 private:
  Port(std::string name, int descriptor);
  std::string name_;
  int descriptor_;
};

/// Whether @p baud is a speed that Port can set.
ORTUNG_API bool isLineSpeed(int baud);

}  // namespace ortung
