// When odometry counts as missing.
#include <gtest/gtest.h>

#include "OdometrySilence.hpp"

namespace ortung {
namespace {

/// One that has heard odometry @p count times, so many seconds apart, the newest at @p last.
OdometrySilence heard(double seconds, int count, double last) {
  OdometrySilence silence;
  for (int i = count - 1; i >= 0; --i) silence.hear(fromSeconds(last - i * seconds));
  return silence;
}

TEST(OdometrySilence, BeginsAfterAFewCyclesWithoutOdometry) {
  const OdometrySilence silence = heard(0.05, 20, 10.0);
  EXPECT_FALSE(silence.since(fromSeconds(9.0)));
  EXPECT_FALSE(silence.since(fromSeconds(10.0)));
  EXPECT_FALSE(silence.since(fromSeconds(10.29)));
  EXPECT_EQ(silence.since(fromSeconds(10.31)), fromSeconds(10.0));
  EXPECT_EQ(silence.since(fromSeconds(60.0)), fromSeconds(10.0));
}

TEST(OdometrySilence, OdometryThatComesRarelyIsNotMissingBetweenTwo) {
  const OdometrySilence silence = heard(1.0, 5, 10.0);
  EXPECT_FALSE(silence.since(fromSeconds(12.9)));
  EXPECT_EQ(silence.since(fromSeconds(13.1)), fromSeconds(10.0));
}

// Ten cycles after a slow one, patience is short again.
TEST(OdometrySilence, WhatIsUsualIsForgottenSlowly) {
  OdometrySilence silence = heard(1.0, 2, 10.0);
  for (int i = 1; i <= 20; ++i) silence.hear(fromSeconds(10.0 + 0.05 * i));
  EXPECT_FALSE(silence.since(fromSeconds(11.0 + 0.36)));
  EXPECT_TRUE(silence.since(fromSeconds(11.0 + 0.37)));  // 3 * 0.9^20 = 0.365
}

TEST(OdometrySilence, ItsEndSaysNothingOfWhatIsUsual) {
  OdometrySilence silence = heard(0.05, 20, 10.0);
  silence.hear(fromSeconds(25.0));
  EXPECT_FALSE(silence.since(fromSeconds(25.2)));
  EXPECT_EQ(silence.since(fromSeconds(25.31)), fromSeconds(25.0));
}

TEST(OdometrySilence, WithoutOdometryNothingIsMissing) {
  OdometrySilence silence;
  EXPECT_FALSE(silence.since(fromSeconds(100.0)));
  silence.hear(std::nullopt);
  EXPECT_FALSE(silence.since(fromSeconds(100.0)));
  silence.hear(fromSeconds(1.0));
  EXPECT_TRUE(silence.since(fromSeconds(100.0)));
  silence.hear(std::nullopt);
  EXPECT_FALSE(silence.since(fromSeconds(100.0)));
}

TEST(OdometrySilence, AClockThatIsSetBackIsNoSilence) {
  OdometrySilence silence = heard(0.05, 20, 1000.0);
  silence.hear(fromSeconds(5.0));
  EXPECT_FALSE(silence.since(fromSeconds(5.2)));
  EXPECT_EQ(silence.since(fromSeconds(5.4)), fromSeconds(5.0));
}

}  // namespace
}  // namespace ortung
