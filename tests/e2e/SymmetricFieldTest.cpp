// A soccer field looks the same from two opposite poses to a laser scanner. No reading of it ever
// tells which one is right, so the status must not be "tracking", however long the robot drives.
#include "Folder.hpp"
#include "Paths.hpp"

namespace ortung::test {
namespace {

class SymmetricField : public testing::Test {
 protected:
  nlohmann::json localized(const std::string& world, const std::string& robot) const {
    const std::string maps = ORTUNG_SOURCE_DIR "/maps";
    const std::string field = maps + "/fields/" + world + ".toml";
    const std::string file = maps + "/robots/" + robot + ".toml";
    folder_.run(
        {"learn", "--world", field, "--robot", file, "--out", folder_.path("t.ortung"), "--force"});
    std::vector<std::string> words = {"--robot", file, "--tables", folder_.path("t.ortung"),
                                      "--force"};
    for (int seed = 1; seed <= 6; ++seed) {
      words.emplace_back("--source");
      words.push_back("sim:" + field + "?duration=30&seed=" + std::to_string(seed));
    }
    return folder_.eval(words);
  }
  const Folder folder_;
};

TEST_F(SymmetricField, IsNeverTrackedByALaserAlone) {
  const nlohmann::json all = localized("f2000", "pioneer_lrf");
  for (const auto& run : all.at("runs"))
    EXPECT_EQ(run.at("tracking_share"), 0.0) << run.at("source");
}

TEST_F(SymmetricField, IsTrackedWithPostsOfTwoColours) {
  const nlohmann::json all = localized("f2000", "pioneer");
  for (const auto& run : all.at("runs")) {
    EXPECT_GT(run.at("tracking_share"), 0.7) << run.at("source");
    EXPECT_EQ(run.at("wrong_while_tracking_share"), 0.0) << run.at("source");
  }
}

TEST_F(SymmetricField, IsTrackedByALaserInAHallWithFurniture) {
  const nlohmann::json all = localized("f2000_hall", "pioneer_lrf");
  for (const auto& run : all.at("runs")) {
    EXPECT_GT(run.at("tracking_share"), 0.7) << run.at("source");
    EXPECT_EQ(run.at("wrong_while_tracking_share"), 0.0) << run.at("source");
  }
}

}  // namespace
}  // namespace ortung::test
