#pragma once

#include "BoardFit.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/camera/CameraModel.hpp"

namespace ortung {

/// Settings of a unified camera model (Mei and Rives), and the fit that led to them.
struct UnifiedSolution {
  Parameters camera;  ///< settings as readCamera() reads them
  BoardFit fit;
};

/// See calibrateByBoards(). @throws std::runtime_error
UnifiedSolution solveUnified(const ImageSize& size, const Board& board,
                             const std::vector<Corners>& corners);

}  // namespace ortung
