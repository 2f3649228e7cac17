#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// The line protocol of a base with wheels and sonars: ASCII, one telegram a line, "$" + telegram
/// + "*" + four capital hexadecimal digits + "\r\n". The digits are the CRC-16/CCITT-FALSE
/// (polynomial 0x1021, start 0xFFFF) of the characters between "$" and "*". Numbers are whole and
/// decimal, separated by commas. docs/real-robot.md describes the protocol for authors of firmware.
namespace base_lines {

inline constexpr std::size_t kLongest = 512;    ///< greatest length of a line [bytes]
inline constexpr std::size_t kMostSonars = 64;  ///< greatest number of sonars of a base

/// "O,t_ms,x_mm,y_mm,heading_cdeg,v_mm_s,w_cdeg_s,lateral_mm_s[,motion data...]"
struct Odometry {
  std::uint32_t time = 0;              ///< time by the base's clock, modulo 2^32 [ms]
  Pose2 pose = {};                     ///< pose relative to where the base was switched on [m, rad]
  double translationalVelocity = 0.0;  ///< forward velocity [m/s]
  double rotationalVelocity = 0.0;     ///< counter-clockwise [rad/s]
  double lateralVelocity = 0.0;        ///< velocity to the left [m/s]
  std::vector<std::uint32_t> motionData;  ///< motion data, see OdometryData; at most 16 words
};

/// "S,t_ms,first,mm,mm,...": echoes of the sonars number `first`, first + 1, ...; 0: no echo.
struct Sonars {
  std::uint32_t time = 0;             ///< time by the base's clock [ms]
  std::size_t first = 0;              ///< number of the first echo's sonar, from 0
  std::vector<std::uint32_t> echoes;  ///< distances [mm]; 0: no echo
};

/// "I,version,sonars": what the base is; the answer to "?I".
struct Identity {
  std::uint32_t version = 1;  ///< version of the protocol
  std::size_t sonars = 0;     ///< number of sonars, at most kMostSonars
};

/// "V,v_mm_s,w_cdeg_s": a command of the robot's computer, sent at least four times a second; the
/// base stops half a second after the last one.
struct Velocity {
  double translational = 0.0;  ///< forward velocity [m/s]
  double rotational = 0.0;     ///< counter-clockwise [rad/s]
};

/// "?I": the request for an Identity.
struct Question {};

using Telegram = std::variant<Odometry, Sonars, Identity, Velocity, Question>;

/// Formats a telegram, with "$", checksum and end of line.
ORTUNG_API std::string encode(const Telegram& telegram);
/// Parses a telegram; never throws.
/// @param line line without its end; the telegram begins at its last "$"
/// @return nothing unless it is a telegram with the right checksum
ORTUNG_API std::optional<Telegram> decode(std::string_view line);

}  // namespace base_lines

/// Cuts a stream of bytes into lines. A line that is too long is dropped up to its end. Not
/// thread-safe.
class ORTUNG_API LineCutter {
 public:
  /// @param longest greatest length of a line [bytes]
  explicit LineCutter(std::size_t longest) : longest_(longest) {}
  /// Appends bytes of the stream, cut anywhere.
  void add(std::string_view bytes);
  /// Takes the next whole line, without its end ("\n" or "\r\n"), or nothing.
  std::optional<std::string> next();
  std::uint64_t refused() const { return refused_; }  ///< number of lines that were too long
  /// Drops the bytes that were not taken.
  void clear();

 private:
  std::size_t longest_;
  std::string bytes_;
  std::size_t begin_ = 0;
  bool isSkipping_ = false;
  std::uint64_t refused_ = 0;
};

}  // namespace ortung
