#include "ortung/calibration/BoardCalibration.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "OcamCalibration.hpp"
#include "UnifiedCalibration.hpp"
#include "ortung/base/Parameters.hpp"

namespace ortung {
namespace {

/// A model's settings, and the pose of each board in the camera's frame.
struct Solution {
  Parameters camera{"the calibration"};
  std::vector<cv::Vec3d> rotations;  ///< rotation vectors [rad]
  std::vector<cv::Vec3d> translations;
};

std::vector<double> numbers(const cv::Mat& matrix) {
  const cv::Mat flat = cv::Mat_<double>(matrix.reshape(1, 1));
  return {flat.begin<double>(), flat.end<double>()};
}

void setLens(Parameters& camera, const cv::Mat& k, const cv::Mat& distortion) {
  camera.set("focal_px", std::vector<double>{k.at<double>(0, 0), k.at<double>(1, 1)});
  camera.set("centre_px", std::vector<double>{k.at<double>(0, 2), k.at<double>(1, 2)});
  camera.set("distortion", numbers(distortion));
}

Solution perspective(const cv::Size& size, const std::vector<Board>& points,
                     const std::vector<Corners>& corners) {
  Solution s;
  cv::Mat k;
  cv::Mat distortion;
  cv::calibrateCamera(points, corners, size, k, distortion, s.rotations, s.translations);
  s.camera.set("model", "perspective");
  setLens(s.camera, k, distortion);
  return s;
}

Solution fisheye(const cv::Size& size, const std::vector<Board>& points,
                 const std::vector<Corners>& corners) {
  Solution s;
  cv::Mat k;
  cv::Mat distortion;
  constexpr int kFlags = cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW;
  cv::fisheye::calibrate(points, corners, size, k, distortion, s.rotations, s.translations, kFlags,
                         {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-10});
  s.camera.set("model", "fisheye");
  setLens(s.camera, k, distortion);
  return s;
}

Solution unified(const ImageSize& size, const Board& board, const std::vector<Corners>& corners) {
  UnifiedSolution found = solveUnified(size, board, corners);
  return {std::move(found.camera), std::move(found.fit.rotations),
          std::move(found.fit.translations)};
}

Solution ocam(const cv::Size& size, const Board& board, const std::vector<Corners>& corners) {
  OcamSolution found = solveOcam(size, board, corners);
  Solution s;
  s.camera.set("model", "ocam");
  s.camera.set("centre_px", std::vector<double>{found.centre.x, found.centre.y});
  s.camera.set("polynomial", found.polynomial);
  s.rotations = std::move(found.rotations);
  s.translations = std::move(found.translations);
  return s;
}

Board cornersOf(const BoardSize& board) {
  Board points;
  for (int row = 0; row < board.rows; ++row)
    for (int column = 0; column < board.columns; ++column)
      points.emplace_back(static_cast<float>(column), static_cast<float>(row), 0.0F);
  return points;
}

/// Returns the sum of the corners' squared reprojection errors [px^2].
double squaredErrors(const CameraModel& model, const Board& board, const Corners& corners,
                     const cv::Vec3d& rotation, const cv::Vec3d& translation) {
  cv::Matx33d turn;
  cv::Rodrigues(rotation, turn);
  double sum = 0.0;
  for (std::size_t i = 0; i < board.size(); ++i) {
    const cv::Vec3d p = turn * cv::Vec3d(board[i].x, board[i].y, 0.0) + translation;
    const auto pixel = model.project({p[0], p[1], p[2]});
    if (!pixel)
      throw std::runtime_error("a board is outside the field of view of the fitted model");
    sum += std::pow(pixel->u - corners[i].x, 2) + std::pow(pixel->v - corners[i].y, 2);
  }
  return sum;
}

Solution solve(BoardModel model, const cv::Size& size, const Board& board,
               const std::vector<Corners>& corners) {
  const std::vector<Board> points(corners.size(), board);
  switch (model) {
    case BoardModel::kPerspective:
      return perspective(size, points, corners);
    case BoardModel::kFisheye:
      return fisheye(size, points, corners);
    case BoardModel::kUnified:
      return unified({size.width, size.height}, board, corners);
    case BoardModel::kOcam:
      break;
  }
  return ocam(size, board, corners);
}

/// Returns the least distance between two consecutive corners [px].
double nearest(const std::vector<cv::Point2f>& corners) {
  double least = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i)
    least = std::min(least, cv::norm(corners[i] - corners[i - 1]));
  return least;
}

}  // namespace

std::optional<std::vector<Pixel>> findBoard(const ImageView& image, const BoardSize& board) {
  const cv::Mat picture(image.size.height, image.size.width,
                        image.channels() == 3 ? CV_8UC3 : CV_8UC1,
                        const_cast<std::uint8_t*>(image.pixels));  // it is only read
  cv::Mat grey = picture;
  if (image.channels() == 3) cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
  std::vector<cv::Point2f> corners;
  const cv::Size size(board.columns, board.rows);
  if (!cv::findChessboardCornersSB(grey, size, corners, cv::CALIB_CB_ACCURACY) &&
      !cv::findChessboardCorners(grey, size, corners))
    return std::nullopt;
  // Distortion curves the squares' edges, so only pixels close to a corner are used to locate it.
  const int window = std::clamp(static_cast<int>(nearest(corners) / 3.0), 2, 5);
  cv::cornerSubPix(grey, corners, {window, window}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-4});
  std::vector<Pixel> pixels;
  for (const cv::Point2f& corner : corners) pixels.push_back({corner.x, corner.y});
  return pixels;
}

BoardCalibration calibrateByBoards(BoardModel model, const ImageSize& size, const BoardSize& board,
                                   std::span<const std::vector<Pixel>> boards) {
  const Board points = cornersOf(board);
  if (boards.size() < 3)
    throw std::runtime_error("found " + std::to_string(boards.size()) +
                             " pictures of the board, expected 3 or more");
  std::vector<Corners> corners(boards.size());
  for (std::size_t i = 0; i < boards.size(); ++i) {
    if (boards[i].size() != points.size())
      throw std::invalid_argument("a board has another number of corners");
    for (const Pixel& pixel : boards[i])
      corners[i].emplace_back(static_cast<float>(pixel.u), static_cast<float>(pixel.v));
  }
  Solution solution;
  try {
    solution = solve(model, {size.width, size.height}, points, corners);
  } catch (const cv::Exception& error) {
    throw std::runtime_error("these boards do not determine the model: " + error.err);
  }
  solution.camera.set("size_px", std::vector<double>{static_cast<double>(size.width),
                                                     static_cast<double>(size.height)});
  BoardCalibration found;
  found.model = readCamera(solution.camera);
  double all = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double sum = squaredErrors(*found.model, points, corners[i], solution.rotations[i],
                                     solution.translations[i]);
    found.errors.push_back(std::sqrt(sum / static_cast<double>(points.size())));
    all += sum;
  }
  found.error = std::sqrt(all / static_cast<double>(points.size() * corners.size()));
  return found;
}

}  // namespace ortung
