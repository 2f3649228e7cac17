// Recordings of real robots with ground truth from elsewhere, localized by the program.
#include "Folder.hpp"
#include "Paths.hpp"

namespace ortung::test {
namespace {

const std::string kData = ORTUNG_SHARED_DATA;

bool isHere(const std::string& path) { return std::filesystem::exists(path); }

struct Expected {
  int robot;
  double median;  ///< [m]
  double rmse;    ///< [m]
};

void PrintTo(const Expected& one, std::ostream* out) {  // NOLINT: GoogleTest looks for this name
  *out << "robot " << one.robot;
}

/// Five robots among landmarks, truth by motion capture. Ranges to landmarks are good to 2 to 3 %
/// with the biases of all cameras taken off, dead reckoning drifts 0.24 to 0.53 m a minute, and for
/// up to 78 s nothing is seen.
class MrclamLog : public testing::TestWithParam<Expected> {};

TEST_P(MrclamLog, IsTrackedFromAnUnknownStart) {
  const std::string run = kData + "/utias_mrclam/ds6";
  if (!isHere(run)) GTEST_SKIP() << run << " is not here; it belongs to no repository";
  const Folder folder;
  folder.run({"import", "mrclam", run, "--robot", std::to_string(GetParam().robot), "--out",
              folder.path("run.rec"), "--world", folder.path("world.toml"), "--robot-file",
              folder.path("robot.toml")});
  folder.run(
      {"check", folder.path("run.rec"), folder.path("world.toml"), folder.path("robot.toml")});
  folder.run({"learn", "--world", folder.path("world.toml"), "--robot", folder.path("robot.toml"),
              "--out", folder.path("world.ortung"), "--cell", "0.05"});
  const auto figures = folder.eval({"--source", "record:" + folder.path("run.rec"), "--robot",
                                    folder.path("robot.toml"), "--tables",
                                    folder.path("world.ortung"), "--seed", "2"});
  EXPECT_GT(figures["duration_s"].get<double>(), 600.0);
  EXPECT_GT(figures["compared_moments"].get<int>(), 7000) << "over time, not at updates alone";
  ASSERT_FALSE(figures["converged_after_s"].is_null());
  EXPECT_LT(figures["position_median_m"].get<double>(), GetParam().median);
  EXPECT_LT(figures["position_rmse_m"].get<double>(), GetParam().rmse);
  EXPECT_LT(figures["lost_share"].get<double>(), 0.03);
  EXPECT_LT(figures["at_corrections"]["position_rmse_m"].get<double>(),
            1.1 * figures["position_rmse_m"].get<double>());
}

// A third above what is measured, so that no more than chance fits in between.
INSTANTIATE_TEST_SUITE_P(RealLog, MrclamLog,
                         testing::Values(Expected{1, 0.08, 0.16}, Expected{2, 0.10, 0.20},
                                         Expected{3, 0.06, 0.13}, Expected{4, 0.10, 0.15},
                                         Expected{5, 0.08, 0.12}),
                         [](const auto& one) { return "Robot" + std::to_string(one.param.robot); });

// What one run says of a camera holds in another: its landmarks stand elsewhere, and of its truth
// there are moments alone in which the robot stood.
TEST(MrclamRuns, AreTrackedBetterWithBiasesThatAnotherRunTells) {
  const std::string runs = kData + "/utias_mrclam/";
  if (!isHere(runs)) GTEST_SKIP() << runs << " is not here; it belongs to no repository";
  const Folder folder;
  for (const std::string run : {"ds2", "ds6"}) {
    folder.run({"import", "mrclam", runs + run, "--robot", "3", "--out", folder.path(run + ".rec"),
                "--world", folder.path(run + ".toml"), "--robot-file", folder.path("robot.toml"),
                "--force"});
    folder.run({"learn", "--world", folder.path(run + ".toml"), "--robot",
                folder.path("robot.toml"), "--out", folder.path(run + ".ortung"), "--cell",
                "0.05"});
  }
  folder.run({"calibrate", "noise", folder.path("ds2.rec"), "--robot", folder.path("robot.toml"),
              "--tables", folder.path("ds2.ortung"), "--fixed", "mount,latency", "--out",
              folder.path("learned.toml")});
  const auto median = [&](const std::string& robot) {
    return folder
        .eval({"--source", "record:" + folder.path("ds6.rec"), "--robot", folder.path(robot),
               "--tables", folder.path("ds6.ortung")})["position_median_m"]
        .get<double>();
  };
  const double learned = median("learned.toml");
  EXPECT_LT(learned, 0.042);  // 0.031 measured, 0.042 as imported
  EXPECT_LT(learned, 0.9 * median("robot.toml"));
}

/// A log of scans, and the tables of its map: run.rec, robot.toml and world.ortung.
void importAndLearn(const std::string& log, const Folder& folder) {
  folder.run({"import", "scanlog", log, "--out", folder.path("run.rec"), "--world",
              folder.path("world.toml"), "--robot-file", folder.path("robot.toml")});
  folder.run({"learn", "--world", folder.path("world.toml"), "--robot", folder.path("robot.toml"),
              "--out", folder.path("world.ortung")});
}

/// Logs that carried the filter away: visitors before the scanner, odometry with the wrong sign.
class HardLog : public testing::TestWithParam<const char*> {};

TEST_P(HardLog, IsNeverLeft) {
  const std::string log = kData + "/carmen/" + GetParam();
  if (!isHere(log)) GTEST_SKIP() << log << " is not here; it belongs to no repository";
  const Folder folder;
  importAndLearn(log, folder);
  for (const char* start : {"truth", "global"}) {
    const auto figures = folder.eval({"--source", "record:" + folder.path("run.rec"), "--robot",
                                      folder.path("robot.toml"), "--tables",
                                      folder.path("world.ortung"), "--start", start});
    ASSERT_FALSE(figures["converged_after_s"].is_null());
    EXPECT_LT(figures["lost_share"].get<double>(), 0.005) << start;
    EXPECT_LT(figures["position_median_m"].get<double>(), 0.06) << start;
    EXPECT_LT(figures["position_rmse_m"].get<double>(), 0.15) << start;
    EXPECT_LT(figures["nees_mean"].get<double>(), 12.0) << start;
  }
}

INSTANTIATE_TEST_SUITE_P(RealLog, HardLog, testing::Values("fhw", "freiburg-079"),
                         [](const auto& one) {
                           return std::string(one.param) == "fhw" ? "Visitors" : "LyingOdometry";
                         });

struct Exactness {
  const char* log;
  double rmse;  ///< at updates, from a known start; a sixth above what is measured [m]
};

/// Logs whose maps have walls in several rows of cells, and which cost a third of the exactness
/// when beams were compared with the foremost of them.
class ExactLog : public testing::TestWithParam<Exactness> {};

TEST_P(ExactLog, IsTrackedWithinCentimetres) {
  const std::string log = kData + "/" + GetParam().log;
  if (!isHere(log)) GTEST_SKIP() << log << " is not here; it belongs to no repository";
  const Folder folder;
  importAndLearn(log, folder);
  const auto figures = folder.eval({"--source", "record:" + folder.path("run.rec"), "--robot",
                                    folder.path("robot.toml"), "--tables",
                                    folder.path("world.ortung"), "--start", "truth"});
  EXPECT_LT(figures["at_corrections"]["position_rmse_m"].get<double>(), GetParam().rmse);
  EXPECT_LT(figures["nees_mean"].get<double>(), 4.5);
  EXPECT_EQ(figures["lost_share"].get<double>(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(RealLog, ExactLog,
                         testing::Values(Exactness{"mrpt_sena_telecom", 0.046},
                                         Exactness{"mrpt_localization_demo", 0.034},
                                         Exactness{"carmen/freiburg-101", 0.0355},
                                         Exactness{"carmen/intel", 0.037}),
                         [](const auto& one) {
                           std::string name = std::filesystem::path(one.param.log).filename();
                           std::erase_if(name, [](char c) { return c == '_' || c == '-'; });
                           return name;
                         });

/// A laser in a building: 9 s, scans four times a second, truth by matching scans to the map.
TEST(RealLog, LaserInABuildingIsTrackedFromAnUnknownStart) {
  const std::string log = kData + "/mrpt_localization_demo";
  if (!isHere(log)) GTEST_SKIP() << log << " is not here; it belongs to no repository";
  const Folder folder;
  importAndLearn(log, folder);
  const auto figures =
      folder.eval({"--source", "record:" + folder.path("run.rec"), "--robot",
                   folder.path("robot.toml"), "--tables", folder.path("world.ortung")});
  ASSERT_FALSE(figures["converged_after_s"].is_null());
  EXPECT_LT(figures["converged_after_s"].get<double>(), 1.0) << "with the first scans";
  EXPECT_GT(figures["compared_moments"].get<int>(), 80);
  EXPECT_LT(figures["position_median_m"].get<double>(), 0.05);
  EXPECT_LT(figures["position_rmse_m"].get<double>(), 0.08);
  EXPECT_LT(figures["heading_rmse_deg"].get<double>(), 1.0);
  EXPECT_EQ(figures["lost_share"].get<double>(), 0.0);
  EXPECT_LT(figures["nees_mean"].get<double>(), 5.0);
  EXPECT_LT(figures["at_corrections"]["position_rmse_m"].get<double>(), 0.04);
}

}  // namespace
}  // namespace ortung::test
