#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/vision/Colours.hpp"

namespace ortung {

/// Where a scan line of an image crosses a painted line.
struct LinePoint {
  Pixel pixel;         ///< the middle of the crossing
  double width = 0.0;  ///< along the scan line [px]
  bool inRow = true;   ///< the scan line is a row, else a column
};

/// Finds white lines on a floor: places along rows and columns where whiteness rises from the
/// floor's and falls back to it. Whiteness is a pixel's least channel, so no green or yellow is
/// white however bright it is. Not thread-safe: it keeps its buffers.
class ORTUNG_API LineFinder {
 public:
  struct Config {
    int spacing = 6;           ///< between scan lines [px]
    double mostWidth = 0.12;   ///< of a crossing, as a share of the image's longer side
    double minContrast = 0.3;  ///< of whiteness against the floor's, as a share of the floor's
    int minStep = 18;          ///< of whiteness, in levels of 255
  };
  explicit LineFinder(const Config& config) : config_(config) {}

  /// Points live until the next call. None of a grey image.
  std::span<const LinePoint> find(const ImageView& image, const ColourTable& colours);

 private:
  /// Finds the crossings along one scan line.
  void scan(const std::uint8_t* first, std::size_t step, int count, const ColourTable& colours);
  void keepChains(int width, int height);
  void readProfile(const std::uint8_t* first, std::size_t step, int count,
                   const ColourTable& colours);

  Config config_;
  std::vector<std::uint8_t> white_;      ///< along the present scan line
  std::vector<std::int32_t> floorSum_;   ///< floor pixels before each pixel
  std::vector<std::int32_t> whiteSum_;   ///< their whiteness
  std::vector<std::int32_t> squareSum_;  ///< squares of their whiteness
  int longest_ = 0;                      ///< crossing [px]
  struct Crossing {
    double middle, width;
  };
  std::vector<Crossing> crossings_;
  std::vector<LinePoint> points_;
  // Of the search for neighbours: points by cells of the image.
  std::vector<std::int32_t> cells_;
  std::vector<std::int32_t> next_;
  std::vector<LinePoint> sorted_;
  std::vector<Pixel> neighbours_;
};

}  // namespace ortung
