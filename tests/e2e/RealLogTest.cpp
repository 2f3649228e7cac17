#include "Folder.hpp"

namespace ortung::test {
namespace {

const std::string kRun = ORTUNG_SHARED_DATA "/utias_mrclam/ds6";

/// A recording of a real robot among landmarks, with ground truth from motion capture.
TEST(RealLog, RobotAmongLandmarksIsTrackedFromAnUnknownStart) {
  if (!std::filesystem::is_directory(kRun)) {
    GTEST_SKIP() << kRun << " is not here; it belongs to no repository";
  }
  const Folder folder;
  folder.run({"import", "mrclam", kRun, "--robot", "2", "--out", folder.path("run.rec"), "--world",
              folder.path("world.toml"), "--robot-file", folder.path("robot.toml")});
  folder.run(
      {"check", folder.path("run.rec"), folder.path("world.toml"), folder.path("robot.toml")});
  folder.run({"learn", "--world", folder.path("world.toml"), "--robot", folder.path("robot.toml"),
              "--out", folder.path("world.ortung"), "--cell", "0.05"});
  const auto figures =
      folder.eval({"--source", "record:" + folder.path("run.rec"), "--robot",
                   folder.path("robot.toml"), "--tables", folder.path("world.ortung")});
  EXPECT_GT(figures["duration_s"].get<double>(), 600.0);
  EXPECT_FALSE(figures["converged_after_s"].is_null());
  // Ranges to landmarks are good to 0.06-0.24 m, and dead reckoning drifts 0.24-0.53 m a minute.
  EXPECT_LT(figures["position_median_m"].get<double>(), 0.3);
  EXPECT_LT(figures["lost_share"].get<double>(), 0.05);
}

}  // namespace
}  // namespace ortung::test
