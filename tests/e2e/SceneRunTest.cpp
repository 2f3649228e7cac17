#include "Folder.hpp"
#include "Paths.hpp"

namespace ortung::test {
namespace {

const std::string kScene = ORTUNG_SOURCE_DIR "/maps/scenes/kick.toml";
const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/msl.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/msl_omni.toml";

TEST(SceneRun, ReplayedFromItsLogGivesTheSameLocalizationAsLive) {
  const Folder folder;
  const std::string tables = folder.path("msl.ortung");
  const std::string record = folder.path("scene.rec");
  folder.run({"learn", "--world", kWorld, "--robot", kRobot, "--out", tables, "--cell", "0.2",
              "--heading-step", "5"});
  folder.run({"sim", kScene, "--duration", "15", "--free-run", "--seed", "3", "--record", record});
  const auto eval = [&](const std::string& source) {
    auto figures = folder.eval({"--source", source, "--robot", kRobot, "--tables", tables,
                                "--start", "truth", "--particles", "500"});
    for (const char* differs :
         {"source", "update_ms_p50", "update_ms_p99", "update_ms_max", "realtime_factor"})
      figures.erase(differs);
    return figures;
  };
  const auto live = eval("sim:" + kScene + "?duration=15&seed=3");
  const auto replayed = eval("record:" + record);
  EXPECT_EQ(live, replayed);
  EXPECT_GT(live["compared_steps"].get<int>(), 30);
  EXPECT_LT(live["position_median_m"].get<double>(), 0.3);
}

}  // namespace
}  // namespace ortung::test
