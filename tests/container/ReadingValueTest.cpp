// What words of rows mean to somebody who knows no more of a feature than its format's line.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "ortung/base/Words.hpp"
#include "ortung/core/ReadingValue.hpp"

namespace ortung {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;  // [rad]

/// A kind of value with one word of it,
/// as docs/protocol.md lists them.
struct Kind {
  std::string text;
  ValueKind kind;
  std::uint32_t word;
  double value;  ///< of the word
  double least;  ///< where lengths are up to 5 m
  double most;
  bool isLength;
  bool isAngle;
};
const std::vector<Kind> kKinds = {
    {"other", ValueKind::kOther, 42, 42.0, 0.0, 0.0, false, false},
    {"identity", ValueKind::kIdentity, 7, 7.0, 0.0, 0.0, false, false},
    {"range_mm", ValueKind::kRange, 1'500, 1.5, 0.0, 5.0, true, false},
    {"bearing_cdeg", ValueKind::kBearing, 18'000 - 9'000, -90 * kDegree, -kPi, kPi, false, true},
    {"x_mm", ValueKind::kX, words::kOffset + 250, 0.25, -5.0, 5.0, true, false},
    {"y_mm", ValueKind::kY, words::kOffset - 250, -0.25, -5.0, 5.0, true, false},
    {"heading_cdeg", ValueKind::kHeading, 18'000 + 4'500, 45 * kDegree, -kPi, kPi, false, true},
    {"radius_mm", ValueKind::kRadius, 110, 0.11, 0.0, 5.0, true, false},
    {"colour", ValueKind::kColour, 0xFF8000, 0xFF8000, 0.0, 0.0, false, false},
    {"unheard_of", ValueKind::kOther, 9, 9.0, 0.0, 0.0, false, false},
};

/// A format with rows of all kinds, in their order.
Format formatOfAll(const std::string& more) {
  std::string row;
  for (const Kind& kind : kKinds) row += (row.empty() ? "" : ",") + kind.text;
  return parseFormat("acme row=" + row + more);
}

std::vector<std::uint32_t> wordsOfAll() {
  std::vector<std::uint32_t> words;
  for (const Kind& kind : kKinds) words.push_back(kind.word);
  return words;
}

TEST(ReadingValue, EachWordOfARowHasItsMeaning) {
  const Format format = formatOfAll(" max_m=5");
  std::vector<std::uint32_t> words = wordsOfAll();
  words.insert(words.end(), words.begin(), words.begin() + kKinds.size());
  words.push_back(1);  // of a row that is not complete
  const std::vector<WordValue> values = valuesOfRows(format, words);
  ASSERT_EQ(values.size(), 2 * kKinds.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Kind& kind = kKinds[i % kKinds.size()];
    EXPECT_EQ(values[i].word, i);
    EXPECT_EQ(values[i].entry, i / kKinds.size());
    EXPECT_EQ(values[i].kind, kind.kind) << kind.text;
    EXPECT_NEAR(values[i].value, kind.value, 1e-12) << kind.text;
    EXPECT_EQ(values[i].least, kind.least) << kind.text;
    EXPECT_EQ(values[i].most, kind.most) << kind.text;
  }
}

TEST(ReadingValue, LengthsReachTwentyMetresIfNothingIsSaid) {
  const std::vector<WordValue> values = valuesOfRows(formatOfAll(""), wordsOfAll());
  ASSERT_EQ(values.size(), kKinds.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(values[i].most, 4.0 * kKinds[i].most - (kKinds[i].isAngle ? 3.0 * kPi : 0.0))
        << kKinds[i].text;
}

TEST(ReadingValue, LengthsAndAnglesAreWhatSixKindsAre) {
  std::vector<double> expected;
  std::vector<bool> areAngles;
  for (const Kind& kind : kKinds) {
    EXPECT_EQ(isLength(kind.kind), kind.isLength) << kind.text;
    EXPECT_EQ(isAngle(kind.kind), kind.isAngle) << kind.text;
    if (!kind.isLength && !kind.isAngle) continue;
    expected.push_back(kind.value);
    areAngles.push_back(kind.isAngle);
  }
  const Format format = formatOfAll("");
  const std::vector<double> found = lengthsAndAngles(valuesOfRows(format, wordsOfAll()));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 1e-12);
    EXPECT_EQ(isAngleOfRow(format, i), areAngles[i]) << i;
    EXPECT_EQ(isAngleOfRow(format, i + found.size()), areAngles[i]) << "of the next row";
  }
}

TEST(ReadingValue, WordsComeBack) {
  for (const WordValue& value : valuesOfRows(formatOfAll(""), wordsOfAll()))
    EXPECT_EQ(wordOf(value), kKinds[value.word].word) << kKinds[value.word].text;
  WordValue none{.kind = ValueKind::kRange, .value = std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW(wordOf(none), std::invalid_argument);
  none.value = std::numeric_limits<double>::infinity();
  EXPECT_THROW(wordOf(none), std::invalid_argument);
}

TEST(ReadingValue, WithoutARowThereAreNone) {
  const Format format = parseFormat("acme max_m=5");
  EXPECT_TRUE(rowOf(format).empty());
  EXPECT_TRUE(valuesOfRows(format, wordsOfAll()).empty());
  EXPECT_FALSE(isAngleOfRow(format, 0));
}

}  // namespace
}  // namespace ortung
