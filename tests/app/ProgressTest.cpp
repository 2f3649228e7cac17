// A progress bar as a terminal gets it, and lines where there is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <regex>
#include <vector>

#include "Console.hpp"
#include "Progress.hpp"

namespace ortung::app {
namespace {

std::string allShown(const std::function<void()>& action) {
  testing::internal::CaptureStderr();
  action();
  return testing::internal::GetCapturedStderr();
}

/// Without how long the work takes.
std::string shown(const std::function<void()>& action) {
  return std::regex_replace(allShown(action), std::regex(", [0-9]+ s left"), "");
}

/// Work of which @p share is done after some seconds, as `allShown`.
struct Done {
  double seconds;
  double share;
};
std::string shownOf(bool bar, const std::vector<Done>& all) {
  return allShown([&] {
    std::chrono::steady_clock::time_point now;
    Progress progress("learning", bar, [&now] { return now; });
    for (const Done& done : all) {
      now = std::chrono::steady_clock::time_point() +
            std::chrono::microseconds(std::llround(1e6 * done.seconds));
      progress.update(done.share);
    }
  });
}

/// What stands behind the share.
std::string shownBehind(double seconds, double share) {
  const std::string text = shownOf(true, {{seconds, share}});
  const std::string end = "\033[K\n";
  EXPECT_TRUE(text.ends_with(end)) << text;
  const std::size_t from = text.find('%') + 1;
  return text.substr(from, text.size() - end.size() - from);
}

TEST(Progress, ABarIsDrawnAtOnceAtItsEndAndEndsItsLine) {
  const std::string text = shown([] {
    Progress progress("learning", true);
    progress.update(0.25);
    progress.update(1.0);
  });
  const std::string quarter = std::string(10, '#') + std::string(30, '.');
  EXPECT_EQ(text, "\rlearning [" + quarter + "]  25 %\033[K\rlearning [" + std::string(40, '#') +
                      "] 100 %\033[K\n");
}

// At the pace so far, rounded up: a quarter in 30 s leaves three quarters for 90 s.
TEST(Progress, TheTimeLeftIsThatOfThePaceSoFar) {
  EXPECT_EQ(shownBehind(30.0, 0.25), ", 90 s left");
  EXPECT_EQ(shownBehind(10.0, 0.3), ", 24 s left");
  EXPECT_EQ(shownBehind(1.0, 0.5), ", 1 s left");
  EXPECT_EQ(shownBehind(20.0, 1.0), ", 0 s left");
  EXPECT_EQ(shownBehind(30.0, 0.0), "") << "there is no pace yet";
  EXPECT_EQ(shownBehind(0.9, 0.25), "") << "a second is needed to tell the pace";
}

TEST(Progress, BarsComeAtMostTenTimesASecond) {
  const auto bars = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\r');
  };
  EXPECT_EQ(bars(shownOf(true, {{0.0, 0.1}, {0.05, 0.2}, {0.0999, 0.3}})), 1);
  EXPECT_EQ(bars(shownOf(true, {{0.0, 0.1}, {0.05, 0.2}, {0.1, 0.3}})), 2);
  EXPECT_EQ(bars(shownOf(true, {{0.0, 0.1}, {0.05, 1.0}})), 2) << "but the end is shown";
}

TEST(Progress, LinesComeEveryFiveSeconds) {
  setCommandName("ortung");
  const std::string text =
      shownOf(false, {{0.0, 0.0}, {4.9, 0.2}, {5.0, 0.25}, {9.9, 0.4}, {10.0, 0.5}, {15.0, -1.0}});
  EXPECT_EQ(text,
            "ortung: learning: 25 %, 15 s left\n"
            "ortung: learning: 50 %, 10 s left\n"
            "ortung: learning, 15 s\n");
  EXPECT_EQ(shownOf(false, {{0.1, 1.0}}), "");
}

TEST(Progress, MoreThanAllIsAll) {
  const std::string text = shown([] {
    Progress progress("reading", true);
    progress.update(1.5);
  });
  EXPECT_EQ(text, "\rreading [" + std::string(40, '#') + "] 100 %\033[K\n");
}

TEST(Progress, WhereTheEndIsNotKnownTheTimeIsShown) {
  for (const double share : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const std::string text = shown([&] {
      Progress progress("importing", true);
      progress.update(share);
    });
    EXPECT_TRUE(std::regex_match(text, std::regex("\rimporting [0-9]+ s\033\\[K\n"))) << text;
  }
}

TEST(Progress, WorkThatIsDoneAtOnceSaysNothing) {
  EXPECT_EQ(shown([] { const Progress progress("reading", true); }), "");
}

}  // namespace
}  // namespace ortung::app
