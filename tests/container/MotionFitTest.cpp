#include <gtest/gtest.h>

#include "MotionFit.hpp"
#include "PluginProgress.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

// Two causes that are nearly alike: together neither is certain, though one of them is all there
// is. The one that says less goes, and then the other is certain. Of 1600 pieces of noise 1, with
// causes of 1 and of 1 +- 0.2, both together are known to 1 / (0.2 sqrt(1600)) = 0.125; alone, the
// first is known to 0.025. The second half has the causes of the first and the opposite noise, so
// that chance favours neither.
TEST(MotionFit, LeavesOutTheLessCertainOfTwoCausesThatAreNearlyAlike) {
  for (const std::size_t real : {0u, 1u}) {
    std::vector<std::vector<MotionError>> drives(1);
    for (const double sign : {1.0, -1.0}) {
      Random random(1);
      for (int i = 0; i < 800; ++i) {
        MotionError piece;
        piece.causes[real] = 1.0;
        piece.causes[1 - real] = 1.0 + 0.2 * random.gaussian();
        piece.error = 0.25 + sign * random.gaussian();
        piece.roughness = {1.0, 0.0};
        drives[0].push_back(piece);
      }
    }
    const MotionFit fit = fitMotion(drives);
    EXPECT_EQ(fit.scale[1 - real], 0.0) << real;
    EXPECT_NEAR(fit.scale[real], 0.25, 4 * 0.025) << real;
  }
}

TEST(MotionFit, KeepsBothCausesWhereBothAreCertain) {
  Random random(3);
  std::vector<std::vector<MotionError>> drives(1);
  for (int i = 0; i < 1600; ++i) {
    MotionError piece;
    piece.causes = {1.0, random.gaussian()};
    piece.error = 0.2 * piece.causes[0] - 0.3 * piece.causes[1] + random.gaussian();
    piece.roughness = {1.0, 0.0};
    drives[0].push_back(piece);
  }
  const MotionFit fit = fitMotion(drives);
  EXPECT_NEAR(fit.scale[0], 0.2, 4 * 0.025);
  EXPECT_NEAR(fit.scale[1], -0.3, 4 * 0.025);
}

// Its rounds take as long as the logs are: a watch over plugins must not take that for a hang.
TEST(MotionFit, SaysInEachRoundThatItGoesOn) {
  const std::vector<std::vector<MotionError>> drives(1,
                                                     std::vector<MotionError>(30, {1.0, {}, {}}));
  const std::uint64_t before = pluginProgress();
  fitMotion(drives);
  EXPECT_GE(pluginProgress() - before, 100U);
}

}  // namespace
}  // namespace ortung
