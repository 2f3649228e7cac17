#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/CameraModel.hpp"
#include "ortung/camera/ImageData.hpp"

namespace ortung {

/// Inner corners of a chessboard: where four of its squares meet.
struct BoardSize {
  int columns = 9;  ///< inner corners in a row, at least 3
  int rows = 6;     ///< inner corners in a column, at least 3
};

/// Finds the inner corners in a picture (grey or RGB), row by row, to a fraction of a pixel.
/// @return columns * rows corners [px], or nothing if the picture does not show the whole board
ORTUNG_API std::optional<std::vector<Pixel>> findBoard(const ImageView& image,
                                                       const BoardSize& board);

/// The result of a calibration by pictures of a board.
struct BoardCalibration {
  std::shared_ptr<const CameraModel> model;  ///< the camera model that fits best
  std::vector<double> errors;                ///< RMS reprojection error of each picture [px]
  double error = 0.0;                        ///< RMS reprojection error of all pictures [px]
};

/// The camera models that calibrateByBoards() can fit.
enum class BoardModel : std::uint8_t { kPerspective, kFisheye, kUnified, kOcam };

/// Fits a camera model that minimizes the squared reprojection errors of the boards: kPerspective
/// and kFisheye by OpenCV (Zhang 2000; Kannala and Brandt), kOcam by the linear method of
/// Scaramuzza, Martinelli and Siegwart (IROS 2006) and a refinement of all its parameters, kUnified
/// (Mei and Rives 2007) by a refinement that begins there.
/// @param size  size of the pictures [px]
/// @param boards corners of each picture [px], as findBoard() returns them; at least 3 pictures
/// @throws std::invalid_argument if a picture has another number of corners than the board
/// @throws std::runtime_error if the pictures do not determine the model
ORTUNG_API BoardCalibration calibrateByBoards(BoardModel model, const ImageSize& size,
                                              const BoardSize& board,
                                              std::span<const std::vector<Pixel>> boards);

}  // namespace ortung
