#include "DeviceTable.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "Console.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/devices/DeviceClock.hpp"

namespace ortung::app {
namespace {

/// Returns the problems of a device in a few words.
std::string troublesOf(const DeviceStatus& device) {
  std::string text = device.reason;
  const std::pair<const char*, std::uint64_t> counts[] = {
      {"refused", device.refused},        {"repeated", device.repeated},
      {"too many", device.flooded},       {"late", device.late},
      {"clock jumps", device.clockJumps}, {"openings", device.openings > 1 ? device.openings : 0}};
  if (device.driftsTooMuch)
    text += fmt::format("{}clock drifts by more than {:.0f} ppm, which is not followed",
                        text.empty() ? "" : ", ", DeviceClock::kMostDriftPpm);
  for (const auto& [what, count] : counts)
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  return text;
}

}  // namespace

std::string deviceTable(const std::vector<DeviceStatus>& devices,
                        const std::optional<PoseEstimate>& estimate,
                        std::optional<double> withoutOdometry) {
  std::string text = fmt::format("{:<32} {:<8} {:>8} {:>8} {:>9} {:>9}  {}\n", "device", "state",
                                 "rate_Hz", "age_ms", "readings", "drift_ppm", "");
  for (const DeviceStatus& one : devices) {
    text += fmt::format(
        "{:<32} {:<8} {:>8.1f} {:>8} {:>9} {:>9}  {}\n", printable(one.name), toText(one.state),
        one.rate, one.age ? fmt::format("{:.0f}", 1000.0 * *one.age) : "-", one.readings,
        one.driftPpm ? fmt::format("{:.0f}", *one.driftPpm) : "-", printable(troublesOf(one)));
  }
  if (!estimate) return text;
  const Pose2& pose = estimate->pose;
  text += fmt::format(
      "pose x {:.2f} m, y {:.2f} m, heading {:.1f} degrees, {}{}\n", pose.x, pose.y,
      degrees(pose.theta), nameOf(estimate->status),
      withoutOdometry ? fmt::format(", without odometry for {:.1f} s", *withoutOdometry) : "");
  return text;
}

}  // namespace ortung::app
