#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Axis.hpp"
#include "LandmarkLabels.hpp"
#include "TimeGaps.hpp"

namespace ortung::app {
namespace {

TEST(Axis, StepsAreRound) {
  EXPECT_EQ(axisTicks(-3.0, 4.0, 8), (std::vector<double>{-3, -2, -1, 0, 1, 2, 3, 4}));
  EXPECT_EQ(axisTicks(-3.2, 4.1, 7), (std::vector<double>{-2, 0, 2, 4}));
  EXPECT_EQ(axisTicks(0.0, 100.0, 5), (std::vector<double>{0, 50, 100}));
}

TEST(Axis, ManyScalesGiveTicksWithinThatAreNeitherManyNorFew) {
  for (double extent = 1e-3; extent < 1e6; extent *= 1.37) {
    for (const int most : {3, 5, 12}) {
      const double low = -0.3 * extent;
      const std::vector<double> ticks = axisTicks(low, low + extent, most);
      EXPECT_LE(static_cast<int>(ticks.size()), most) << extent;
      EXPECT_GE(static_cast<int>(ticks.size()), most / 4 + 1) << extent;
      for (const double tick : ticks) {
        EXPECT_GE(tick, low - 1e-6 * extent);
        EXPECT_LE(tick, low + extent + 1e-6 * extent);
      }
    }
  }
}

TEST(Axis, NoNumbersGiveNoTicks) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(axisTicks(0.0, infinity, 5).empty());
  EXPECT_TRUE(axisTicks(std::nan(""), 1.0, 5).empty());
  EXPECT_TRUE(axisTicks(2.0, 1.0, 5).empty());
  EXPECT_LE(axisTicks(1e17, 1e17 + 64.0, 5).size(), 5u);
}

TEST(Axis, RoundLengthsAreNotAboveWhatWasAskedFor) {
  EXPECT_EQ(roundLength(1.99), 1.0);
  EXPECT_EQ(roundLength(2.0), 2.0);
  EXPECT_EQ(roundLength(49.0), 20.0);
  EXPECT_EQ(roundLength(0.07), 0.05);
  EXPECT_EQ(roundLength(0.0), 1.0);
}

TEST(TimeGaps, AGapIsFiveUsualStepsAndAtLeastASecond) {
  std::vector<Timestamp> stamps;
  for (int i = 0; i < 100; ++i) stamps.push_back(fromSeconds(0.1 * i));
  EXPECT_EQ(longestDrawnStep(stamps), 1.0);
  for (Timestamp& stamp : stamps) stamp *= 30;
  EXPECT_NEAR(longestDrawnStep(stamps), 15.0, 1e-9);
  EXPECT_EQ(longestDrawnStep({}), 1.0);
}

TEST(LandmarkLabels, SayTheKindWhereThereAreSeveralAndGoLeftWhereTheRightIsTaken) {
  FieldModel field;
  field.landmarks = {{1, "post", 0.0, 0.0, 0.0}, {2, "post", 0.2, 0.0, 0.0}};
  std::vector<LandmarkLabel> labels = labelsOf(field, 0.2, 10.0);
  EXPECT_EQ(labels[0].text, "1");
  EXPECT_TRUE(labels[0].isLeft);
  EXPECT_FALSE(labels[1].isLeft);
  EXPECT_TRUE(labelsOf(field, 0.2, 0.3)[1].isLeft) << "the map ends there";
  field.landmarks[1].kind = "lamp";
  EXPECT_EQ(labelsOf(field, 0.2, 10.0)[1].text, "lamp 2");
  field.landmarks.resize(1000);
  EXPECT_TRUE(labelsOf(field, 0.2, 10.0).empty());
}

}  // namespace
}  // namespace ortung::app
