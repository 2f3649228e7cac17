#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "ortung/realsensors/Scanner.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// The beams of a scanner's first scan, and how later scans are fitted to them.
class ScanShape {
 public:
  /// @throws std::invalid_argument for beams that no scanner has
  explicit ScanShape(const LaserScan& first);

  /// Returns the ranges of a scan in the first one's beams: those of the nearest beams if it has
  /// others. The order is that of the message. NaN: invalid; +infinity: nothing seen.
  /// @returns empty if the scan covers other angles
  std::vector<float> fit(const LaserScan& scan) const;
  /// Whether every scan so far had the same beams.
  bool isSame(const LaserScan& scan) const;
  /// Returns the scanner, with beams counter-clockwise seen from above.
  /// @param isUpsideDown whether the scanner's z axis points down
  Scanner scanner(bool isUpsideDown) const;
  /// Whether beams run clockwise where the scanner's axis points up.
  bool isClockwise() const { return step_ < 0; }
  const std::string& frame() const { return frame_; }
  double maxRange() const { return maxRange_; }  ///< greatest range [m]; 0: unknown
  /// Returns that as a decimal number, 30 m if it is unknown.
  double usefulRange() const;
  /// Returns the greatest range as the first scan has it, for people.
  const std::string& toldRange() const { return toldRange_; }

 private:
  std::string frame_;
  double first_ = 0.0;     ///< angle of the first beam [rad]
  double step_ = 0.0;      ///< angle between beams [rad], of either sign
  std::size_t told_ = 0;   ///< number of beams of the first scan
  std::size_t beams_ = 0;  ///< number of these beams within a turn
  double maxRange_ = 0.0;
  std::string toldRange_;
};

}  // namespace ortung::ros2
