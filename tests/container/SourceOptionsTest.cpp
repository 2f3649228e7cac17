#include <gtest/gtest.h>

#include <numbers>

#include "Files.hpp"
#include "ortung/core/SourceOptions.hpp"

namespace ortung {
namespace {

using Numbers = std::vector<double>;

Parameters options(const std::string& key, const std::string& text) {
  Parameters p("sim:x");
  p.set(key, text);
  return p;
}

TEST(SourceOptions, NumbersComeBetweenSeparators) {
  EXPECT_EQ(parseNumbers("1"), Numbers{1});
  EXPECT_EQ(parseNumbers("1,-2.5,9e1"), (Numbers{1, -2.5, 90}));
  EXPECT_EQ(parseNumbers("1;2", ';'), (Numbers{1, 2}));
  for (const char* text :
       {"", ",", "1,", ",1", "1,,2", "1 ,2", "1,2x", "nan", "inf", "1e999", "+1"})
    EXPECT_FALSE(parseNumbers(text).has_value()) << text;
}

TEST(SourceOptions, ANumberIsInItsRangeOrNotGiven) {
  EXPECT_EQ(optionNumber(options("speed", "0.5"), "speed", Range{0, 1}), 0.5);
  EXPECT_EQ(optionNumber(options("speed", "1"), "speed", Range{0, 1}), 1.0);
  EXPECT_FALSE(optionNumber(options("other", "0.5"), "speed", Range{0, 1}).has_value());
  EXPECT_EQ(optionNumber(options("other", "0.5"), "speed", 0.25, Range{0, 1}), 0.25);
  for (const char* text : {"1.5", "-0.1", "", "1,1", "nan"})
    EXPECT_EQ(test::messageOf<ConfigError>(
                  [&] { optionNumber(options("speed", text), "speed", Range{0, 1}); }),
              std::string("sim:x: speed is \"") + text + "\", must be a number in [0, 1]");
}

TEST(SourceOptions, APoseIsInMetresAndDegrees) {
  const auto pose = optionPose(options("start", "1,-2,270"), "start");
  ASSERT_TRUE(pose.has_value());
  EXPECT_EQ(pose->x, 1.0);
  EXPECT_EQ(pose->y, -2.0);
  EXPECT_NEAR(pose->theta, -std::numbers::pi / 2, 1e-12);
  EXPECT_FALSE(optionPose(options("other", "1,2,3"), "start").has_value());
  for (const char* text : {"", "1,2", "1,2,3,4", "1,2,x"})
    EXPECT_EQ(
        test::messageOf<ConfigError>([&] { optionPose(options("start", text), "start"); }),
        std::string("sim:x: start is \"") + text + "\", must be x,y,theta in metres and degrees");
}

}  // namespace
}  // namespace ortung
