#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

namespace ortung {

using Board = std::vector<cv::Point3f>;    ///< its corners, in squares
using Corners = std::vector<cv::Point2f>;  ///< where they are in a picture [px]

/// A camera that looks at boards: its lens, and where each board is.
struct BoardFit {
  std::vector<double> lens;             ///< numbers, whatever they mean
  std::vector<cv::Vec3d> rotations;     ///< of each board, vectors
  std::vector<cv::Vec3d> translations;  ///< in squares
};

/// The pixel that shows a point of the camera's frame, if one does; it is looked for near another.
using Lens = std::function<std::optional<cv::Point2d>(const cv::Vec3d&, const cv::Point2d& near)>;
/// The lens that numbers mean.
using LensOf = std::function<Lens(std::span<const double>)>;

/// Changes all numbers of a fit until corners are seen where they were found, in the sense of least
/// squares (Levenberg and Marquardt).
void refine(const Board& board, const std::vector<Corners>& corners, const LensOf& lensOf,
            BoardFit& fit);

}  // namespace ortung
