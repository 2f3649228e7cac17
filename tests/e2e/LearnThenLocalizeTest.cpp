#include "Folder.hpp"
#include "Paths.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";

/// The robot that ships, on the field that ships.
class LearnThenLocalize : public testing::Test {
 protected:
  LearnThenLocalize() {
    folder_.run({"learn", "--world", kWorld, "--robot", kRobot, "--out", tables_});
  }
  nlohmann::json eval(const std::string& source, std::vector<std::string> more) const {
    more.insert(more.end(), {"--source", source, "--robot", kRobot, "--tables", tables_});
    return folder_.eval(more);
  }

  Folder folder_;
  std::string tables_ = folder_.path("f2000.ortung");
  std::string drive_ = "sim:" + kWorld + "?duration=60&seed=4";
};

TEST_F(LearnThenLocalize, TracksADriveFromAKnownStart) {
  const auto figures = eval(drive_, {"--start", "truth"});
  EXPECT_NEAR(figures["duration_s"].get<double>(), 60.0, 0.2);
  EXPECT_GT(figures["compared_steps"].get<int>(), 100);
  EXPECT_LT(figures["position_median_m"].get<double>(), 0.1);  // a cell
  EXPECT_LT(figures["heading_rmse_deg"].get<double>(), 3.0);
  EXPECT_EQ(figures["lost_share"], 0.0);
}

TEST_F(LearnThenLocalize, FindsItselfFromAnUnknownStart) {
  const auto figures = eval(drive_, {"--start", "global", "--seed", "2"});
  ASSERT_FALSE(figures["converged_after_s"].is_null());
  EXPECT_LT(figures["converged_after_s"].get<double>(), 20.0);
  EXPECT_LT(figures["position_median_m"].get<double>(), 0.1);
}

TEST_F(LearnThenLocalize, RecordOfARunGivesTheSameFiguresAsTheRun) {
  const std::string record = folder_.path("run.rec");
  auto live = eval(drive_, {"--record", record});
  auto replayed = eval("record:" + record, {});
  for (const char* differs :
       {"source", "update_ms_p50", "update_ms_p99", "update_ms_max", "realtime_factor"}) {
    live.erase(differs);
    replayed.erase(differs);
  }
  EXPECT_EQ(live, replayed);
}

}  // namespace
}  // namespace ortung::test
