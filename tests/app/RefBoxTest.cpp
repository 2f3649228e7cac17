// `ortung sim --refbox`: a box of the league leads a simulated game.
#include <gtest/gtest.h>

#include <csignal>

#include "Paths.hpp"
#include "Program.hpp"
#include "StandInBox.hpp"

namespace ortung::test {
namespace {

const std::string kField = ORTUNG_SOURCE_DIR "/maps/fields/f2000.toml";

std::vector<std::string> game(const std::string& box, const std::string& until = "--duration",
                              const std::string& value = "60") {
  return {"sim",        kField,
          "--referee",  "soccer:control=orders",
          "--player",   "wander:robot=pioneer.toml&start=-3,2,0@blue",
          until,        value,
          "--no-noise", "--refbox",
          box};
}

void expectLedBy(StandInBox& box, Program& program) {
  for (int i = 0; i < 30'000 && !box.hasClient(); ++i) box.look();
  ASSERT_TRUE(box.hasClient());
  box.command("WELCOME", "224.16.32.10");
  box.command("FIRST_HALF");
  box.command("KICKOFF", "224.16.32.10");
  box.say("no JSON");
  const std::string out = program.waitForOutput("kick-off blue");
  EXPECT_NE(out.find("kick-off blue"), std::string::npos) << out;
  box.command("START");
  EXPECT_NE(program.waitForOutput("start").find("start"), std::string::npos);
  for (int i = 0; i < 30'000 && box.messages().empty(); ++i) box.look();
  ASSERT_FALSE(box.messages().empty());
  const std::string state = box.messages().front();
  EXPECT_NE(state.find("\"type\":\"worldstate\""), std::string::npos) << state;
  EXPECT_NE(state.find("\"teamName\":\"blue\""), std::string::npos) << state;
  EXPECT_TRUE(program.waitForError("JSON"));
  program.signal(SIGTERM);
  program.finish();
}

TEST(RefBox, LeadsASimulatedGame) {
  StandInBox box;
  Program program(game("127.0.0.1:" + std::to_string(box.port())));
  expectLedBy(box, program);
}

// Clients play in it, and the box leads it.
TEST(RefBox, LeadsAServedGame) {
  StandInBox box;
  Program program(game("127.0.0.1:" + std::to_string(box.port()), "--listen", "0"));
  expectLedBy(box, program);
}

TEST(RefBox, ThatCantBeIsAUsageError) {
  for (const auto& [box, why] : std::vector<std::pair<std::string, std::string>>{
           {"localhost:none", "expected HOST[:PORT][@TEAM]"},
           {"localhost:0", "expected HOST[:PORT][@TEAM]"},
           {"localhost@red", "expected blue or yellow"}}) {
    for (const auto& arguments : {game(box), game(box, "--listen", "0")}) {
      const Outcome outcome = ortung(arguments);
      EXPECT_EQ(outcome.exitCode, 2) << box;
      EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    }
  }
  const Outcome alone = ortung({"sim", kField, "--refbox", "localhost", "--duration", "1"});
  EXPECT_EQ(alone.exitCode, 2);
  EXPECT_NE(alone.err.find("there is no referee"), std::string::npos) << alone.err;
}

}  // namespace
}  // namespace ortung::test
