#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <limits>

#include "HeatMap.hpp"

namespace ortung::app {
namespace {

/// A strip of four open cells and one solid one at the end.
FieldRegion strip() {
  FieldRegion region;
  region.grid = {0.0, 0.0, 1.0, 5, 1};
  region.open = {1, 1, 1, 1, 0};
  region.standable = region.open;
  return region;
}

/// A decoded PNG, eight bits of grey a pixel.
struct Decoded {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  explicit Decoded(const std::vector<std::byte>& png) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, png.data(), png.size()), 0);
    image.format = PNG_FORMAT_RGB;
    width = static_cast<int>(image.width);
    height = static_cast<int>(image.height);
    rgb.resize(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr), 0);
  }
  int red(int x, int y) const { return rgb[3 * static_cast<std::size_t>(y * width + x)]; }
};

TEST(HeatMap, ScaleEndsAtTheLeastAndGreatestValueOfOpenCells) {
  const FieldRegion region = strip();
  HeatMap map;
  map.region = &region;
  map.values = {2.0, std::numeric_limits<double>::quiet_NaN(), 5.0, 3.0, 99.0};
  EXPECT_EQ(map.scale().low, 2.0);
  EXPECT_EQ(map.scale().high, 5.0);
  EXPECT_EQ(map.legend(4), (std::vector<double>{2.0, 3.0, 4.0, 5.0}));
}

TEST(HeatMap, LogarithmicLegendIsEvenInLogarithms) {
  const FieldRegion region = strip();
  HeatMap map;
  map.region = &region;
  map.logarithmic = true;
  map.values = {0.01, 0.1, 1.0, 0.5, 0.0};
  const std::vector<double> legend = map.legend(3);
  EXPECT_NEAR(legend[0], 0.01, 1e-12);
  EXPECT_NEAR(legend[1], 0.1, 1e-12);
  EXPECT_NEAR(legend[2], 1.0, 1e-12);
}

TEST(HeatMap, GreaterValuesAreDarkerAndSmallGridsAreScaledUp) {
  const FieldRegion region = strip();
  HeatMap map;
  map.region = &region;
  map.values = {0.0, 1.0, 2.0, 3.0, 0.0};
  const Decoded picture(draw(map).png());
  ASSERT_GE(picture.width, 200);
  int darkest = 256;
  const int y = 12 + 24 + 20;  // margin, caption, middle of the cells (zoom 40)
  for (int cell = 0; cell < 4; ++cell) {
    const int red = picture.red(12 + 40 * cell + 20, y);
    EXPECT_LT(red, darkest) << "cell " << cell;
    darkest = red;
  }
}

TEST(HeatMap, DrawsWithoutAnyValue) {
  const FieldRegion region = strip();
  HeatMap map;
  map.region = &region;
  map.values.assign(5, std::numeric_limits<double>::quiet_NaN());
  map.truth = Pose2{std::numeric_limits<double>::infinity(), 0.0, 0.0};
  EXPECT_FALSE(draw(map).png().empty());
}

}  // namespace
}  // namespace ortung::app
