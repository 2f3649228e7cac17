#include <gtest/gtest.h>

#include <map>

#include "Messages.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/refbox/BoxCommand.hpp"

namespace ortung::refbox {
namespace {

std::string orderFor(const std::string& command, const std::string& team,
                     const BoxTeams& teams = {"blue", "yellow", "us"}) {
  std::string why;
  const auto order = orderOf({command, team, {}}, teams, why);
  return order ? *order : "refused: " + why;
}

/// All commands of the protocol, as the box sends them.
TEST(BoxCommand, EachHasItsOrder) {
  const std::map<std::string, std::string> forBoth = {{"START", "start"},
                                                      {"STOP", "stop"},
                                                      {"DROP_BALL", "dropped-ball"},
                                                      {"HALF_TIME", "half-time"},
                                                      {"END_GAME", "end"},
                                                      {"END_PART", "half-time"},
                                                      {"GAMEOVER", "end"},
                                                      {"GAME_OVER", "end"},
                                                      {"PARK", "stop"},
                                                      {"FIRST_HALF", "first-half"},
                                                      {"SECOND_HALF", "second-half"},
                                                      {"FIRST_HALF_OVERTIME", "first-overtime"},
                                                      {"SECOND_HALF_OVERTIME", "second-overtime"},
                                                      {"RESET", "reset"},
                                                      {"TESTMODE_ON", ""},
                                                      {"TESTMODE_OFF", ""},
                                                      {"WELCOME", ""},
                                                      {"IS_ALIVE", ""}};
  for (const auto& [command, order] : forBoth) EXPECT_EQ(orderFor(command, ""), order) << command;
  const std::map<std::string, std::string> forOne = {{"KICKOFF", "kick-off"},
                                                     {"FREEKICK", "free-kick"},
                                                     {"GOALKICK", "goal-kick"},
                                                     {"THROWIN", "throw-in"},
                                                     {"CORNER", "corner"},
                                                     {"PENALTY", "penalty"},
                                                     {"GOAL", "goal"},
                                                     {"SUBGOAL", "no-goal"},
                                                     {"REPAIR", "repair"},
                                                     {"REPAIR_END", "repair-end"},
                                                     {"YELLOW_CARD", "yellow-card"},
                                                     {"DOUBLE_YELLOW", "red-card"},
                                                     {"RED_CARD", "red-card"},
                                                     {"SUBSTITUTION", "substitution"}};
  for (const auto& [command, order] : forOne) {
    EXPECT_EQ(orderFor(command, "us"), order + " blue") << command;
    EXPECT_EQ(orderFor(command, "them"), order + " yellow") << command;
    EXPECT_EQ(orderFor(command, ""), "refused: " + command + " names no team");
  }
  EXPECT_EQ(orderFor("KICK", ""), "refused: the command 'KICK' is not known");
  EXPECT_NE(orderFor("CORNER", "us", {"blue", "yellow", ""}).find("before the box has said"),
            std::string::npos);
}

TEST(BoxCommand, IsReadFromJson) {
  std::string why;
  const auto command = readBoxCommand(
      R"({"command": " SUBSTITUTION ", "targetTeam": "224.16.32.10", "robotID": 4, "more": [1]})",
      why);
  ASSERT_TRUE(command) << why;
  EXPECT_EQ(command->command, "SUBSTITUTION");
  EXPECT_EQ(command->targetTeam, "224.16.32.10");
  EXPECT_EQ(command->robot, 4);
  EXPECT_TRUE(readBoxCommand(R"({"command": "START"})", why)) << why;
}

TEST(BoxCommand, ThatIsNoneSaysWhy) {
  const auto whyNot = [](const std::string& text) {
    std::string why;
    EXPECT_FALSE(readBoxCommand(text, why)) << text;
    return why;
  };
  EXPECT_EQ(whyNot("\x01kick"), "it is no JSON: '?kick'");
  EXPECT_EQ(whyNot("[]"), "it is no JSON object: '[]'");
  EXPECT_EQ(whyNot("{}"), "command is missing");
  EXPECT_EQ(whyNot(R"({"command": null})"), "command is no text");
  EXPECT_EQ(whyNot(R"({"command": "START", "targetTeam": []})"), "targetTeam is no text");
  EXPECT_EQ(whyNot(R"({"command": "IS_ALIVE", "robotID": 100})"),
            "robotID is no whole number from 0 to 99");
  EXPECT_EQ(whyNot(R"({"command": "IS_ALIVE", "robotID": -1})"),
            "robotID is no whole number from 0 to 99");
  EXPECT_EQ(whyNot("{\"command\": \"" + std::string(65, 'A') + "\"}"),
            "command is longer than 64 characters");
  EXPECT_FALSE(whyNot(std::string(50'000, '[')).empty());
}

/// However a stream is cut, its messages are the same.
TEST(Messages, DoNotDependOnHowBytesCome) {
  Random random(3);
  std::string stream;
  for (int i = 0; i < 200; ++i) {
    stream += std::string(static_cast<std::size_t>(random.uniform() * 30.0), 'a');
    stream.push_back('\0');
  }
  const auto cut = [&](std::size_t piece) {
    Messages messages(20);
    std::vector<std::string> all;
    int tooLong = 0;
    for (std::size_t at = 0; at < stream.size(); at += piece)
      messages.receive(
          std::string_view(stream).substr(at, piece),
          [&](std::string_view message) { all.emplace_back(message); }, [&] { ++tooLong; });
    EXPECT_EQ(messages.waiting(), 0U);
    all.push_back(std::to_string(tooLong));
    return all;
  };
  const auto whole = cut(stream.size());
  EXPECT_GT(whole.size(), 80U);
  EXPECT_NE(whole.back(), "0");
  for (const std::size_t piece : {1U, 2U, 7U, 64U}) EXPECT_EQ(cut(piece), whole) << piece;
}

}  // namespace
}  // namespace ortung::refbox
