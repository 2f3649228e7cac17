#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "Seeded.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung::words {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHuge = 1e300;
constexpr std::uint32_t kLargest = 0xFFFFFFFF;

TEST(Words, LengthsRoundToTheNearestMillimetre) {
  EXPECT_EQ(fromMetres(1.2344), 1234u);
  EXPECT_EQ(fromMetres(1.2346), 1235u);
  EXPECT_DOUBLE_EQ(toMetres(1234), 1.234);
}

TEST(Words, LengthsAreClampedToWhatAWordHolds) {
  EXPECT_EQ(fromMetres(-3.0), 0u);
  EXPECT_EQ(fromMetres(kHuge), kLargest);
  EXPECT_EQ(fromMetres(4294967.295), kLargest);
  EXPECT_EQ(fromSignedMetres(-kHuge), 0u);
  EXPECT_EQ(fromSignedMetres(kHuge), kLargest);
}

TEST(Words, SignedLengthsHaveTheirZeroInTheMiddle) {
  EXPECT_EQ(fromSignedMetres(0.0), kOffset);
  EXPECT_EQ(fromSignedMetres(-0.001), kOffset - 1);
  EXPECT_EQ(fromSignedMetres(2.5), kOffset + 2500);
  EXPECT_DOUBLE_EQ(toSignedMetres(kOffset - 2500), -2.5);
  EXPECT_DOUBLE_EQ(toSignedMetres(0), -2147483.648);
}

TEST(Words, AnglesAreHundredthsOfADegreeFromMinusPi) {
  EXPECT_EQ(fromAngle(0.0), 18000u);
  EXPECT_EQ(fromAngle(kPi / 2), 27000u);
  EXPECT_EQ(fromAngle(-kPi / 2), 9000u);
  EXPECT_DOUBLE_EQ(toAngle(0), -kPi);
  EXPECT_DOUBLE_EQ(toAngle(27000), kPi / 2);
}

TEST(Words, PiAndMinusPiAreTheSameWord) {
  EXPECT_EQ(fromAngle(kPi), 0u);
  EXPECT_EQ(fromAngle(-kPi), 0u);
  EXPECT_EQ(fromAngle(std::nextafter(kPi, 0.0)), 0u);
  EXPECT_EQ(fromAngle(kPi - 0.4 * kPi / 18000), 0u);  // rounds up over the seam
  EXPECT_EQ(fromAngle(kPi - 0.6 * kPi / 18000), 35999u);
}

TEST(Words, RatesAreSignedAndClamped) {
  EXPECT_EQ(fromRate(0.0), kOffset);
  EXPECT_EQ(fromRate(-kPi), kOffset - 18000);
  EXPECT_EQ(fromRate(kHuge), kLargest);
  EXPECT_EQ(fromRate(-kHuge), 0u);
  EXPECT_NEAR(toRate(kOffset + 18000), kPi, 1e-15);
}

RC_GTEST_PROP(WordsProperty, EveryLengthWordSurvivesTheWayThroughMetres, (std::uint32_t word)) {
  RC_ASSERT(fromMetres(toMetres(word)) == word);
  RC_ASSERT(fromSignedMetres(toSignedMetres(word)) == word);
  RC_ASSERT(fromRate(toRate(word)) == word);
}

RC_GTEST_PROP(WordsProperty, AnyAngleComesBackWithinHalfAWord, ()) {
  const double angle = *rc::gen::inRange(-1000000, 1000000) * 1e-3;
  const std::uint32_t word = fromAngle(angle);
  RC_ASSERT(word < kAngles);
  RC_ASSERT(std::abs(std::remainder(toAngle(word) - angle, 2 * kPi)) < 0.5001 * kPi / 18000);
}

RC_GTEST_PROP(WordsProperty, AnyLengthComesBackWithinHalfAMillimetre, ()) {
  const double metres = *rc::gen::inRange(0, 2000000000) * 1e-6;
  RC_ASSERT(std::abs(toMetres(fromMetres(metres)) - metres) < 0.0005001);
  RC_ASSERT(std::abs(toSignedMetres(fromSignedMetres(-metres)) + metres) < 0.0005001);
}

TEST(Words, EveryAngleWordSurvivesTheWayThroughRadians) {
  for (std::uint32_t word = 0; word < kAngles; ++word) ASSERT_EQ(fromAngle(toAngle(word)), word);
}

}  // namespace
}  // namespace ortung::words
