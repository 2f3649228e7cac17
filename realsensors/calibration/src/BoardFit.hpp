#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

namespace ortung {

using Board = std::vector<cv::Point3f>;    ///< corners in the board's plane [squares]
using Corners = std::vector<cv::Point2f>;  ///< the same corners in a picture [px]

/// Parameters of a lens, and the pose of each board in the camera's frame.
struct BoardFit {
  std::vector<double> lens;             ///< parameters, whose meaning LensOf knows
  std::vector<cv::Vec3d> rotations;     ///< rotation vector of each board [rad]
  std::vector<cv::Vec3d> translations;  ///< place of each board's first corner [squares]
};

/// Projects a point of the camera's frame to its pixel, if it has one; the search for that begins
/// near a given pixel.
using Lens = std::function<std::optional<cv::Point2d>(const cv::Vec3d&, const cv::Point2d& near)>;
/// Makes the lens that has these parameters.
using LensOf = std::function<Lens(std::span<const double>)>;

/// Changes all parameters of a fit so that the sum of the corners' squared reprojection errors is
/// least (Levenberg and Marquardt).
void refine(const Board& board, const std::vector<Corners>& corners, const LensOf& lensOf,
            BoardFit& fit);

}  // namespace ortung
