#include "ortung/realsensors/Scanner.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "ortung/base/Angles.hpp"
#include "ortung/core/SourceOptions.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung {
namespace {

constexpr double kUsefulRange = 30.0;  // [m]; beyond, old SICK scanners see little, inaccurately
constexpr int kMaxBeams = 8192;

/// Rounds to millionths of a degree: logs have no more digits.
double shortDegrees(double radians) { return std::round(degrees(radians) * 1e6) / 1e6; }

}  // namespace

ScannerOptions::ScannerOptions(const Parameters& options)
    : x_(optionNumber(options, "laser_x", {-kFarMount, kFarMount})),
      y_(optionNumber(options, "laser_y", {-kFarMount, kFarMount})),
      yaw_(optionNumber(options, "laser_yaw_deg", {-360, 360})),
      maxRange_(optionNumber(options, "max_range_m", {0.1, 1000})) {}

Scanner ScannerOptions::apply(Scanner scanner, const std::string& where) const {
  if (scanner.beams < 1 || scanner.beams > kMaxBeams) {
    throw std::runtime_error(where + ": found " + std::to_string(scanner.beams) +
                             " beams, expected 1 to " + std::to_string(kMaxBeams));
  }
  const double sweep = scanner.angleStep * scanner.beams;
  if (!(scanner.angleStep > 0) || !(sweep < kTurn + 1e-3) ||
      !(std::abs(scanner.firstAngle) <= kTurn)) {
    throw std::runtime_error(where + ": found " + std::to_string(scanner.beams) +
                             " beams that begin at " + tomlNumber(scanner.firstAngle) + " rad, " +
                             tomlNumber(scanner.angleStep) +
                             " rad apart, expected a positive step, and a turn at most");
  }
  scanner.angleStep = std::min(scanner.angleStep, kTurn / scanner.beams);  // rounded in the log
  if (x_) scanner.mount.x = *x_;
  if (y_) scanner.mount.y = *y_;
  if (!(std::abs(scanner.mount.x) <= kFarMount && std::abs(scanner.mount.y) <= kFarMount))
    throw std::runtime_error(where + ": found a scanner at " + tomlNumber(scanner.mount.x) + ", " +
                             tomlNumber(scanner.mount.y) +
                             " m, expected one within 10 m of the robot's origin; the options "
                             "laser_x and laser_y set where it is");
  if (yaw_) scanner.mount.theta = wrapAngle(radians(*yaw_));
  const double range = std::clamp(scanner.maxRange.value_or(kUsefulRange), 0.1, kUsefulRange);
  scanner.maxRange = maxRange_.value_or(range);
  return scanner;
}

std::vector<SourceOption> withScannerOptions(std::vector<SourceOption> options) {
  options.push_back({"laser_x", "m", "the log's", "place of the laser on the robot's x axis"});
  options.push_back({"laser_y", "m", "the log's", "place of the laser on the robot's y axis"});
  options.push_back({"laser_yaw_deg", "deg", "the log's", "direction of the laser's x axis"});
  options.push_back({"max_range_m", "m", "the log's, at most 30",
                     "ranges from here on mean that nothing was seen"});
  return options;
}

double medianPeriod(const std::vector<Timestamp>& stamps) {
  std::vector<Timestamp> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i) steps.push_back(stamps[i] - stamps[i - 1]);
  if (steps.empty()) return 1.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return toSeconds(*middle);
}

std::string robotHead(const std::string& path) {
  std::filesystem::path file = std::filesystem::path(path).lexically_normal();
  if (!file.has_filename()) file = file.parent_path();
  const std::string name = file.stem().string();
  return "[robot]\nname = " + tomlText(name.empty() ? "robot" : name) +
         "\nradius_m = 0.15  # small: maps that were made of scans contain people\n"
         "\n[[sensor]]\nplugin = \"odometry\"\n";
}

std::string scannerToml(const Scanner& scanner, double period, const SensorId& id) {
  const double step = std::min(shortDegrees(scanner.angleStep), 360.0 / scanner.beams);
  return "\n[[sensor]]\nplugin = \"lrf\"\nmodel = " + tomlText(id.model) +
         "\ntype = " + tomlText(id.type) + "\nfeature = " + tomlText(id.feature) +
         "\npose = { x_m = " + tomlNumber(scanner.mount.x) +
         ", y_m = " + tomlNumber(scanner.mount.y) +
         ", theta_deg = " + tomlNumber(shortDegrees(scanner.mount.theta)) +
         " }\nbeams = " + std::to_string(scanner.beams) +
         "\nfirst_angle_deg = " + tomlNumber(shortDegrees(scanner.firstAngle)) +
         "\nangle_step_deg = " + tomlNumber(step) +
         "\nmax_range_m = " + tomlNumber(*scanner.maxRange) + "\nperiod_s = " + tomlNumber(period) +
         "\n# Buildings are full of things that are not in the map.\n"
         "perception = \"endpoints\"\nsigma_m = 0.05\nsigma_per_m = 0.0\noutliers = 0.2\n";
}

}  // namespace ortung
