#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace ortung {

struct OcamSolution {
  cv::Point2d centre;                 ///< [px]
  std::vector<double> polynomial;     ///< of the distance to the centre [px], its second number 0
  std::vector<cv::Mat> rotations;     ///< of each board, vectors
  std::vector<cv::Mat> translations;  ///< in squares
};

/// See calibrateByBoards(). @throws std::runtime_error
OcamSolution solveOcam(const cv::Size& size, const std::vector<cv::Point3f>& board,
                       const std::vector<std::vector<cv::Point2f>>& corners);

}  // namespace ortung
