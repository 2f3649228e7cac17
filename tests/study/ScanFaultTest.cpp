#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "MadeSource.hpp"

namespace ortung::test {
namespace {

constexpr std::uint32_t kFar = 7000;       ///< of a round room [mm]
constexpr std::uint32_t kNothing = 20000;  ///< nothing seen within 8 m

/// Ten scans a second in a round room; beam 0 is not valid, beam 1 sees nothing.
class BadScans : public testing::Test {
 protected:
  BadScans() {
    std::vector<std::uint32_t> scan(181, kFar);
    scan[0] = 0;
    scan[1] = kNothing;
    for (int i = 0; i < 600; ++i) messages.push_back({i * 100'000, kScanId, scan});
  }
  const MadeRobot robot;
  std::vector<Message> messages;
};

TEST_F(BadScans, CrowdHidesMoreThanHalfOfTheBeamsBetweenItsDistances) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    for (const Message& m : robot.disturb(messages, {"readings=crowd"}, seed)) {
      const auto hidden = std::ranges::count_if(
          m.words, [](std::uint32_t w) { return w != kFar && w != 0 && w != kNothing; });
      EXPECT_GE(hidden, 181 / 2);
      EXPECT_LE(hidden, 181 * 4 / 5);  // gaps between people stay open
      for (const std::uint32_t w : m.words) {
        if (w == kFar || w == 0 || w == kNothing) continue;
        EXPECT_GE(w, 399u);
        EXPECT_LE(w, 1501u);
      }
    }
  }
}

// 0.4 m/s at most: a swing of 0.3 m within 8 s (0.24 m/s) and one of 9 degrees at 1.5 m (0.19 m/s).
TEST_F(BadScans, CrowdStaysBesideTheRobotAndMovesSlowly) {
  const auto given = robot.disturb(messages, {"readings=crowd"}, 3);
  int jumps = 0;
  for (std::size_t i = 1; i < given.size(); ++i) {
    for (std::size_t beam = 2; beam < 181; ++beam) {
      const double before = given[i - 1].words[beam];
      const double now = given[i].words[beam];
      // At the edge of somebody, a beam comes from the wall; on a body it changes with its motion,
      // more at its slanting sides.
      if (before == kFar || now == kFar) continue;
      jumps += std::abs(now - before) > 120.0 ? 1 : 0;
    }
  }
  EXPECT_LT(jumps, 600 * 181 / 1000);
  // They also go sideways: who is before a beam now need not be so in half a minute.
  const auto isHidden = [](std::uint32_t w) { return w < kFar && w != 0; };
  std::size_t changed = 0;
  for (std::size_t beam = 0; beam < 181; ++beam)
    changed += isHidden(given[0].words[beam]) != isHidden(given[300].words[beam]) ? 1 : 0;
  EXPECT_GT(changed, 5u);
  const auto atEdge =
      std::ranges::count_if(given, [&](const Message& m) { return isHidden(m.words[0]); });
  EXPECT_GT(atEdge, 0) << "a beam that was not valid sees who stands before it";
}

TEST_F(BadScans, CrowdIsTheSameAtAnyRateOfScans) {
  const auto all = robot.disturb(messages, {"readings=crowd"}, 9);
  std::vector<Message> some;
  for (std::size_t i = 0; i < messages.size(); i += 7) some.push_back(messages[i]);
  const auto few = robot.disturb(some, {"readings=crowd"}, 9);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i], all[7 * i]);
  EXPECT_NE(robot.disturb(messages, {"readings=crowd"}, 10), all);
}

TEST_F(BadScans, WhatIsNearerThanTheCrowdStays) {
  for (Message& m : messages) m.words.assign(181, 300);
  EXPECT_EQ(robot.disturb(messages, {"readings=crowd"}), messages);
}

TEST_F(BadScans, RandomBeamsAreUniformOverTheRange) {
  const auto given = robot.disturb(messages, {"readings=random:0.3@10-50"}, 5);
  double changed = 0.0;
  double sum = 0.0;
  for (std::size_t i = 100; i < 500; ++i) {
    for (std::size_t beam = 2; beam < 181; ++beam) {
      if (given[i].words[beam] == kFar) continue;
      changed += 1.0;
      sum += given[i].words[beam];
      EXPECT_GE(given[i].words[beam], 100u);
      EXPECT_LE(given[i].words[beam], 8000u);
    }
  }
  EXPECT_NEAR(changed / (400 * 179), 0.3, 0.007);  // 4 sigma
  EXPECT_NEAR(sum / changed, 4050.0, 65.0);        // 4 sigma of 7900 / sqrt(12 n)
  for (const std::size_t i : {0u, 99u, 500u, 599u}) EXPECT_EQ(given[i], messages[i]);
}

TEST_F(BadScans, SeveralFaultsAreDrawnIndependently) {
  double changed = 0.0;
  for (const Message& m : robot.disturb(messages, {"readings=random:0.5", "readings=random:0.5"}))
    changed += static_cast<double>(181 - std::ranges::count(m.words, kFar) - 2);
  EXPECT_NEAR(changed / (600 * 179), 0.75, 0.008);
}

TEST_F(BadScans, ShortBeamsAreUniformUpToWhatTheySaw) {
  const auto given = robot.disturb(messages, {"LMS200/LRF/scan=short:0.5"}, 5);
  double shortened = 0.0;
  double sum = 0.0;
  for (const Message& m : given) {
    EXPECT_EQ(m.words[0], 0u) << "what is not valid stays so";
    EXPECT_TRUE(m.words[1] == kNothing || m.words[1] <= 8000u);
    for (std::size_t beam = 2; beam < 181; ++beam) {
      EXPECT_LE(m.words[beam], kFar);
      if (m.words[beam] == kFar) continue;
      shortened += 1.0;
      sum += m.words[beam];
    }
  }
  EXPECT_NEAR(shortened / (600 * 179), 0.5, 0.007);
  EXPECT_NEAR(sum / shortened, 3550.0, 40.0);
  const auto nothingSeen =
      std::ranges::count_if(given, [](const Message& m) { return m.words[1] == kNothing; });
  EXPECT_NEAR(static_cast<double>(nothingSeen), 300.0, 50.0);
  EXPECT_EQ(robot.disturb(messages, {"LMS200/LRF/scan=short:0.5"}, 5), given);
}

}  // namespace
}  // namespace ortung::test
