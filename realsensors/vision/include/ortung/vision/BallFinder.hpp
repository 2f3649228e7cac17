#pragma once

#include <cstdint>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/CameraView.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/vision/Colours.hpp"

namespace ortung {

/// A ball on the floor, in the sensor's frame.
struct SeenBall {
  double range = 0.0;    ///< distance to its middle along the floor [m]
  double bearing = 0.0;  ///< direction to its middle, counter-clockwise [rad]
};

/// Finds balls on the floor: discs of the ball's colours that have the outline of a ball at their
/// place, other colours around it, and floor below. Where a ball may be, and how large it is there,
/// is computed once for a camera. Not thread-safe: it keeps its buffers.
class ORTUNG_API BallFinder {
 public:
  struct Config {
    double radius = 0.11;      ///< the ball's radius [m]
    double maxRange = 8.0;     ///< greatest distance along the floor [m]
    double leastRadius = 2.0;  ///< smaller balls are not looked for [px]
    double leastEdge = 0.7;    ///< least share of the visible outline that is an edge, in [0, 1]
    double leastFilled = 0.6;  ///< least share of the disc with the ball's colours, in [0, 1]
  };
  BallFinder(const CameraView& view, const Config& config);

  /// Finds balls, the nearest first; nothing in a grey image, or one of another size.
  std::vector<SeenBall> find(const ImageView& image, const ColourTable& colours);

 private:
  struct Place {  ///< a place at which the middle of a ball may be
    Pixel middle;
    double radius;  ///< [px]
  };
  struct Disc {  ///< a ball that was found in a picture
    Pixel middle;
    double radius;  ///< [px]
    double score;
  };
  struct Look;
  void addRow(double v);
  void sumUp(const ImageView& image, const ColourTable& colours);
  double shareIn(const Pixel& middle, double half) const;
  std::vector<Place> candidates() const;
  Disc bestAround(const Place& place, const Look& look) const;
  std::vector<Pixel> outlineOf(const Pixel& middle) const;

  CameraView view_;
  Config config_;
  std::vector<Place> places_;
  double leastInRow_ = 0.0;         ///< least radius in the row that was added last [px]
  std::vector<std::int32_t> sums_;  ///< ball-coloured pixels above and left of each pixel
};

}  // namespace ortung
