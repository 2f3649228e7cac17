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
  int columns = 9;  ///< at least 3, like the rows
  int rows = 6;
};

/// Inner corners in a picture, row by row, to a fraction of a pixel; nothing if the whole board is
/// not there.
ORTUNG_API std::optional<std::vector<Pixel>> findBoard(const ImageView& image,
                                                       const BoardSize& board);

/// What is found out of pictures of a board.
struct BoardCalibration {
  std::shared_ptr<const CameraModel> model;
  std::vector<double> errors;  ///< of each picture: RMS of the corners' distances [px]
  double error = 0.0;          ///< of all [px]
};

enum class BoardModel : std::uint8_t { kPerspective, kFisheye, kUnified, kOcam };

/// The model of a camera that sees its boards where they were found, in the sense of least squares:
/// by OpenCV (Zhang 2000; Kannala and Brandt), kOcam by the linear method of Scaramuzza, Martinelli
/// and Siegwart (IROS 2006) and a refinement of all its parameters, kUnified (Mei and Rives 2007)
/// by a refinement that begins there.
/// @param boards corners of each picture, as findBoard() gives them; at least 3
/// @throws std::runtime_error if they do not determine the model
ORTUNG_API BoardCalibration calibrateByBoards(BoardModel model, const ImageSize& size,
                                              const BoardSize& board,
                                              std::span<const std::vector<Pixel>> boards);

}  // namespace ortung
