#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/camera/ImageData.hpp"
#include "ortung/vision/Colours.hpp"

namespace ortung {

struct FaintCrossing;
struct ScanLine;
class FaintLines;
class FaintScan;

/// A point at which a scan line of an image crosses a painted line.
struct LinePoint {
  Pixel pixel;         ///< the middle of the crossing
  double width = 0.0;  ///< width of the crossing along the scan line [px]
  bool inRow = true;   ///< whether the scan line is a row; else it is a column
};

/// Finds white lines on a floor: places along rows and columns where whiteness rises from the
/// floor's and falls back to it. Whiteness is a pixel's least channel, so that green and yellow are
/// not white however bright they are. Thin lines may rise as little as floors are rough, if they do
/// so along many scan lines. Not thread-safe: it keeps its buffers.
class ORTUNG_API LineFinder {
 public:
  struct Config {
    int spacing = 6;           ///< distance between scan lines [px]
    double mostWidth = 0.12;   ///< greatest width of a crossing / the image's longer side
    double minContrast = 0.3;  ///< least rise of whiteness / the floor's whiteness
    int minStep = 18;          ///< least rise of whiteness, in [0, 255]
    /// Whether to find thin lines that rise less, too, where crossings of many scan lines follow
    /// each other smoothly.
    bool findsFaint = true;
  };
  /// Makes a finder; settings are not checked.
  explicit LineFinder(const Config& config);
  ~LineFinder();
  LineFinder(LineFinder&&) noexcept;
  LineFinder& operator=(LineFinder&&) noexcept;

  /// Finds points on lines. They are valid until the next call; a grey image has none.
  std::span<const LinePoint> find(const ImageView& image, const ColourTable& colours);

 private:
  /// Finds the crossings along one scan line.
  void scan(const std::uint8_t* first, std::size_t step, int count, const ColourTable& colours);
  /// Scans all rows, or all columns, of an image.
  void scanAll(const ImageView& image, const ColourTable& colours, bool inRows);
  /// Finds what rises a little along the scan line that was scanned last.
  void scanFaint(const ScanLine& line);
  void keepChains(int width, int height);
  void readProfile(const std::uint8_t* first, std::size_t step, int count,
                   const ColourTable& colours);

  Config config_;
  std::vector<std::uint8_t> white_;      ///< whiteness along the current scan line
  std::vector<std::int32_t> floorSum_;   ///< number of floor pixels before each pixel
  std::vector<std::int32_t> whiteSum_;   ///< sum of their whiteness
  std::vector<std::int32_t> squareSum_;  ///< sum of the squares of their whiteness
  int longest_ = 0;                      ///< greatest width of a crossing [px]
  struct Crossing {
    double middle, width;
    double step;  ///< rise of whiteness
  };
  std::vector<Crossing> crossings_;
  std::vector<LinePoint> points_;
  std::unique_ptr<FaintLines> faint_;
  std::unique_ptr<FaintScan> faintScan_;
  std::vector<FaintCrossing> faintCrossings_;
  std::vector<LinePoint> faintPoints_;
  // Buffers of the search for neighbours: points by cells of the image.
  std::vector<std::int32_t> cells_;
  std::vector<std::int32_t> next_;
  std::vector<LinePoint> sorted_;
  std::vector<Pixel> neighbours_;
};

}  // namespace ortung
