/// Colours by hue, ranges of them, and what is learned of a floor.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "ortung/vision/Colours.hpp"

namespace ortung {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

TEST(Hsv, HasTheHuesOfTheColourWheel) {
  for (const auto& [rgb, hue] : {std::pair{Rgb{255, 0, 0}, 0.0},
                                 {Rgb{255, 255, 0}, 60.0},
                                 {Rgb{0, 255, 0}, 120.0},
                                 {Rgb{0, 255, 255}, 180.0},
                                 {Rgb{0, 0, 255}, 240.0},
                                 {Rgb{255, 0, 255}, 300.0},
                                 {Rgb{200, 100, 0}, 30.0},
                                 {Rgb{200, 0, 50}, 345.0},
                                 {Rgb{50, 200, 100}, 140.0}})
    EXPECT_NEAR(toHsv(rgb[0], rgb[1], rgb[2]).hue, hue, 1e-9);
  const Hsv pale = toHsv(204, 153, 102);  // the least channel is half the greatest
  EXPECT_NEAR(pale.saturation, 0.5, 1e-9);
  EXPECT_NEAR(pale.value, 0.8, 1e-9);
  for (const int grey : {0, 100, 255}) {
    const auto level = static_cast<std::uint8_t>(grey);
    EXPECT_EQ(toHsv(level, level, level).saturation, 0.0);
    EXPECT_EQ(toHsv(level, level, level).hue, 0.0);
    EXPECT_NEAR(toHsv(level, level, level).value, grey / 255.0, 1e-12);
  }
}

/// Whether a colour is in a range: hues are directions, which have an angle between them.
bool isIn(const ColourRange& range, const Hsv& colour) {
  const double turn = (colour.hue - range.hue) * M_PI / 180;
  const double apart = std::abs(std::atan2(std::sin(turn), std::cos(turn))) * 180 / M_PI;
  return apart <= range.hueTolerance && colour.saturation >= range.minSaturation &&
         colour.saturation <= range.maxSaturation && colour.value >= range.minValue &&
         colour.value <= range.maxValue;
}

Parameters rangeOf(double hue, double saturation) {
  Parameters range;
  range.set("hue_deg", hue);
  range.set("min_saturation", saturation);
  return range;
}

TEST(ReadColours, KeepsWhatTheTableDoesNotSay) {
  Parameters table("robot.toml");
  table.set("ball", Parameters::Node{rangeOf(20, 0.75), 1});
  const Colours colours = readColours(table);
  EXPECT_EQ(colours.ball.hue, 20.0);
  EXPECT_EQ(colours.ball.minSaturation, 0.75);
  EXPECT_EQ(colours.ball.hueTolerance, Colours{}.ball.hueTolerance);
  EXPECT_EQ(colours.ball.minValue, Colours{}.ball.minValue);
  EXPECT_EQ(colours.floor.hue, Colours{}.floor.hue);
  EXPECT_FALSE(colours.paleBall)
      << "another ball may have nothing in common with a pale yellow one";
  EXPECT_TRUE(readColours(Parameters("robot.toml")).paleBall);
  table.set("pale_ball", Parameters::Node{rangeOf(50, 0.1), 1});
  EXPECT_EQ(readColours(table).paleBall.value_or(ColourRange{}).hue, 50.0);
  Parameters wrong("robot.toml");
  wrong.set("floor", Parameters::Node{rangeOf(361, 0.5), 1});
  EXPECT_THROW(readColours(wrong), ConfigError);
  wrong.set("floor", Parameters::Node{rangeOf(0, 1.5), 1});
  EXPECT_THROW(readColours(wrong), ConfigError);
}

TEST(ColoursToml, RoundsToThousandths) {
  Colours colours;
  colours.floor = {.hue = 123.4567,
                   .hueTolerance = 20,
                   .minSaturation = 0.0004,
                   .minValue = 0.25,
                   .maxValue = 0.9996};
  EXPECT_EQ(toToml(colours).substr(0, toToml(colours).find('\n')),
            "floor = { hue_deg = 123.457, hue_tolerance_deg = 20.000, min_saturation = 0.000, "
            "min_value = 0.250, max_value = 1.000 }");
  EXPECT_NE(toToml(colours).find("\nball = { hue_deg = 49.000"), std::string::npos);
}

bool isBallIn(const Colours& colours, const Hsv& colour) {
  return isIn(colours.ball, colour) || (colours.paleBall && isIn(*colours.paleBall, colour));
}

// The table has 32 levels a channel, and what is in the middle of a level stands for it. Hues of
// the second floor reach across red.
TEST(ColourTable, IsTheRangesOfTheMiddlesOfItsLevels) {
  Colours red;
  red.floor = {.hue = 350.5,
               .hueTolerance = 20.3,
               .minSaturation = 0.51,
               .minValue = 0.24,
               .maxValue = 0.76};
  for (const Colours& colours : {Colours{}, red}) {
    const ColourTable table(colours);
    std::size_t floor = 0, ball = 0;
    for (int i = 0; i < 32 * 32 * 32; ++i) {
      const std::array<int, 3> least{i / 1024 * 8, i / 32 % 32 * 8, i % 32 * 8};
      const auto rgb = [&](int more) {
        return Rgb{static_cast<std::uint8_t>(least[0] + more),
                   static_cast<std::uint8_t>(least[1] + more),
                   static_cast<std::uint8_t>(least[2] + more)};
      };
      const Rgb middle = rgb(4);
      const Hsv colour = toHsv(middle[0], middle[1], middle[2]);
      for (const int more : {0, 7}) {
        ASSERT_EQ(table.isFloor(rgb(more).data()), isIn(colours.floor, colour)) << i;
        ASSERT_EQ(table.isBall(rgb(more).data()), isBallIn(colours, colour)) << i;
      }
      floor += isIn(colours.floor, colour);
      ball += isBallIn(colours, colour);
    }
    EXPECT_GT(floor, 500u);
    EXPECT_GT(ball, 100u);
  }
}

/// A picture whose upper half has one colour, and its lower one another.
std::vector<std::uint8_t> halves(const Rgb& upper, const Rgb& lower) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 60 * 60; ++i)
    for (const std::uint8_t channel : i < 30 * 60 ? upper : lower) pixels.push_back(channel);
  return pixels;
}

