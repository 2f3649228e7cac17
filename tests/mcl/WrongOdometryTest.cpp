// Wheels that spin on the spot: readings alone say where the robot is.
#include <gtest/gtest.h>

#include <algorithm>

#include "FakeRun.hpp"

namespace ortung {
namespace {

// Odometry carries samples 0.2 m off from reading to reading, which tell places to centimetres.
// Those that process noise moves instead fit as well as ever, so from when odometry is no longer
// believed the robot is not lost for a moment.
TEST(WrongOdometry, WheelsThatSpinCarryNobodyAway) {
  for (const double spin : {2.0, 3.0}) {  // [m/s]
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      test::FakeRun run;
      MclConfig config = run.config();
      config.seed = seed;
      const auto mcl = run.mcl(config);
      const Pose2 start{-1.0, -0.5, 0.5 * static_cast<double>(seed)};
      run.begin(start, seed);
      mcl->startAt(start, 0.05, 0.05);
      const auto errorAfter = [&](double speed, double turn) {
        run.drive(speed, turn);
        mcl->update(run.container);
        return distance(mcl->estimate(run.stamp)->pose, run.truth);
      };
      for (int i = 0; i < 50; ++i) ASSERT_LT(errorAfter(0.3, 0.2), 0.1);
      run.spin = spin;
      double worst = 0.0;
      for (int i = 0; i < 100; ++i) {
        const double error = errorAfter(0.0, 0.0);
        if (i >= 30) worst = std::max(worst, error);  // 3 s, until it is noticed
      }
      EXPECT_LT(worst, 0.05) << spin << " m/s, seed " << seed;
    }
  }
}

}  // namespace
}  // namespace ortung
