// Halves of football: what is counted, and that it is the same again.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "FootballWatch.hpp"
#include "ortung/benchmark/FootballMatrix.hpp"
#include "ortung/benchmark/FootballRatings.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/sim/PlayerWish.hpp"
#include "ortung/sim_api/Referee.hpp"

namespace ortung {
namespace {

/// Two robots and a ball in play for some seconds, and what is counted.
FootballHalf counted(const std::vector<std::string>& players, double seconds,
                     const Twist& ball = {}) {
  PluginFactory factory(PluginFactory::standardFolders());
  Scene scene;
  scene.world = shippedFile("fields", "f2000.toml");
  scene.referee = parseReferee("soccer:league=f2000");
  SceneRun run(scene, {.seed = 1}, factory, {.budget = 0.0});
  std::uint64_t number = 0;
  for (const std::string& player : players) run.addPlayer(parsePlayer(player), ++number);
  run.step();
  run.referee()->order("dropped-ball");
  while (run.game().phase != Game::Phase::kPlaying) run.step();
  // The referee has placed them for the kick-off.
  for (std::size_t i = 0; i < players.size(); ++i)
    run.simulation().place(*run.simulation().robots()[i], *parsePlayer(players[i]).start);
  run.simulation().placeThing(0, {0.0, 0.0, 0.0}, ball);
  FootballWatch watch(run, "blue", {});
  const Timestamp end = run.simulation().now() + fromSeconds(seconds);
  while (run.simulation().now() < end) {
    run.act();
    watch.compare();
    run.move();
    watch.look(run.referee()->takeEvents());
  }
  return watch.half();
}

const std::string kStill = "goalkeeper:policy=still&name=b&start=-3,1,0@blue";
const std::string kOther = "goalkeeper:policy=still&name=y&start=3,1,0@yellow";

TEST(FootballWatch, NobodyGoesForTheBallIfAllStand) {
  const FootballHalf half = counted({kStill, kOther}, 5.0);
  EXPECT_EQ(half.inPlay, 5'000'000);
  EXPECT_EQ(half.unattended, 5'000'000);
  EXPECT_EQ(half.longestAlone, 5'000'000);
  // They stand from the first cycle on, which is looked at after it.
  EXPECT_NEAR(toSeconds(half.longestIdle), 5.0, 0.011);
  EXPECT_NEAR(toSeconds(half.longestStand), 5.0, 0.011);
  EXPECT_EQ(half.goals, (FootballHalf::OfTeams{0, 0}));
}

TEST(FootballWatch, WhoDrivesTowardsTheBallGoesForItAndOthersDoNot) {
  const std::string way =
      "follow:robot=goalkeeper.toml&name=b&speed_m_s=0.5&start=-4,0,0&waypoints_m=";
  const FootballHalf towards = counted({way + "-2,0@blue", kOther}, 3.0);
  EXPECT_LT(towards.unattended, 500'000) << "it starts";
  const FootballHalf away = counted({way + "-5.4,0@blue", kOther}, 3.0);
  EXPECT_EQ(away.unattended, 3'000'000);
}

// The ball rolls 1 m past the robot, and stops after v^2 / 2b = 1.7 m: where it will be counts,
// too.
TEST(FootballWatch, ATouchIsAGapOfTwoCentimetresAtMost) {
  // Its body is 0.225 m to each side; the ball's middle passes at 0.335 + 0.015 and + 0.025 m.
  const auto beside = [&](double gap) {
    const std::string start = std::to_string(0.225 + 0.11 + gap);
    return counted({"goalkeeper:policy=still&name=b&start=0," + start + ",0@blue", kOther}, 1.0);
  };
  EXPECT_EQ(beside(0.015).unattended, 0);
  EXPECT_EQ(beside(0.025).unattended, 1'000'000);
}

FootballConfig shortHalves() {
  FootballConfig config;
  config.leagues = {"f2000"};
  config.teams = {"footballer", "footballer:speed_m_s=0.5"};
  config.halves = 3;
  config.seconds = 4.0;
  config.seed = 7;
  return config;
}

TEST(FootballMatrix, OneThreadTwoAndMergedShardsGiveTheSameBits) {
  const FootballConfig config = shortHalves();
  const FootballMatrix one = playFootball(config, {});
  EXPECT_EQ(toJson(playFootball(config, {.threads = 2}), "v"), toJson(one, "v"));
  std::vector<FootballMatrix> shards;
  for (const std::uint64_t shard : {2u, 1u}) {
    FootballConfig part = config;
    part.shard = shard;
    part.shards = 2;
    shards.push_back(playFootball(part, {}));
  }
  EXPECT_EQ(toJson(mergeFootball(shards), "v"), toJson(one, "v"));
  EXPECT_EQ(toJson(readFootball(toJson(one, "v"), "file"), "v"), toJson(one, "v"));
  std::uint64_t played = 0;
  EXPECT_TRUE(verifyFootball(one, 2, 1, {}, played).empty());
  EXPECT_EQ(played, 2u);
  shards.pop_back();
  EXPECT_THROW(mergeFootball(shards), std::invalid_argument);
}

/// Halves that were not played.
FootballMatrix drawn(int won, int drew, int lost, const std::string& other = "footballer-v1") {
  FootballMatrix matrix;
  matrix.config.leagues = {"msl"};
  matrix.config.teams = {"footballer", other};
  matrix.config.halves = static_cast<std::uint64_t>(won + drew + lost);
  matrix.worlds = {"world"};
  FootballCell cell{"msl", 0, 1, {}};
  for (int i = 0; i < won + drew + lost; ++i) {
    FootballHalf half;
    half.goals = i < won          ? FootballHalf::OfTeams{3, 1}
                 : i < won + drew ? FootballHalf::OfTeams{1, 1}
                                  : FootballHalf::OfTeams{0, 1};
    cell.halves.push_back(half);
  }
  matrix.cells.push_back(cell);
  return matrix;
}

// With two teams the likelihood has its maximum where the expected share is the observed one.
TEST(FootballRatings, OfTwoTeamsAreThoseOfTheirShareOfWins) {
  const auto ratings = rateFootball(drawn(30, 8, 12), 0);
  const double share = (30 + 0.5 * 8 + 0.5) / 51.0;
  EXPECT_NEAR(ratings[0].points.value, 400.0 * std::log10(share / (1.0 - share)), 1e-6);
  EXPECT_EQ(ratings[1].points.value, 0.0) << "the yardstick";
  EXPECT_NEAR(ratings[0].won.value, 0.68, 1e-12);
  EXPECT_NEAR(ratings[0].difference.value, (30 * 2 - 12) / 50.0, 1e-12);
  EXPECT_NEAR(ratings[1].scored.value, (30 + 8 + 12) / 50.0, 1e-12);
  // A normal interval of the share: sigma^2 = (sum of squares - 34^2 / 50) / 50 / 50.
  const double sigma = std::sqrt((30 + 8 * 0.25 - 34.0 * 34.0 / 50.0) / 50.0 / 50.0);
  EXPECT_NEAR(ratings[0].won.low, 0.68 - 1.96 * sigma, 0.03);
  EXPECT_NEAR(ratings[0].won.high, 0.68 + 1.96 * sigma, 0.03);
  // Without it the mean is 0.
  const auto others = rateFootball(drawn(30, 8, 12, "other"), 0);
  EXPECT_NEAR(others[0].points.value + others[1].points.value, 0.0, 1e-9);
}

TEST(FootballFile, RefusesWhatIsNoResult) {
  const auto good = nlohmann::ordered_json::parse(toJson(drawn(1, 1, 1), "v"));
  const auto refuses = [&](const char* at, const nlohmann::ordered_json& value, const char* why) {
    auto bad = good;
    bad[nlohmann::ordered_json::json_pointer(at)] = value;
    try {
      readFootball(bad.dump(), "bad.json");
      ADD_FAILURE() << at << " is taken";
    } catch (const std::runtime_error& error) {
      const std::string text = error.what();
      EXPECT_TRUE(text.starts_with("bad.json: ")) << text;
      EXPECT_NE(text.find(why), text.npos) << text;
    }
  };
  refuses("/format", "ortung goalkeeper benchmark 1", "expected the format");
  refuses("/seed", -1, "the seed is -1");
  refuses("/halves", 1e30, "halves is 1e+30");
  refuses("/halves", 4, "expected 4");
  refuses("/half_s", -3.0, "expected 0 to 7200");
  refuses("/leagues/0", "f1", "the league is 'f1'");
  refuses("/teams/0", "a\nb", "control characters");
  refuses("/cells", nlohmann::ordered_json::array(), "expected a cell for each pair");
  refuses("/cells/0/first", "other", "not in its place");
  refuses("/cells/0/halves/0/goals", {1, 2, 3}, "expected one for each of two teams");
  refuses("/cells/0/halves/0/goals", {1, -2}, "goals is -2");
  refuses("/cells/0/halves/0/stuck", 0.5, "stuck is 0.5");
  refuses("/cells/0/halves/0/goals", {5, 1}, "its hash is");
  refuses("/cells/0/halves/0/digest", "xyz", "a digest can't be read");
  EXPECT_THROW(readFootball("[", "bad.json"), std::runtime_error);
  EXPECT_TRUE(isFootballJson(toJson(drawn(1, 1, 1), "v")));
  EXPECT_FALSE(isFootballJson("{}"));
}

TEST(FootballConfig, PairsAreAllOrThoseWithOpponents) {
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  FootballConfig config = shortHalves();
  config.teams = {"a", "b", "c"};
  EXPECT_EQ(config.pairs(), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
  config.against = {"b", "d"};
  EXPECT_EQ(config.entrants(), (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(config.pairs(), (Pairs{{0, 1}, {0, 3}, {1, 1}, {1, 3}, {2, 1}, {2, 3}}));
  config.against.clear();
  config.teams = {"a"};
  EXPECT_EQ(config.pairs(), (Pairs{{0, 0}}));
  config.teams = {"a", "a"};
  EXPECT_THROW(config.check(), std::invalid_argument);
  EXPECT_EQ(withTeamSight("footballer:a=1+goalkeeper", "features"),
            "footballer:a=1&sees=features+goalkeeper:sees=features");
}

}  // namespace
}  // namespace ortung
