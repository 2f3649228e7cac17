// Recordings of five buildings, whose maps are the floors of one: the robot is found on the right
// one, and localized as in its own map alone.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "Files.hpp"
#include "Paths.hpp"
#include "Program.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;

const std::array<const char*, 5> kLogs{"mrpt_uwb_ro", "carmen/belgioioso", "carmen/fhw",
                                       "carmen/freiburg-079", "mrpt_sena_telecom"};

class RealFloors : public ::testing::TestWithParam<std::size_t> {
 protected:
  void run(const std::vector<std::string>& words) const {
    const Outcome outcome = ortung(words);
    ASSERT_EQ(outcome.exitCode, 0) << words.front() << ": " << outcome.err;
  }
  std::string path(const std::string& name) const { return folder_ / name; }

  /// Imports a recording. @returns the keys of its map
  std::string import(std::size_t log) const {
    const std::string name = std::to_string(log);
    run({"import", std::string("scanlog:" ORTUNG_SHARED_DATA "/") + kLogs[log], "--out",
         path(name + ".rec"), "--world", path(name + ".toml"), "--robot-file",
         path(name + "_robot.toml")});
    const std::string world = readBytes(path(name + ".toml"));
    const std::size_t begin = world.find("[[grid]]\n") + 9;
    return world.substr(begin, world.find("\n[", begin) - begin);
  }
  nlohmann::json figuresIn(const std::string& world, const std::string& log) const {
    run({"learn", "--world", path(world), "--robot", path(log + "_robot.toml"), "--out",
         path("t.ortung"), "--force"});
    run({"eval", "--source", "record:" + path(log + ".rec"), "--robot", path(log + "_robot.toml"),
         "--tables", path("t.ortung"), "--any-world", "--json", path("e.json"), "--force"});
    return nlohmann::json::parse(readBytes(path("e.json")), nullptr, false);
  }

  TemporaryFolder folder_;
};

TEST_P(RealFloors, ARecordingIsLocalizedAsOnItsOwn) {
  for (const char* log : kLogs)
    if (!fs::is_directory(fs::path(ORTUNG_SHARED_DATA) / log))
      GTEST_SKIP() << ORTUNG_SHARED_DATA << "/" << log << " is not here";
  // The robot's own map is the first floor, since what is known of its way is in the map's frame.
  const std::size_t own = GetParam();
  std::string building = "[world]\nname = \"building\"\n";
  for (std::size_t i = 0; i < kLogs.size(); ++i) {
    const std::size_t log = (own + i) % kLogs.size();
    building += "\n[[floor]]\nname = \"f" + std::to_string(log) + "\"\n" + import(log) + "\n";
  }
  writeBytes(path("building.toml"), building);
  const std::string log = std::to_string(own);
  const nlohmann::json alone = figuresIn(log + ".toml", log);
  const nlohmann::json among = figuresIn("building.toml", log);
  const auto number = [](const nlohmann::json& figures, const char* key) {
    return figures.at(key).get<double>();
  };
  EXPECT_LT(number(among, "converged_after_s"), 5.0);
  EXPECT_LT(number(among, "position_median_m"), 1.15 * number(alone, "position_median_m"));
  EXPECT_LT(number(among, "position_rmse_m"), 1.15 * number(alone, "position_rmse_m"));
  EXPECT_GT(number(among, "tracking_share"), number(alone, "tracking_share") - 0.05);
  EXPECT_EQ(number(among, "wrong_while_tracking_share"), 0.0);
}

INSTANTIATE_TEST_SUITE_P(FiveMaps, RealFloors, ::testing::Values(std::size_t{0}));

}  // namespace
}  // namespace ortung::test
