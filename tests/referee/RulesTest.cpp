#include <gtest/gtest.h>

#include <sstream>

#include "Files.hpp"
#include "KnownKeys.hpp"
#include "Paths.hpp"
#include "Rules.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung::soccer {
namespace {

using test::messageOf;

const std::filesystem::path kRules = ORTUNG_SOURCE_DIR "/maps/rules";

class RulesTest : public testing::Test {
 protected:
  std::string errorOf(const std::string& text) {
    test::writeBytes(folder / "r.toml", text);
    return messageOf<ConfigError>([&] { readRules(folder / "r.toml"); });
  }
  Rules read(const std::string& text) {
    test::writeBytes(folder / "r.toml", text);
    return readRules(folder / "r.toml");
  }
  test::TemporaryFolder folder;
};

TEST_F(RulesTest, OfTheMiddleSizeLeagueAreThoseOfItsBook) {
  const Rules rules = readRules(kRules / "msl.toml");
  EXPECT_EQ(rules.match.halves, 2);
  EXPECT_EQ(rules.match.half, 15 * 60);
  EXPECT_EQ(rules.restart.setPiece, 7);
  EXPECT_EQ(rules.restart.keepAway, 3);
  EXPECT_TRUE(rules.out.hasThrowIn);
  EXPECT_TRUE(rules.out.hasKicks);
  EXPECT_EQ(rules.areas.ownGoal, 1);
  EXPECT_EQ(rules.kickOff.own.size(), 5U);
  EXPECT_EQ(rules.kickOff.other.size(), 5U);
}

TEST_F(RulesTest, OfF2000PutTheBallBack) {
  const Rules rules = readRules(kRules / "f2000.toml");
  EXPECT_FALSE(rules.out.hasThrowIn);
  EXPECT_FALSE(rules.out.hasKicks);
  EXPECT_EQ(rules.goal.direct.size(), 7U);
  EXPECT_FALSE(rules.areas.ownGoal);
  EXPECT_EQ(rules.kickOff.own.size(), 4U);
}

TEST_F(RulesTest, ThatAreUnknownAreToldWithFileAndLine) {
  const std::string error = errorOf("[match]\nhalves = 2\n\n[stuck]\ntime_s = 3\noffside = true\n");
  EXPECT_NE(error.find("r.toml:6: offside is not known here"), error.npos) << error;
  EXPECT_EQ(test::keysKnownIn(error, "offside"), (std::set<std::string>{"radius_m", "time_s"}));
  const std::string table = errorOf("[match]\nhalves = 2\n[offside]\nmargin_m = 1\n");
  EXPECT_NE(table.find("r.toml:3: offside is not known here"), table.npos) << table;
}

TEST_F(RulesTest, OutOfRangeAreRefusedWithTheRange) {
  EXPECT_NE(errorOf("[match]\nhalves = 0\n").find("r.toml:2: halves is 0, must be in [1, 100]"),
            std::string::npos);
  EXPECT_NE(errorOf("[restart]\nset_piece_s = -1\n").find("set_piece_s is -1"), std::string::npos);
  EXPECT_NE(errorOf("[restart]\nset_piece_s = \"7\"\n").find("expected a number"),
            std::string::npos);
  EXPECT_NE(errorOf("[match]\nhalves = 1.5\n").find("expected a whole number"), std::string::npos);
  EXPECT_NE(errorOf("[match]\nhalf_s = nan\n").find("is not finite"), std::string::npos);
  EXPECT_NE(errorOf("[out]\ntouch_line = \"kick-in\"\n").find("must be one of: throw-in, put-back"),
            std::string::npos);
  EXPECT_NE(errorOf("[goal]\ndirect_from = [\"kick-in\"]\n").find("holds 'kick-in'"),
            std::string::npos);
  EXPECT_NE(errorOf("[kick_off]\nown = [-0.5, 0, -0.2]\n").find("expected pairs"),
            std::string::npos);
  EXPECT_NE(errorOf("[kick_off]\nown = [0.5, 0]\n").find("not in the own half"), std::string::npos);
  EXPECT_NE(errorOf("[places]\ndropped_ball = \"mark\"\n").find("there is no marks_x_m"),
            std::string::npos);
  EXPECT_NE(errorOf("match = 3\n").find("expected a table"), std::string::npos);
}

TEST_F(RulesTest, OfABaseHoldUnlessTheFileSaysOtherwise) {
  test::writeBytes(folder / "base.toml",
                   "[match]\nhalf_s = 33\nhalves = 3\n[areas]\nown_goal_area = 1\n");
  const Rules rules =
      read("base = \"base.toml\"\n[match]\nhalves = 4\n[areas]\nown_goal_area = -1\n");
  EXPECT_EQ(rules.match.half, 33);
  EXPECT_EQ(rules.match.halves, 4);
  EXPECT_FALSE(rules.areas.ownGoal);
}

TEST_F(RulesTest, HaveABaseThatIsThereAndHasNone) {
  EXPECT_NE(errorOf("base = \"r.toml\"\n").find("bases have none"), std::string::npos);
  EXPECT_NE(errorOf("base = \"none.toml\"\n").find("none.toml"), std::string::npos);
  EXPECT_NE(errorOf("base = \"none\"\n").find("there are no rules 'none'"), std::string::npos);
  EXPECT_NE(errorOf("base = \"../msl\"\n").find("is not the name of shipped rules"),
            std::string::npos);
}

/// Whatever the bytes are, they are rules or a ConfigError that says why.
TEST_F(RulesTest, ThatAreDamagedAreRefused) {
  const std::string good = test::readBytes(kRules / "msl.toml");
  Random random(7);
  int refused = 0;
  constexpr int kFiles = 400;
  for (int i = 0; i < kFiles; ++i) {
    std::string bad = good;
    for (int change = 0; change < 3; ++change) {
      const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(bad.size()));
      const auto byte = static_cast<char>(random.uniform() * 256.0 - 128.0);
      if (random.uniform() < 0.5) {
        bad[at] = byte;
      } else {
        bad.erase(at, 1 + static_cast<std::size_t>(random.uniform() * 20.0));
      }
    }
    test::writeBytes(folder / "r.toml", bad);
    try {
      readRules(folder / "r.toml");
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find("r.toml"), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, kFiles / 4);
  EXPECT_LT(refused, kFiles);
}

// --- the options of the plugin

std::string optionError(const std::vector<std::pair<std::string, std::string>>& options) {
  Parameters p("--referee soccer");
  for (const auto& [key, value] : options) p.set(key, value);
  return messageOf<ConfigError>(
      [&] { PluginFactory(PluginFactory::standardFolders()).make<Referee>("soccer", p); });
}

TEST(RefereeOptions, WithoutAnyTheRulesAreThoseThatShip) {
  EXPECT_EQ(optionError({}), "(nothing was thrown)");
  EXPECT_EQ(optionError({{"league", "msl"}}), "(nothing was thrown)");
  EXPECT_EQ(optionError({{"rules", "msl"}}), "(nothing was thrown)");
  EXPECT_EQ(optionError({{"rules", (kRules / "msl.toml").string()}}), "(nothing was thrown)");
}

TEST(RefereeOptions, ThatAreWrongAreRefused) {
  EXPECT_NE(optionError({{"league", "ssl"}}).find("must be one of: f2000, msl"), std::string::npos);
  EXPECT_NE(optionError({{"league", "msl"}, {"rules", "msl"}}).find("league"), std::string::npos);
  EXPECT_NE(optionError({{"rules", "/no/such.toml"}}).find("/no/such.toml"), std::string::npos);
  EXPECT_NE(optionError({{"rules", "such"}}).find("there are no rules 'such'"), std::string::npos);
  EXPECT_NE(optionError({{"team_1", "yellow"}}).find("team_2"), std::string::npos);
  EXPECT_NE(optionError({{"team_1", "two words"}}).find("expected a word"), std::string::npos);
  EXPECT_NE(optionError({{"kick_off", "red"}}).find("must be one of: blue, yellow"),
            std::string::npos);
  EXPECT_NE(optionError({{"whistle", "loud"}}).find("whistle is not known here"),
            std::string::npos);
}

/// The page on the referee names every key of the files, and no other.
TEST(RulesPage, HasEveryKeyOfTheFiles) {
  const std::string page = test::readBytes(ORTUNG_SOURCE_DIR "/docs/referee.md");
  for (const char* name : {"f2000.toml", "msl.toml"}) {
    const Parameters p = readToml(kRules / name);
    for (const std::string& table : p.keys())
      for (const std::string& key : p.table(table).keys())
        EXPECT_NE(page.find("`" + key + "`"), page.npos) << name << " [" << table << "] " << key;
  }
}

}  // namespace
}  // namespace ortung::soccer