// A floor of one colour: its hue, the least tolerance, half its saturation and 0.4 of its value.
TEST(FindColours, LooksForTheFloorInTheLowerHalf) {
  const auto pixels = halves({30, 30, 200}, {40, 160, 80});
  const ImageView image{{60, 60}, PixelFormat::kRgb, pixels.data()};
  const ColourRange floor = findColours({&image, 1}).floor;
  EXPECT_NEAR(floor.hue, 140.0, 1e-9);
  EXPECT_NEAR(floor.hueTolerance, 20.0, 1e-9);
  EXPECT_NEAR(floor.minSaturation, 0.375, 1e-9);
  EXPECT_NEAR(floor.minValue, 0.4 * 160 / 255.0, 1e-9);
}

TEST(FindColours, KeepsItsDefaultsWithoutAFloor) {
  for (const Rgb& lower : {Rgb{200, 30, 30}, Rgb{30, 30, 200}, Rgb{100, 105, 100}, Rgb{0, 12, 0}}) {
    const auto pixels = halves({40, 160, 80}, lower);
    const ImageView image{{60, 60}, PixelFormat::kRgb, pixels.data()};
    EXPECT_EQ(toToml(findColours({&image, 1})), toToml(Colours{}));
  }
  const std::vector<std::uint8_t> grey(60 * 60, 90);
  const ImageView image{{60, 60}, PixelFormat::kGrey, grey.data()};
  EXPECT_EQ(toToml(findColours({&image, 1})), toToml(Colours{}));
  EXPECT_EQ(toToml(findColours({})), toToml(Colours{}));
}

}  // namespace
}  // namespace ortung
