#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "ortung/realsensors/Scanner.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// The beams of a scanner, as its first scan has them, and how later scans fit to them.
class ScanShape {
 public:
  /// @throws std::invalid_argument for beams that no scanner has
  explicit ScanShape(const LaserScan& first);

  /// Ranges of a scan in the first one's beams: those of the nearest beams if it has others. The
  /// order is that of the message. NaN: not valid; +infinity: nothing seen.
  /// @returns empty if it reaches elsewhere
  std::vector<float> fit(const LaserScan& scan) const;
  /// Whether every scan so far had the same beams.
  bool isSame(const LaserScan& scan) const;
  /// As the scanner's axis points up, and the other way round: counter-clockwise seen from above.
  Scanner scanner(bool isUpsideDown) const;
  /// Whether beams run clockwise where the scanner's axis points up.
  bool isClockwise() const { return step_ < 0; }
  const std::string& frame() const { return frame_; }
  double maxRange() const { return maxRange_; }  ///< [m]; 0: the scan does not say it

 private:
  std::string frame_;
  double first_ = 0.0;     ///< [rad]
  double step_ = 0.0;      ///< [rad], of either sign
  std::size_t told_ = 0;   ///< beams of the first scan
  std::size_t beams_ = 0;  ///< of which they are within a turn
  double maxRange_ = 0.0;
};

}  // namespace ortung::ros2
