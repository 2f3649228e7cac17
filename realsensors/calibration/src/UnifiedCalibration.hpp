#pragma once

#include "BoardFit.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/camera/CameraModel.hpp"

namespace ortung {

struct UnifiedSolution {
  Parameters camera;  ///< what readCamera() reads
  BoardFit fit;
};

/// See calibrateByBoards(). @throws std::runtime_error
UnifiedSolution solveUnified(const ImageSize& size, const Board& board,
                             const std::vector<Corners>& corners);

}  // namespace ortung
