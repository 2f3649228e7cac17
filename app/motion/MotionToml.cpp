#include "MotionToml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "TomlText.hpp"

namespace ortung::app {
namespace {

/// Returns the meanings of the keys of [motion], for comments in the file.
const std::map<std::string, std::string>& meanings() {
  static const std::map<std::string, std::string> kMeanings = {
      {"turn_per_turn", "sigma of a turn after turning 1 rad [rad]"},
      {"turn_per_m", "sigma of a turn after driving 1 m [rad]"},
      {"way_per_m", "sigma of a way after driving 1 m [m]"},
      {"way_per_turn", "sigma of a way after turning 1 rad [m]"},
      {"floor_m", "sigma of every step [m]; not learned"},
      {"floor_deg", "sigma of every step [degrees]; not learned"},
      {"slip_share", "share of motions with four times the noise"},
      {"way_scale", "true way of what odometry says"},
      {"turn_scale", "true turn of what odometry says"},
      {"turn_bias_deg_per_m", "added to turns"},
      {"way_bias_m_per_rad", "added to ways in curves"},
      {"delay_s", "odometry is ahead of the robot"}};
  return kMeanings;
}

/// Returns the least value of a key. MCL needs some noise even if a log shows less: its samples are
/// few, its tables have cells, and other logs may have more.
double leastOf(const std::string& key) {
  if (key == "turn_per_turn") return 0.1;
  if (key == "turn_per_m") return 0.05;
  return key == "way_per_m" || key == "way_per_turn" ? 0.02
                                                     : -std::numeric_limits<double>::infinity();
}

/// Returns text without line feeds, which would end a comment.
std::string oneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text;
}

}  // namespace

std::string motionToml(const std::vector<std::string>& sources, const LearnedMotion& result,
                       const Parameters& base, const Parameters& settings) {
  std::string text = "# Learned by `ortung learn-motion` from";
  for (const std::string& source : sources) text += " " + oneLine(source);
  text += fmt::format(":\n# {} pieces of motion, {:.0f} m and {:.0f} rad.\n[motion]\n",
                      result.pairs, result.metres, result.radians);
  text += fmt::format("plugin = {}\n", quotedToml(base.textOr("plugin", "odometry")));
  if (base.has("network_file")) {
    text += fmt::format("network_file = {}\n", quotedToml(base.text("network_file")));
  }
  for (const std::string& key : settings.keys()) {
    const auto meaning = meanings().find(key);
    const double learned = settings.number(key);
    const double value = std::max(learned, leastOf(key));
    std::string comment = meaning == meanings().end() ? "" : meaning->second;
    if (value > learned) comment += fmt::format("; the log says {:.2g}", learned);
    // Four digits are more than any log can determine.
    text +=
        fmt::format("{:<20} = {:#.4g}{}{}\n", key, value, comment.empty() ? "" : "  # ", comment);
  }
  return text;
}

}  // namespace ortung::app
