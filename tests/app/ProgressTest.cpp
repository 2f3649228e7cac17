// A progress bar as a terminal gets it. How long the work took is left out.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <regex>

#include "Progress.hpp"

namespace ortung::app {
namespace {

std::string shown(const std::function<void()>& action) {
  testing::internal::CaptureStderr();
  action();
  return std::regex_replace(testing::internal::GetCapturedStderr(), std::regex(", [0-9]+ s left"),
                            "");
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
