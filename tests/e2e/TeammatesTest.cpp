// A robot without scanner or camera knows where it is by what team mates say of it.
#include "Folder.hpp"
#include "Paths.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml";
const std::string kBlind = ORTUNG_SOURCE_DIR "/maps/robots/pioneer_blind.toml";

TEST(Teammates, TellABlindRobotWhereItIs) {
  const Folder folder;
  const std::string tables = folder.path("blind.ortung");
  folder.run({"learn", "--world", kWorld, "--robot", kBlind, "--out", tables});
  const auto drive = [&](const std::string& record, const std::string& team) {
    folder.run({"sim", kWorld, "--player", "wander:name=anna&robot=" + kBlind + "@blue", "--player",
                "lookout:of=anna&start=-5,3.5,0@" + team, "--player",
                "lookout:of=anna&start=5,-3.5,90@" + team, "--duration", "60", "--free-run",
                "--recorded", "anna", "--record", record});
  };
  drive(folder.path("told.rec"), "blue");
  const auto figures = folder.eval(
      {"--source", "record:" + folder.path("told.rec"), "--robot", kBlind, "--tables", tables});
  EXPECT_GT(figures["compared_steps"].get<int>(), 150);
  EXPECT_LT(figures["position_median_m"].get<double>(), 0.1);
  EXPECT_LT(figures["position_p95_m"].get<double>(), 0.3);
  EXPECT_LT(figures["heading_rmse_deg"].get<double>(), 5.0);
  EXPECT_GT(figures["tracking_share"].get<double>(), 0.5);
  EXPECT_EQ(figures["wrong_while_tracking_share"].get<double>(), 0.0);
  // Of another team nobody tells it anything.
  drive(folder.path("alone.rec"), "yellow");
  const Outcome alone = ortung({"eval", "--source", "record:" + folder.path("alone.rec"), "--robot",
                                kBlind, "--tables", tables});
  EXPECT_EQ(alone.exitCode, 1);
  EXPECT_NE(alone.err.find("has no reading that depends on the pose"), alone.err.npos);
}

}  // namespace
}  // namespace ortung::test
