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

// A robot whose odometry stops for a second now and then is not silent the next time.
TEST(OdometrySilence, WhatIsUsualIsForgottenOverAMinute) {
  OdometrySilence silence = heard(1.0, 2, 10.0);
  for (int i = 1; i <= 1200; ++i) silence.hear(fromSeconds(10.0 + 0.05 * i));
  EXPECT_FALSE(silence.since(fromSeconds(70.0 + 1.10)));
  EXPECT_TRUE(silence.since(fromSeconds(70.0 + 1.11)));  // 3 / e
}

TEST(OdometrySilence, ShortOnesAreBridged) {
  OdometrySilence silence = heard(0.05, 20, 10.0);
  EXPECT_FALSE(silence.isBridged(fromSeconds(10.0)));
  silence.hear(fromSeconds(11.9));
  for (int i = 1; i < 10; ++i) silence.hear(fromSeconds(11.9 + 0.05 * i));
  EXPECT_TRUE(silence.isBridged(fromSeconds(11.0)));
  EXPECT_FALSE(silence.isBridged(fromSeconds(9.9)));
  EXPECT_FALSE(silence.isBridged(fromSeconds(12.0)));
  silence.hear(fromSeconds(60.0));
  EXPECT_FALSE(silence.isBridged(fromSeconds(30.0))) << "who knows what happened meanwhile";
  EXPECT_FALSE(silence.isBridged(fromSeconds(11.0)));
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
