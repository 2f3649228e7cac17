#pragma once

#include "BoardFit.hpp"

namespace ortung {

struct OcamSolution {
  cv::Point2d centre;                   ///< [px]
  std::vector<double> polynomial;       ///< of the distance to the centre [px], its second number 0
  std::vector<cv::Vec3d> rotations;     ///< of each board, vectors
  std::vector<cv::Vec3d> translations;  ///< in squares
};

/// See calibrateByBoards(). @throws std::runtime_error
OcamSolution solveOcam(const cv::Size& size, const Board& board,
                       const std::vector<Corners>& corners);

}  // namespace ortung
