#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "SensorSettings.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/sim_api/Sensor.hpp"

namespace ortung {

/// The noise of simulated ranges.
struct ScanNoise {
  double sigma = 0.0;          ///< standard deviation at range 0 [m]
  double sigmaPerMetre = 0.0;  ///< growth of the standard deviation with range [m/m]
  double dropoutShare = 0.0;   ///< share of beams without a measurement, in [0, 1]
};

/// Scans a simulated world; the common part of laser range finders. Not thread-safe.
class ScanCaster {
 public:
  ScanCaster(const ScanData::Config& scan, const Mounting& mounting, const ScanNoise& noise)
      : scan_(scan),
        mounting_(mounting),
        noise_(noise),
        ranges_(static_cast<std::size_t>(scan.beams)) {}

  /// Returns the words of a scan. @param random nullptr: without noise, as learning needs it
  std::span<const std::uint32_t> cast(const World& world, const RobotState& robot, Random* random) {
    const Pose2 sensor = robot.pose * mounting_.pose;
    const RayFan fan{.x = sensor.x,
                     .y = sensor.y,
                     .z = mounting_.z,
                     .firstAngle = sensor.theta + scan_.firstAngle,
                     .angleStep = scan_.angleStep,
                     .elevation = 0.0,
                     .maxRange = scan_.maxRange};
    world.castFan(fan, robot.number, ranges_);
    if (random != nullptr)
      for (float& range : ranges_) range = measured(range, *random);
    else
      for (float& range : ranges_) range = expected(range);
    ScanData::encode(ranges_, scan_.maxRange, words_);
    return words_;
  }

  double rays() const { return static_cast<double>(ranges_.size()); }

 private:
  /// Returns the range that is learned. A surface nearer than the sensor can measure is learned at
  /// the smallest range, since a missing direction would leave the whole cell without expectation.
  float expected(float range) const {
    const double smallest = std::max(std::ceil(scan_.minRange * 1000.0), 1.0) / 1000.0;
    return std::max(range, static_cast<float>(smallest));
  }

  float measured(float range, Random& random) const {
    constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();
    if (noise_.dropoutShare > 0.0 && random.uniform() < noise_.dropoutShare) return kInvalid;
    if (range >= scan_.maxRange) return std::numeric_limits<float>::infinity();
    const double sigma = noise_.sigma + noise_.sigmaPerMetre * range;
    const double value = range + sigma * random.gaussian();
    return value < std::max(scan_.minRange, 0.001) ? kInvalid : static_cast<float>(value);
  }

  ScanData::Config scan_;
  Mounting mounting_;
  ScanNoise noise_;
  std::vector<float> ranges_;  ///< ranges of the scan [m]
  std::vector<std::uint32_t> words_;
};

}  // namespace ortung
