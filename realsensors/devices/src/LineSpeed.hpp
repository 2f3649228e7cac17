#pragma once

#include <termios.h>

#include <array>
#include <optional>

namespace ortung {

/// A speed of a serial line, and its code in termios.
struct LineSpeed {
  int baud;      ///< speed [bit/s]
  speed_t code;  ///< constant of termios
};

/// The speeds that serial lines have.
inline constexpr std::array kLineSpeeds{
    LineSpeed{1200, B1200},      LineSpeed{2400, B2400},     LineSpeed{4800, B4800},
    LineSpeed{9600, B9600},      LineSpeed{19200, B19200},   LineSpeed{38400, B38400},
    LineSpeed{57600, B57600},    LineSpeed{115200, B115200}, LineSpeed{230400, B230400},
    LineSpeed{460800, B460800},  LineSpeed{500000, B500000}, LineSpeed{921600, B921600},
    LineSpeed{1000000, B1000000}};

/// Returns the code of a speed [bit/s], or nothing.
inline std::optional<speed_t> codeOf(int baud) {
  for (const LineSpeed& speed : kLineSpeeds)
    if (speed.baud == baud) return speed.code;
  return std::nullopt;
}

}  // namespace ortung
