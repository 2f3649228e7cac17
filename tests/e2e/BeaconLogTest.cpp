// Recordings of ranges and bearings of beacons, with truth from elsewhere, localized by the
// program. What was fitted to a log was fitted to its first half; these are the second halves.
#include "Folder.hpp"
#include "Paths.hpp"

namespace ortung::test {
namespace {

const std::string kData = ORTUNG_SHARED_DATA;

struct Log {
  const char* kind;
  const char* path;
  std::vector<std::string> options;
  const char* cell;
  const char* part;
  double median;  ///< a third above what is measured [m]
  double rmse;    ///< likewise
};

void PrintTo(const Log& one, std::ostream* out) {  // NOLINT: GoogleTest looks for this name
  *out << one.kind;
}

std::vector<std::string> operator+(std::vector<std::string> some,
                                   const std::vector<std::string>& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

void import(const Folder& folder, const std::string& kind, const std::string& path,
            const std::vector<std::string>& options) {
  folder.run(std::vector<std::string>{"import", kind, path, "--out", folder.path("run.rec"),
                                      "--world", folder.path("world.toml"), "--robot-file",
                                      folder.path("robot.toml")} +
             options);
}

void learn(const Folder& folder, const std::string& cell) {
  folder.run({"learn", "--world", folder.path("world.toml"), "--robot", folder.path("robot.toml"),
              "--out", folder.path("world.ortung"), "--cell", cell, "--force"});
}

nlohmann::json localized(const Folder& folder, const std::string& robot, const std::string& part,
                         const std::vector<std::string>& more = {}) {
  return folder.eval(std::vector<std::string>{"--source", "record:" + folder.path("run.rec") + part,
                                              "--robot", folder.path(robot), "--tables",
                                              folder.path("world.ortung"), "--force"} +
                     more);
}

class BeaconLog : public testing::TestWithParam<Log> {};

TEST_P(BeaconLog, IsTrackedFromAnUnknownStart) {
  const Log& log = GetParam();
  const std::string path = kData + "/" + log.path;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const Folder folder;
  // Its path is what the files' names begin with.
  import(folder, log.kind, path.substr(0, path.find("_motors.txt")), log.options);
  learn(folder, log.cell);
  const auto figures = localized(folder, "robot.toml", log.part);
  ASSERT_FALSE(figures["converged_after_s"].is_null());
  EXPECT_LT(figures["position_median_m"].get<double>(), log.median);
  EXPECT_LT(figures["position_rmse_m"].get<double>(), log.rmse);
  EXPECT_LT(figures["lost_share"].get<double>(), 0.04);
}

INSTANTIATE_TEST_SUITE_P(
    RealLog, BeaconLog,
    testing::Values(
        Log{"plaza", "plaza", {}, "0.5", "?from_s=970", 0.28, 0.46},
        Log{"uwbpose",
            "uwb_planar_pose",
            {"--option", "range_bias_m=0.19"},
            "0.1",
            "?from_s=65",
            0.07,
            0.09},
        // Cylinders that nobody tells apart, found in its scans.
        Log{"lego", "lego_brenner/robot4_motors.txt", {}, "0.1", "?from_s=27", 0.08, 0.09},
        Log{"roh", "roh_bearings/(X4.5,Y1.5).csv", {}, "0.05", "", 0.21, 0.24}),
    [](const auto& one) { return std::string(one.param.kind); });

/// Beacon 1 is wrong for minutes at a time.
constexpr const char* kBeacons = R"([[sensor]]
plugin = "landmarks"
model = "uwb"
type = "landmarks"
features = "distances"
kind = "beacon"
identities = [2, 3]
pose = { x_m = 0.16, z_m = 1.0 }
slant = true
max_range_m = 40
range_sigma_m = 0.12
outliers = 0.02
exponent = 0.5

[[sensor]]
plugin = "landmarks"
model = "uwb"
type = "landmarks"
features = "distances"
kind = "beacon"
identities = [1]
pose = { x_m = 0.16, z_m = 1.0 }
slant = true
max_range_m = 40
range_sigma_m = 0.2
outliers = 0.4
exponent = 0.5
)";

std::string textOf(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(BeaconLog, AScaleThatIsOffBySevenPercentIsLearnedOnTheWay) {
  const std::string path = kData + "/plaza";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const Folder folder;
  import(folder, "plaza", path, {});
  std::string robot = textOf(folder.path("robot.toml"));
  const std::string scale = "range_scale = 1.07";
  ASSERT_NE(robot.find(scale), std::string::npos);
  robot.replace(robot.find(scale), scale.size(), "range_scale = 1.00");
  std::ofstream(folder.path("robot.toml")) << robot;
  learn(folder, "0.5");
  const std::string part = "?from_s=970";
  // Until it is learned, chance decides for how long the robot is lost, and whether it is found at
  // all: in one of twenty runs it is not. Then it stays known, also while the mower's wheels are
  // stuck, six minutes later.
  int found = 0;
  for (const char* seed : {"2", "3", "4", "5"}) {
    const auto learned = localized(folder, "robot.toml", part, {"--seed", seed});
    if (learned["converged_after_s"].is_null()) continue;
    const auto median = learned["position_median_m"].get<double>();
    const auto lost = learned["lost_share"].get<double>();
    RecordProperty(std::string("median_m_of_seed_") + seed, std::to_string(median));
    RecordProperty(std::string("lost_share_of_seed_") + seed, std::to_string(lost));
    if (median < 0.28 && lost < 0.07) ++found;
  }
  EXPECT_GE(found, 3);
  robot.insert(robot.find("[mcl]") + 5, "\nlearns_biases = false");
  std::ofstream(folder.path("stubborn.toml")) << robot;
  const auto stubborn = localized(folder, "stubborn.toml", part, {"--seed", "2"});
  EXPECT_TRUE(stubborn["converged_after_s"].is_null());
}

TEST(BeaconLog, ALaserWithOneScanInTwentyAndThreeBeaconsAreBetterThanEither) {
  const std::string data = kData + "/mrpt_uwb_ro/";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is not here";
  const Folder folder;
  import(folder, "rawlog", data + "raw/uwb_ro-localization_demo.rawlog",
         {"--option", "gt=" + data + "ref.txt", "--option", "map=" + data + "map.yaml", "--option",
          "beacons=" + data + "beacons.txt"});
  const std::string imported = textOf(folder.path("robot.toml"));
  const std::string laser = imported.substr(0, imported.rfind("[[sensor]]"));
  const std::size_t scanner = laser.rfind("[[sensor]]");
  std::ofstream(folder.path("laser.toml")) << laser;
  std::ofstream(folder.path("robot.toml")) << laser << kBeacons;
  std::ofstream(folder.path("ranges.toml")) << laser.substr(0, scanner) << kBeacons;
  learn(folder, "0.1");
  const std::vector<std::string> fault = {"--fault", "laser/LRF/scan=drop:0.95"};
  const auto rmse = [&](const std::string& robot, const std::vector<std::string>& more) {
    return localized(folder, robot, "?from_s=180", more)["position_rmse_m"].get<double>();
  };
  const double both = rmse("robot.toml", fault);
  EXPECT_LT(both, rmse("laser.toml", fault));
  EXPECT_LT(both, rmse("ranges.toml", {}));
  EXPECT_LT(both, 0.19);  // 0.14 measured; 0.20 by ranges, 0.25 by the laser
}

// Six reflectors that nobody tells apart; the truth is of the same navigation scanner, by its own
// association. They are told from each other from an unknown start.
TEST(BeaconLog, ReflectorsWithoutIdentityTellWhereTheRobotIs) {
  const std::string data = kData + "/crob_lab_jarvis/";
  const std::string run = data + "complex_path_fast/";
  if (!std::filesystem::exists(run)) GTEST_SKIP() << run << " is not here";
  const Folder folder;
  import(folder, "scanlog", run + "security",
         {"--option", "map=" + data + "map_security_from_complex.yaml", "--option",
          "odom=" + run + "odom.txt.xz", "--option", "reflectors=" + run + "reflectors.txt.xz",
          "--option", "reflector_map=" + data + "reflector_map.txt"});
  const std::string imported = textOf(folder.path("robot.toml"));
  const std::size_t scanner = imported.find("[[sensor]]\nplugin = \"lrf\"");
  const std::size_t reflectors = imported.find("[[sensor]]\nplugin = \"landmarks\"");
  ASSERT_LT(scanner, reflectors);
  std::ofstream(folder.path("robot.toml"))
      << imported.substr(0, scanner) << imported.substr(reflectors);
  learn(folder, "0.1");
  const auto figures = localized(folder, "robot.toml", "");
  ASSERT_FALSE(figures["converged_after_s"].is_null());
  EXPECT_LT(figures["converged_after_s"].get<double>(), 10.0);
  EXPECT_LT(figures["position_median_m"].get<double>(), 0.03);
  EXPECT_LT(figures["position_rmse_m"].get<double>(), 0.051);
  EXPECT_LT(figures["heading_rmse_deg"].get<double>(), 0.4);
  EXPECT_EQ(figures["lost_share"].get<double>(), 0.0);
}

}  // namespace
}  // namespace ortung::test
