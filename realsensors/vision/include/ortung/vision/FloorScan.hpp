#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/vision/Colours.hpp"

namespace ortung {

/// An object on the floor, in the sensor's frame.
struct FloorBody {
  double range = 0.0;    ///< distance to its nearest visible point, along the floor [m]
  double bearing = 0.0;  ///< direction to its middle, counter-clockwise [rad]
  double width = 0.0;    ///< its width across the line of sight [m]
};

/// Finds objects that hide the floor: follows the floor away from the camera in many directions,
/// whose pixels are computed once. Not thread-safe.
class ORTUNG_API FloorScan {
 public:
  struct Config {
    int directions = 180;      ///< number of directions in a turn
    double maxRange = 6.0;     ///< greatest distance along the floor [m]
    double leastDepth = 0.25;  ///< least length of hidden floor; beyond 1 m: times the range [m]
    double leastWidth = 0.15;  ///< least width of a body [m]
    double mostWidth = 1.2;    ///< greatest width of a body; wider ones are borders [m]
  };
  /// Computes the pixels of all directions.
  FloorScan(const CameraView& view, const Config& config);

  /// Finds bodies, the nearest first. Lines, which hide little floor, and balls are left out.
  /// @return nothing for an image of another size than the camera's, or a grey one
  std::vector<FloorBody> find(const ImageView& image, const ColourTable& colours) const;

 private:
  struct Step {
    double range;       ///< distance along the floor [m]
    std::size_t pixel;  ///< index into the image
  };
  std::optional<double> firstHidden(const ImageView& image, const ColourTable& colours,
                                    std::span<const Step> steps) const;

  Config config_;
  ImageSize size_;
  std::vector<Step> steps_;          ///< direction by direction, from near to far
  std::vector<std::size_t> begins_;  ///< first step of each direction, and the end of steps_
};

}  // namespace ortung
