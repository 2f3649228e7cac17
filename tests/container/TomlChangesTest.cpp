// Values that a process reads in place of those of a file.
#include <gtest/gtest.h>

#include "Files.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

class TomlChanges : public testing::Test {
 protected:
  TomlChanges() : file_(folder_ / "robot.toml") { test::writeBytes(file_, kText); }
  std::string refusal(const std::string& key, const std::string& value = "1") const {
    try {
      changeToml(file_, key, value);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "(nothing was thrown)";
  }

  static constexpr const char* kText = R"([robot]
name = "scout"

[[sensor]]
plugin = "lrf"
model = "front"
sigma_m = 0.05

[[sensor]]
plugin = "lrf"
model = "rear"
sigma_m = 0.05

[mcl]
particles = 500
)";
  test::TemporaryFolder folder_;
  std::filesystem::path file_;
};

TEST_F(TomlChanges, AreSeenByAllWhoReadAndTheFileStays) {
  changeToml(file_, "mcl.particles", "2000");
  EXPECT_EQ(readToml(file_).table("mcl").integer("particles"), 2000);
  EXPECT_EQ(parseToml(readTomlText(file_), "x").table("mcl").integer("particles"), 2000);
  EXPECT_EQ(readToml(folder_ / "." / "robot.toml").table("mcl").integer("particles"), 2000)
      << "by whatever name";
  EXPECT_EQ(test::readBytes(file_), kText);
}

TEST_F(TomlChanges, OfListsAreOfTheirNumberPluginOrModel) {
  const auto sigma = [&](std::size_t i) {
    return readToml(file_).tables("sensor")[i].number("sigma_m");
  };
  changeToml(file_, "sensor.rear.sigma_m", "0.1");
  EXPECT_EQ(sigma(0), 0.05);
  EXPECT_EQ(sigma(1), 0.1);
  changeToml(file_, "sensor.1.sigma_m", "0.2");
  EXPECT_EQ(sigma(0), 0.2);
  EXPECT_EQ(sigma(1), 0.1);
  changeToml(file_, "sensor.lrf.sigma_m", "0.3");
  EXPECT_EQ(sigma(0), 0.3);
  EXPECT_EQ(sigma(1), 0.3);
}

TEST_F(TomlChanges, MakeTablesAndValuesOfAnyKind) {
  changeToml(file_, "motion.plugin", "odometry");
  changeToml(file_, "mcl.learns_biases", "false");
  changeToml(file_, "sensor.1.pose", "{ x_m = 0.5 }");
  changeToml(file_, "robot.name", "two words = \"quoted");
  const Parameters all = readToml(file_);
  EXPECT_EQ(all.table("motion").text("plugin"), "odometry");
  EXPECT_FALSE(all.table("mcl").flagOr("learns_biases", true));
  EXPECT_EQ(all.tables("sensor")[0].table("pose").number("x_m"), 0.5);
  EXPECT_EQ(all.table("robot").text("name"), "two words = \"quoted");
}

TEST_F(TomlChanges, ThatAreNotPossibleAreRefusedAndChangeNothing) {
  EXPECT_NE(refusal("").find("is no path"), std::string::npos);
  EXPECT_NE(refusal("mcl.").find("is no path"), std::string::npos);
  EXPECT_NE(refusal("a..b").find("is no path"), std::string::npos);
  EXPECT_NE(refusal("sensor.side.sigma_m").find("'side' means"), std::string::npos);
  EXPECT_NE(refusal("sensor.3.sigma_m").find("'3' means"), std::string::npos);
  EXPECT_NE(refusal("robot.name.first").find("is a value"), std::string::npos);
  EXPECT_EQ(readTomlText(file_), kText);
  try {
    changeToml(folder_ / "none.toml", "a", "1");
    ADD_FAILURE();
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("none.toml"), std::string::npos);
  }
}

// A value is one value, not more of the file.
TEST_F(TomlChanges, ValuesBringNoFurtherKeys) {
  changeToml(file_, "mcl.particles", "1\n[other]\nkey = 2");
  const Parameters all = readToml(file_);
  EXPECT_FALSE(all.has("other"));
  EXPECT_EQ(all.table("mcl").text("particles"), "1\n[other]\nkey = 2");
}

}  // namespace
}  // namespace ortung
