#include "UnifiedCalibration.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "OcamCalibration.hpp"

namespace ortung {
namespace {

/// Parameters of the lens. xi is a square, so that it can't be negative; the scale is that of the
/// image's middle, focal length / (1 + xi), which the boards determine whatever xi is.
enum Number { kRootOfXi, kScaleU, kScaleV, kCentreU, kCentreV, kDistortion, kNumbers = 9 };

Parameters cameraOf(const ImageSize& size, std::span<const double> lens) {
  const double xi = lens[kRootOfXi] * lens[kRootOfXi];
  Parameters camera("the calibration");
  camera.set("model", "unified");
  camera.set("size_px", std::vector<double>{double(size.width), double(size.height)});
  camera.set("xi", xi);
  camera.set("focal_px",
             std::vector<double>{lens[kScaleU] * (1.0 + xi), lens[kScaleV] * (1.0 + xi)});
  camera.set("centre_px", std::vector<double>{lens[kCentreU], lens[kCentreV]});
  camera.set("distortion", std::vector<double>(lens.begin() + kDistortion, lens.end()));
  return camera;
}

/// Makes the model, or nothing if its parameters are out of range.
std::shared_ptr<const CameraModel> modelOf(const ImageSize& size, std::span<const double> lens) {
  try {
    return readCamera(cameraOf(size, lens));
  } catch (const ConfigError&) {
    return nullptr;
  }
}

}  // namespace

UnifiedSolution solveUnified(const ImageSize& size, const Board& board,
                             const std::vector<Corners>& corners) {
  // The polynomial of a parabolic mirror is this model with xi = 1.
  const OcamSolution start = solveOcam({size.width, size.height}, board, corners);
  const double scale = start.polynomial[0];
  BoardFit fit{{1.0, scale, scale, start.centre.x, start.centre.y, 0.0, 0.0, 0.0, 0.0},
               start.rotations,
               start.translations};
  const LensOf lensOf = [&](std::span<const double> lens) -> Lens {
    return [model = modelOf(size, lens)](const cv::Vec3d& p,
                                         const cv::Point2d&) -> std::optional<cv::Point2d> {
      const auto pixel = model ? model->project({p[0], p[1], p[2]}) : std::nullopt;
      if (!pixel) return std::nullopt;
      return cv::Point2d(pixel->u, pixel->v);
    };
  };
  refine(board, corners, lensOf, fit);
  if (!modelOf(size, fit.lens)) throw std::runtime_error("these boards do not determine the model");
  return {cameraOf(size, fit.lens), std::move(fit)};
}

}  // namespace ortung
