#include "SensorsText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "Console.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung::app {
namespace {

using Features = std::vector<const SensorData*>;

/// What a feature is good for in a localization.
std::string roleOf(const SensorData& feature) {
  if (feature.localizes()) return "localizes";
  if (feature.id().type == "groundTruth") return "the true pose, for evaluations alone";
  if (feature.format().name() == formats::kOdometry) return "moves the pose between readings";
  return "does not localize";
}

std::string placeOf(const Pose2& mount) {
  return fmt::format("at x {:g} m, y {:g} m, {:g} degrees", mount.x, mount.y, degrees(mount.theta));
}

bool isAt(const Pose2& a, const Pose2& b) { return a.x == b.x && a.y == b.y && a.theta == b.theta; }

/// Where a device sits; the sensors of a ring sit in several places.
std::string placeOf(const Device& device) {
  if (device.data.empty()) return "without features";
  const Pose2& first = device.data.front()->mount();
  const bool isOne = std::all_of(device.data.begin(), device.data.end(),
                                 [&](const auto* one) { return isAt(one->mount(), first); });
  if (isOne) return placeOf(first);
  return fmt::format("{} places, the first {}", device.data.size(), placeOf(first));
}

/// Adds lines of features that have the same role; many get one line.
void addFeatures(const Features& features, std::string& text) {
  constexpr std::size_t kMostLines = 3;
  const std::string role = roleOf(*features.front());
  if (features.size() <= kMostLines) {
    for (const SensorData* one : features)
      text += fmt::format("    {:<40} {}\n", toText(one->id()), role);
    return;
  }
  text += fmt::format(
      "    {:<40} {}\n",
      fmt::format("{} to {}", toText(features.front()->id()), features.back()->id().feature),
      fmt::format("{}; {} features", role, features.size()));
}

void addDevice(const Device& device, std::string& text) {
  const Parameters& settings = device.config->parameters;
  const Features all(device.data.begin(), device.data.end());
  const bool isPlaced =
      std::any_of(all.begin(), all.end(), [](const SensorData* one) { return one->localizes(); }) ||
      settings.has("pose");
  text += fmt::format("  sensor '{}'", printable(device.config->plugin));
  if (isPlaced) text += ", " + placeOf(device);
  if (settings.has("period_s")) text += fmt::format(", every {:g} s", settings.number("period_s"));
  text += "\n";
  for (auto begin = all.begin(); begin != all.end();) {
    const std::string role = roleOf(**begin);
    const auto end =
        std::find_if(begin, all.end(), [&](const SensorData* one) { return roleOf(*one) != role; });
    addFeatures({begin, end}, text);
    begin = end;
  }
}

}  // namespace

std::string describeSensors(const Robot& robot) {
  std::string text =
      fmt::format("  motion '{}'\n", printable(robot.config.motion.textOr("plugin", "odometry")));
  for (const Device& device : robot.devices) addDevice(device, text);
  const auto& all = robot.container.all();
  const auto count = std::count_if(all.begin(), all.end(),
                                   [](const auto& feature) { return feature->localizes(); });
  text += count == 0 ? std::string("  no feature localizes: this robot only follows its odometry\n")
                     : fmt::format("  {} of {} features localize; --wire shows their words\n",
                                   count, all.size());
  return text;
}

}  // namespace ortung::app
