// What the player that learns tells its team.
#include <gtest/gtest.h>

#include "WorldFiles.hpp"
#include "ortung/sim/PlayerWish.hpp"
#include "ortung/sim/SceneRun.hpp"

namespace ortung {
namespace {

/// A room of 6 x 4 m, perhaps with a wall of 0.1 m all across, 2 m from its left end.
std::string roomToml(bool isDivided) {
  const auto wall = [](double x, double y, double width, double height) {
    return "[[rectangle]]\ncenter_m = [" + std::to_string(x) + ", " + std::to_string(y) +
           "]\nsize_m = [" + std::to_string(width) + ", " + std::to_string(height) + "]\n";
  };
  return "[world]\nx_m = [-3, 3]\ny_m = [-2, 2]\n" + wall(-3.05, 0.0, 0.1, 4.2) +
         wall(3.05, 0.0, 0.1, 4.2) + wall(0.0, -2.05, 6.2, 0.1) + wall(0.0, 2.05, 6.2, 0.1) +
         (isDivided ? wall(-0.95, 0.0, 0.1, 4.0) : "");
}

/// What it says until it has learned all.
std::vector<std::string> saidIn(bool isDivided, const std::string& options) {
  const test::TemporaryFolder folder;
  Scene scene;
  scene.world = folder.write("room.toml", roomToml(isDivided));
  const auto robot = folder.write("r.toml",
                                  "[robot]\nradius_m = 0.2\n[[sensor]]\nplugin = \"lrf\"\n"
                                  "beams = 3\nfov_deg = 180\nmax_range_m = 8\n");
  PluginFactory factory(PluginFactory::standardFolders());
  std::string problem;
  SceneRun run(scene, {}, factory,
               {.budget = 0.0, .onProblem = [&](const std::string& what) { problem = what; }});
  run.players().join("ear", "team");
  run.addPlayer(parsePlayer("learner:robot=" + robot.string() +
                            "&start=1,0,0&out=" + (folder.path() / "t.ortung").string() +
                            "&cell_m=0.1&heading_step_deg=90" + options + "@team"),
                1);
  std::vector<std::string> said;
  constexpr Timestamp kLatest = 600'000'000;
  while (!run.players().isEmpty() && run.simulation().now() < kLatest) {
    run.step();
    for (const Heard& heard : run.players().takeHeard("ear")) said.push_back(heard.text);
  }
  EXPECT_EQ(problem, "");
  EXPECT_TRUE(run.players().isEmpty()) << "it learns for ever";
  return said;
}

/// How many square metres it says it leaves out; 0 if it says nothing of that.
double leftOutIn(const std::vector<std::string>& said) {
  const std::string begin = "leaves out ";
  for (const std::string& text : said)
    if (text.starts_with(begin)) return std::stod(text.substr(begin.size()));
  return 0.0;
}

// Its centre keeps 0.2 m from the walls: on one side of the wall there are 1.6 x 3.6 m for it, on
// the other 3.5 x 3.6 m. The cells at the edge may belong to it or not.
TEST(LearnerPlayer, SaysHowMuchOfTheFloorItLeavesOut) {
  EXPECT_EQ(leftOutIn(saidIn(false, "")), 0.0);
  EXPECT_NEAR(leftOutIn(saidIn(true, "")), 1.6 * 3.6, 0.1 * (1.6 + 3.6) * 2);
  EXPECT_NEAR(leftOutIn(saidIn(true, "&area=-2;0")), 3.5 * 3.6, 0.1 * (3.5 + 3.6) * 2);
  EXPECT_EQ(leftOutIn(saidIn(true, "&area=all")), 0.0);
}

TEST(LearnerPlayer, SaysHowFarItIsWithOneThreadOrThree) {
  for (const char* threads : {"", "&threads=3"}) {
    double last = -1.0;
    for (const std::string& text : saidIn(false, threads)) {
      const std::string begin = "learned ";
      if (!text.starts_with(begin)) continue;
      const double share = std::stod(text.substr(begin.size()));
      EXPECT_GT(share, last) << threads;
      EXPECT_LE(share, 100.0) << threads;
      last = share;
    }
  }
}

}  // namespace
}  // namespace ortung
