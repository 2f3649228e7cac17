#pragma once

#include "BoardFit.hpp"

namespace ortung {

/// Parameters of an omnidirectional camera (Scaramuzza), and the pose of each board.
struct OcamSolution {
  cv::Point2d centre;                   ///< image of the optical axis [px]
  std::vector<double> polynomial;       ///< coefficients by powers of the radius [px]; [1] is 0
  std::vector<cv::Vec3d> rotations;     ///< rotation vector of each board [rad]
  std::vector<cv::Vec3d> translations;  ///< place of each board's first corner [squares]
};

/// See calibrateByBoards(). @throws std::runtime_error
OcamSolution solveOcam(const cv::Size& size, const Board& board,
                       const std::vector<Corners>& corners);

}  // namespace ortung
