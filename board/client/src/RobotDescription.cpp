#include "ortung/client/RobotDescription.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "Replies.hpp"

namespace ortung {
namespace {

using client::cutWord;
using client::valueOf;

/// A number of the line, or nothing if it is not there.
std::optional<double> numberOf(std::string_view line, std::string_view key) {
  const std::string_view text = valueOf(line, key);
  if (text.empty()) return std::nullopt;
  const auto number = client::numberFrom<double>(text);
  if (!number || !std::isfinite(*number)) throw std::invalid_argument("no number");
  return number;
}

/// The feature that a line's first word names; null if there is none.
RobotDescription::Feature* cutFeature(RobotDescription& robot, std::string_view& rest) {
  const SensorId id = parseSensorId(cutWord(rest));
  const auto feature = std::find_if(robot.features.begin(), robot.features.end(),
                                    [&](const auto& known) { return known.id == id; });
  return feature == robot.features.end() ? nullptr : &*feature;
}

void addFormat(RobotDescription& robot, std::string_view rest) {
  RobotDescription::Feature* const feature = cutFeature(robot, rest);
  const Format format = parseFormat(rest);
  if (feature != nullptr) feature->format = format;
}

void addMount(RobotDescription& robot, std::string_view rest) {
  RobotDescription::Feature* const feature = cutFeature(robot, rest);
  const auto x = numberOf(rest, "x_m");
  const auto y = numberOf(rest, "y_m");
  const auto theta = numberOf(rest, "theta_rad");
  if (feature != nullptr && x && y && theta) feature->mount = Pose2{*x, *y, *theta};
}

void addManipulator(RobotDescription& robot, std::string_view rest) {
  RobotDescription::Manipulator manipulator{std::string(cutWord(rest)), {}};
  while (!rest.empty()) manipulator.states.emplace_back(cutWord(rest));
  robot.manipulators.push_back(std::move(manipulator));
}

void addLine(RobotDescription& robot, std::string_view line) {
  std::string_view rest = line;
  const std::string_view kind = cutWord(rest);
  if (kind.find('/') != kind.npos) {
    robot.features.push_back({parseSensorId(kind), std::string(rest), std::nullopt});
  } else if (kind == "mount") {
    addMount(robot, rest);
  } else if (kind == "format") {
    addFormat(robot, rest);
  } else if (kind == "drive") {
    robot.motion = rest;
  } else if (kind == "motion") {
    robot.motionKind = valueOf(rest, "kind");
  } else if (kind == "limits") {
    robot.maxTranslationalVelocity = numberOf(rest, "v_m_s");
    robot.maxRotationalVelocity = numberOf(rest, "w_rad_s");
    robot.maxTranslationalAcceleration = numberOf(rest, "a_m_s2");
    robot.maxRotationalAcceleration = numberOf(rest, "alpha_rad_s2");
  } else if (kind == "body") {
    robot.radius = numberOf(rest, "radius_m");
    robot.height = numberOf(rest, "height_m");
    robot.mass = numberOf(rest, "mass_kg");
  } else if (kind == "manipulator") {
    addManipulator(robot, rest);
  }
}

}  // namespace

const RobotDescription::Feature* RobotDescription::find(const SensorQuery& query) const {
  const auto feature = std::find_if(features.begin(), features.end(),
                                    [&](const Feature& f) { return matches(query, f.id); });
  return feature == features.end() ? nullptr : &*feature;
}

RobotDescription parseRobotDescription(const std::vector<std::string>& lines) {
  RobotDescription robot;
  for (const std::string& line : lines) {
    try {
      addLine(robot, line);
    } catch (const std::invalid_argument&) {
      throw std::invalid_argument(line);
    }
  }
  return robot;
}

}  // namespace ortung
