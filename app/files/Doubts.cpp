#include "Doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>

#include "ortung/base/Parameters.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::app {
namespace {

/// The values of a key that robots and worlds usually have.
struct Usual {
  std::string_view table;  ///< that the key is in; "": any
  std::string_view key;    ///< its name, or its end if that begins with "_"
  Range range;
  std::string_view what;  ///< how a sentence calls it
};

// The first one that fits a key counts. They are wider than anything that is shipped, and narrower
// than the same values in millimetres, centimetres, radians, grammes or milliseconds.
constexpr std::array kOfRobots = {
    Usual{"robot", "radius_m", {0.02, 3.0}, "a robot's radius"},
    Usual{"robot", "height_m", {0.02, 5.0}, "a robot's height"},
    Usual{"robot", "mass_kg", {0.05, 3000.0}, "a robot's mass"},
    Usual{"drive", "body_height_m", {0.02, 5.0}, "a robot's height"},
    Usual{"drive", "axle_m", {0.02, 4.0}, "the distance of two wheels"},
    Usual{"drive", "wheel_distance_m", {0.02, 4.0}, "the distance of a wheel from the middle"},
    Usual{"drive", "max_turn_deg_s", {10.0, 3000.0}, "the greatest speed of a turn"},
    Usual{"drive", "turn_acceleration_deg_s2", {10.0, 30000.0}, "the acceleration of a turn"},
    Usual{"", "_speed_m_s", {0.0, 40.0}, "a robot's speed"},
    Usual{"", "acceleration_m_s2", {0.02, 60.0}, "a robot's acceleration"},
    Usual{"", "wheel_acceleration_m_s2", {0.02, 99.0}, "a wheel's acceleration"},
    Usual{"sensor", "max_range_m", {0.1, 400.0}, "the greatest range of a sensor"},
    Usual{"sensor", "min_range_m", {0.0, 5.0}, "the least range of a sensor"},
    Usual{"sensor", "fov_deg", {7.0, 360.0}, "a field of view"},
    Usual{"sensor", "opening_deg", {2.0, 120.0}, "the opening angle of a sensor"},
    Usual{"sensor", "angle_step_deg", {0.05, 90.0}, "the step of a scanner"},
    Usual{"sensor", "period_s", {0.0, 60.0}, "the time between two readings"},
    Usual{"pose", "x_m", {-3.0, 3.0}, "a sensor's place on a robot"},
    Usual{"pose", "y_m", {-3.0, 3.0}, "a sensor's place on a robot"},
    Usual{"body", "center_m", {-4.0, 4.0}, "the place of a part of a robot"},
    Usual{"body", "size_m", {0.001, 6.0}, "the size of a part of a robot"},
    Usual{"body", "z_m", {-1.0, 6.0}, "the height of a part of a robot"},
    Usual{"sensor", "_sigma_m", {0.0, 5.0}, "an error"},
};
constexpr std::array kOfWorlds = {
    Usual{"world", "x_m", {-1500.0, 1500.0}, "the edge of a field"},
    Usual{"world", "y_m", {-1500.0, 1500.0}, "the edge of a field"},
    Usual{"", "size_m", {0.001, 2000.0}, "the size of a body"},
    Usual{"", "center_m", {-1500.0, 1500.0}, "the place of a body"},
    Usual{"", "corners_m", {-1500.0, 1500.0}, "a corner of a body"},
    Usual{"", "position_m", {-1500.0, 1500.0}, "a place"},
    Usual{"", "z_m", {-20.0, 100.0}, "the height of a body"},
    Usual{"", "mass_kg", {0.001, 5000.0}, "the mass of a body"},
};
constexpr std::array kOfScenes = {
    Usual{"start", "x_m", {-1500.0, 1500.0}, "a start"},
    Usual{"start", "y_m", {-1500.0, 1500.0}, "a start"},
    Usual{"", "waypoints_m", {-1500.0, 1500.0}, "a place"},
    Usual{"", "translational_m_s", {-40.0, 40.0}, "a robot's speed"},
};

/// The unit at the end of a key, and what a sentence says of it. Longer ends come first.
struct Unit {
  std::string_view end;
  std::string_view sign;
  std::string_view sentence;
};
constexpr std::array kUnits = {Unit{"_deg_s2", "deg/s^2", "angles are degrees"},
                               Unit{"_deg_s", "deg/s", "angles are degrees"},
                               Unit{"_deg", "deg", "angles are degrees"},
                               Unit{"_m_s2", "m/s^2", "lengths are metres"},
                               Unit{"_m_s", "m/s", "lengths are metres"},
                               Unit{"_kg", "kg", "masses are kilogrammes"},
                               Unit{"_m", "m", "lengths are metres"},
                               Unit{"_s", "s", "times are seconds"}};

/// Keys of directions and openings. Errors and steps may well be 1.57 degrees.
constexpr std::array<std::string_view, 13> kAngles = {
    "angle_deg", "angles_deg",  "arc_deg",         "direction_deg", "first_angle_deg",
    "fov_deg",   "heading_deg", "north_deg",       "opening_deg",   "roll_deg",
    "theta_deg", "tilt_deg",    "wheel_angles_deg"};

/// Returns the degrees of a multiple of pi / 12 that is written with two decimals or more, as 1.57
/// or 3.14159; nothing for other numbers.
std::optional<double> degreesWrittenAsRadians(double value) {
  const double magnitude = std::abs(value);
  const double twelfths = std::round(12.0 * magnitude / std::numbers::pi);
  if (twelfths < 1.0 || twelfths > 24.0) return std::nullopt;
  double power = 100.0;
  for (int decimals = 2; decimals <= 12; ++decimals, power *= 10.0) {
    const double rounded = std::round(twelfths * std::numbers::pi / 12.0 * power);
    const double digits = magnitude * power;
    if (std::abs(digits - rounded) > 1e-3) continue;
    const bool hasFewer = std::fmod(rounded, 10.0) == 0.0 && decimals == 2;  // 2.1, 5.5
    if (!hasFewer) return std::copysign(15.0 * twelfths, value);
  }
  return std::nullopt;
}

/// Returns what a reader gives, or nothing if the key holds something else.
template <class Read>
auto ifIs(const Read& read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const ConfigError&) {
    return std::nullopt;
  }
}

