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
/// (polynomial 0x1021, start 0xFFFF) of what stands between "$" and "*". Whole decimal numbers,
/// separated by commas. docs/real-robot.md describes it for whoever writes the other side.
namespace base_lines {

inline constexpr std::size_t kLongest = 512;  ///< bytes of a line
inline constexpr std::size_t kMostSonars = 64;

/// "O,t_ms,x_mm,y_mm,heading_cdeg,v_mm_s,w_cdeg_s,lateral_mm_s[,motion data...]"
struct Odometry {
  std::uint32_t time = 0;  ///< of the base's clock, which goes back to 0 after 2^32 [ms]
  Pose2 pose = {};         ///< since the base was switched on [m], [rad]
  double translationalVelocity = 0.0;     ///< [m/s]
  double rotationalVelocity = 0.0;        ///< [rad/s]
  double lateralVelocity = 0.0;           ///< to the left [m/s]
  std::vector<std::uint32_t> motionData;  ///< at most 16
};

/// "S,t_ms,first,mm,mm,...": echoes of the sonars number `first`, first + 1, ...; 0: no echo.
struct Sonars {
  std::uint32_t time = 0;  ///< [ms]
  std::size_t first = 0;
  std::vector<std::uint32_t> echoes;  ///< [mm]; 0: nothing came back
};

/// "I,version,sonars": what the base is; the answer to "?I".
struct Identity {
  std::uint32_t version = 1;
  std::size_t sonars = 0;
};

/// "V,v_mm_s,w_cdeg_s": from the robot's computer, at least four times a second; the base stops
/// when it has heard none for half a second.
struct Velocity {
  double translational = 0.0;  ///< [m/s]
  double rotational = 0.0;     ///< [rad/s]
};

/// "?I": who are you?
struct Question {};

using Telegram = std::variant<Odometry, Sonars, Identity, Velocity, Question>;

/// With "$", checksum and end of line.
ORTUNG_API std::string encode(const Telegram& telegram);
/// @param line without its end; a telegram begins at its last "$". Nothing for anything that is no
/// telegram; never throws.
ORTUNG_API std::optional<Telegram> decode(std::string_view line);

}  // namespace base_lines

/// Cuts lines out of bytes as they come. What is longer than a line may be is thrown away up to the
/// next end of line. Not thread-safe.
class ORTUNG_API LineCutter {
 public:
  explicit LineCutter(std::size_t longest) : longest_(longest) {}
  void add(std::string_view bytes);
  /// The next whole line without its end ("\n" or "\r\n"), or nothing.
  std::optional<std::string> next();
  std::uint64_t refused() const { return refused_; }  ///< lines that were too long
  void clear();

 private:
  std::size_t longest_;
  std::string bytes_;
  std::size_t begin_ = 0;
  bool isSkipping_ = false;
  std::uint64_t refused_ = 0;
};

}  // namespace ortung
