// What clients may say of localizations, and what they may not.
#include <gtest/gtest.h>

#include "FakeRobots.hpp"
#include "LocalizedArena.hpp"
#include "ProtocolPage.hpp"

namespace ortung::test {
namespace {

using Role = BoardCommand::Role;
using Kind = LocalizationOrder::Kind;

TEST(LocalizationCommands, AreThoseOfThePage) {
  FakeRobots robots;
  expectDocumented("Localization", localizationCommands(robots));
}

TEST(LocalizationCommands, ThatComputeMuchAreSlowOnesWhichHoldUpNobody) {
  FakeRobots robots;
  for (const BoardCommand& command : localizationCommands(robots))
    EXPECT_EQ(command.isSlow, command.name == "HEATMAP" || command.name == "WHY") << command.name;
}

TEST(LocalizationCommands, TakeOrdersOfOperatorsAlone) {
  FakeRobots robots;
  const Asking client(robots);
  const std::string state = "robot=7 state=learning progress=0.5";
  EXPECT_EQ(client.words("LOCALIZE", Role::kViewer), state);
  EXPECT_EQ(client.words("LOCALIZE robot=7 on"), state);
  EXPECT_EQ(client.words("LOCALIZE off"), state);
  EXPECT_EQ(client.words("LOCALIZE anywhere"), state);
  EXPECT_EQ(client.words("LOCALIZE on x_m=1 y_m=-2 theta_deg=90 sigma_m=0.5 sigma_deg=18"), state);
  ASSERT_EQ(robots.orders.size(), 4U);
  EXPECT_EQ(robots.orders[0].kind, Kind::kOn);
  EXPECT_EQ(robots.orders[1].kind, Kind::kOff);
  EXPECT_EQ(robots.orders[2].kind, Kind::kAnywhere);
  EXPECT_EQ(robots.orders[3].kind, Kind::kPlace);
  EXPECT_DOUBLE_EQ(robots.orders[3].pose.y, -2.0);
  EXPECT_DOUBLE_EQ(robots.orders[3].pose.theta, kTurn / 4);
  EXPECT_DOUBLE_EQ(robots.orders[3].sigmaPosition, 0.5);
  EXPECT_DOUBLE_EQ(robots.orders[3].sigmaHeading, kTurn / 20);
  for (const char* line : {"LOCALIZE on", "LOCALIZE x_m=0 y_m=0"})
    EXPECT_TRUE(client.words(line, Role::kViewer).starts_with("ERR role")) << line;
  for (const char* line : {"LOCALIZE", "HEATMAP", "WHY x_m=0 y_m=0"})
    EXPECT_TRUE(client.words(line, Role::kPlayer).starts_with("ERR not-yours")) << line;
  EXPECT_EQ(robots.orders.size(), 4U);
}

TEST(LocalizationCommands, RefuseWhatMakesNoSense) {
  LocalizedArena arena;
  FakeRobots robots(openRobot(arena.robotFile));  // without tables
  const Asking client(robots);
  const auto expectError = [&](const std::string& line, const std::string& error) {
    EXPECT_TRUE(client.words(line).starts_with("ERR " + error))
        << line << ": " << client.words(line);
  };
  expectError("LOCALIZE robot=8", "no-robot");
  expectError("LOCALIZE robot=0", "number");
  expectError("LOCALIZE robot=nan", "number");
  expectError("LOCALIZE sideways", "syntax");
  expectError("LOCALIZE on off", "syntax");
  expectError("LOCALIZE off x_m=0 y_m=0", "syntax");
  expectError("LOCALIZE anywhere x_m=0 y_m=0", "syntax");
  expectError("LOCALIZE x_m=0", "syntax");
  expectError("LOCALIZE sigma_m=1", "syntax");
  expectError("LOCALIZE x_m=nan y_m=0", "number");
  expectError("LOCALIZE x_m=1e300 y_m=0", "number");
  expectError("LOCALIZE x_m=0 y_m=0 sigma_m=0", "number");
  expectError("LOCALIZE x_m=0 y_m=0 sigma_deg=inf", "number");
  expectError("LOCALIZE on colour=blue", "syntax");
  expectError("HEATMAP of=everything", "syntax");
  expectError("HEATMAP index=1", "syntax");
  expectError("HEATMAP scale=cubic", "syntax");
  expectError("HEATMAP scale=log of=expectation", "syntax");
  expectError("HEATMAP of=expectation index=-1", "number");
  expectError("HEATMAP of=expectation index=70000", "number");
  expectError("HEATMAP cells=0", "number");
  expectError("HEATMAP cells=999999999", "number");
  expectError("HEATMAP theta_deg=1 theta_rad=1", "syntax");
  expectError("HEATMAP theta_deg=nan", "number");
  expectError("HEATMAP theta_deg=360.1", "number");
  expectError("HEATMAP theta_deg=-360.1", "number");
  expectError("HEATMAP theta_rad=7.1", "number");
  expectError("HEATMAP theta_rad=-7.1", "number");
  expectError("HEATMAP a/b", "argument");
  expectError("HEATMAP " + std::string(30'000, '/'), "argument");
  expectError("HEATMAP", "argument no such feature of this robot localizes");
  std::string many = "HEATMAP";
  for (int i = 0; i < 65; ++i) many += " a/b/c";
  expectError(many, "limit");
  expectError("WHY", "syntax");
  expectError("WHY x_m=0 y_m=0 z_m=0", "syntax");
  expectError("WHY x_m=0 y_m=inf", "number");
  robots.hasUsual = false;
  expectError("WHY x_m=0 y_m=0", "no-robot");
  FakeRobots off;
  EXPECT_EQ(Asking(off).words("HEATMAP"), "ERR state it is off");
  EXPECT_TRUE(robots.orders.empty());
}

TEST(LocalizationCommands, SayThatThereIsNoReadingYet) {
  LocalizedArena arena;
  const auto tables =
      arena.config().tables(*openRobot(arena.robotFile), [](double) { return true; });
  ASSERT_TRUE(tables);
  const std::shared_ptr<Robot> robot = openRobot(arena.robotFile, *tables);
  FakeRobots robots(robot);
  const Asking client(robots);
  const BoardCommand::Reply nothing = client.ask("HEATMAP");
  EXPECT_TRUE(nothing.words.starts_with("robot=7 stamp=0 ")) << nothing.words;
  EXPECT_TRUE(nothing.words.ends_with(" low=1 high=1 readings=0")) << "nothing speaks against any";
  EXPECT_EQ(nothing.bytes.find_first_not_of(std::string_view("\0\1", 2)), std::string::npos);
  EXPECT_EQ(client.words("WHY x_m=0 y_m=0"), "robot=7 p=-1");
  EXPECT_TRUE(
      client.words("HEATMAP of=expectation").starts_with("ERR argument of=expectation is of one"));
  EXPECT_TRUE(client.words("HEATMAP */LRF/* of=expectation index=31").starts_with("ERR argument"));
  EXPECT_TRUE(
      client.words("HEATMAP */LRF/* of=expectation index=30").starts_with("robot=7 stamp=0"));
}

}  // namespace
}  // namespace ortung::test