/// Goes through the tables of a file.
class Search {
 public:
  explicit Search(std::span<const Usual> usual) : usual_(usual) {}

  void lookAt(const Parameters& table, const std::string& name) {
    for (const std::string& key : table.keys()) {
      if (const auto number = ifIs([&] { return table.number(key); }))
        judge(table, name, key, {*number});
      else if (const auto numbers = ifIs([&] { return table.numbers(key); }))
        judge(table, name, key, *numbers);
      else if (const auto below = ifIs([&] { return table.table(key); }))
        lookAt(*below, key);
      else if (const auto all = ifIs([&] { return table.tables(key); }))
        for (const Parameters& one : *all) lookAt(one, key);
    }
  }
  std::vector<std::string> found;

 private:
  void judge(const Parameters& table, const std::string& name, const std::string& key,
             const std::vector<double>& numbers) {
    const auto unit = std::find_if(kUnits.begin(), kUnits.end(),
                                   [&](const Unit& one) { return key.ends_with(one.end); });
    if (unit == kUnits.end()) return;
    for (const double value : numbers) {
      const std::string doubt = doubtOf(name, key, value, *unit);
      if (doubt.empty()) continue;
      note(table, key, doubt);
      return;
    }
  }
  std::string doubtOf(const std::string& name, const std::string& key, double value,
                      const Unit& unit) const {
    const bool isAngle = std::find(kAngles.begin(), kAngles.end(), key) != kAngles.end();
    if (const auto meant = isAngle ? degreesWrittenAsRadians(value) : std::nullopt)
      return fmt::format("is {:g}, which looks like radians and would be {:g} degrees; {}", value,
                         *meant, unit.sentence);
    const auto usual = std::find_if(usual_.begin(), usual_.end(), [&](const Usual& one) {
      return (one.table.empty() || one.table == name) &&
             (one.key.starts_with('_') ? key.ends_with(one.key) : key == one.key);
    });
    if (usual == usual_.end() || (value >= usual->range.low && value <= usual->range.high))
      return "";
    return fmt::format("is {:g} {}: {} is usually {:g} to {:g} {}; {}", value, unit.sign,
                       usual->what, usual->range.low, usual->range.high, unit.sign, unit.sentence);
  }
  /// Adds a doubt with the place of the key, which errors name.
  void note(const Parameters& table, const std::string& key, const std::string& doubt) {
    try {
      table.fail(key, doubt);
    } catch (const ConfigError& error) {
      found.emplace_back(error.what());
    }
  }

  std::span<const Usual> usual_;
};

}  // namespace

std::vector<std::string> doubtsOf(const std::filesystem::path& file, FileKind kind) {
  std::span<const Usual> usual;
  if (kind == FileKind::kRobot) usual = kOfRobots;
  if (kind == FileKind::kWorld) usual = kOfWorlds;
  if (kind == FileKind::kScene) usual = kOfScenes;
  if (usual.empty()) return {};
  Search search(usual);
  search.lookAt(readToml(file), "");
  return search.found;
}

}  // namespace ortung::app
