#pragma once

#include <array>
#include <cstddef>

namespace ortung {

/// Beams of a scan in the field frame, as many as one loop does at a time: a row of each quantity.
struct BeamRows {
  static constexpr std::size_t kBlock = 64;
  template <class Value>
  using Row = std::array<Value, kBlock>;

  double sensorX = 0.0;  ///< where all of them begin [m]
  double sensorY = 0.0;
  std::size_t size = 0;
  Row<double> range;  ///< [m]
  Row<double> c;      ///< their direction
  Row<double> s;
  Row<double> dx;  ///< from the robot to their ends [m]
  Row<double> dy;
};

}  // namespace ortung
