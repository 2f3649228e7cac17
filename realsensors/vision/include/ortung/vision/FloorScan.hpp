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

/// Something that stands on the floor, in the sensor's frame.
struct FloorBody {
  double range = 0.0;    ///< to its nearest visible point, along the floor [m]
  double bearing = 0.0;  ///< of its middle [rad]
  double width = 0.0;    ///< across the line of sight [m]
};

/// Looks along the floor, away from the camera, in many directions, for what hides it: the pixels
/// of each direction are worked out beforehand. Not thread-safe.
class ORTUNG_API FloorScan {
 public:
  struct Config {
    int directions = 180;      ///< of the whole turn
    double maxRange = 6.0;     ///< [m]
    double leastDepth = 0.25;  ///< so much floor must be hidden behind a line of it [m]
    double leastWidth = 0.15;  ///< of a body [m]
    double mostWidth = 1.2;    ///< wider ones are no bodies but borders [m]
  };
  FloorScan(const CameraView& view, const Config& config);

  /// Bodies, the nearest first. Lines, which hide no floor for long, and balls are none.
  std::vector<FloorBody> find(const ImageView& image, const ColourTable& colours) const;

 private:
  struct Step {
    double range;       ///< [m]
    std::size_t pixel;  ///< index into the image
  };
  std::optional<double> firstHidden(const ImageView& image, const ColourTable& colours,
                                    std::span<const Step> steps) const;

  Config config_;
  ImageSize size_;
  std::vector<Step> steps_;          ///< direction by direction, from near to far
  std::vector<std::size_t> begins_;  ///< of each direction in steps_, and the end
};

}  // namespace ortung
