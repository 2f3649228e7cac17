#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// Pose in the odometry frame and velocities (paper, section 4). Words: x, y [signed mm],
/// [angle], translational velocity [signed mm/s], rotational velocity [signed 1/100 degree/s],
/// then up to 16 of the motion plugin's own. A robot that moves sideways adds two more at the end:
/// kLateralFollows and its lateral velocity [signed mm/s]. One that does not leaves them out, so
/// its words are those of all earlier versions, which had no lateral velocity.
/// Not thread-safe, see SensorData.
class ORTUNG_API OdometryData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kOdometry;
  /// Word that stands before the lateral velocity. As a velocity it would be 2147 km/s.
  static constexpr std::uint32_t kLateralFollows = 4294967295U;
  struct Reading {
    Pose2 pose;                             ///< pose in the odometry frame
    double translationalVelocity = 0.0;     ///< velocity along the robot's x axis [m/s]
    double rotationalVelocity = 0.0;        ///< turn rate, counter-clockwise [rad/s]
    std::vector<std::uint32_t> motionData;  ///< words of the motion plugin's own, at most 16
    double lateralVelocity = 0.0;  ///< velocity along the robot's y axis, to the left [m/s]
  };
  explicit OdometryData(SensorId id);
  ~OdometryData() override;
  const Reading& reading() const { return reading_; }
  static std::vector<std::uint32_t> encode(const Reading& reading);
  static void encode(const Reading& reading, std::vector<std::uint32_t>& words);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Reading reading_;
};

}  // namespace ortung
