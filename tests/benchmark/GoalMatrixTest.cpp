#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung {
namespace {

GoalMatrixConfig someConfig(std::uint64_t episodes) {
  GoalMatrixConfig config;
  config.keepers = {keeperText("random"), keeperText("mixed"),
                    "goalkeeper:policy=intercepting&sees=features&noise_m=0.05"};
  config.strikers = {strikerText("shot"), strikerText("dribble")};
  config.episodes = episodes;
  config.seed = 11;
  return config;
}

void expectSame(const GoalMatrix& a, const GoalMatrix& b) {
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    EXPECT_EQ(a.cells[i].episodes, b.cells[i].episodes) << a.cells[i].keeper;
    EXPECT_EQ(a.cells[i].hash(a.config), b.cells[i].hash(b.config));
  }
}

TEST(GoalMatrix, OneThreadTwoAndMergedShardsGiveTheSameBits) {
  const GoalMatrixConfig config = someConfig(11);
  const GoalMatrix one = playMatrix(config, {});
  expectSame(one, playMatrix(config, {.threads = 2}));
  std::vector<GoalMatrix> shards;
  std::vector<std::uint64_t> sums(one.cells.size(), 0);
  for (const std::uint64_t shard : {3u, 1u, 2u}) {
    GoalMatrixConfig part = config;
    part.shard = shard;
    part.shards = 3;
    shards.push_back(playMatrix(part, {}));
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += shards.back().cells[i].hash(part);
  }
  const GoalMatrix merged = mergeShards(shards);
  expectSame(one, merged);
  EXPECT_EQ(toJson(one, "v"), toJson(merged, "v"));
  for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_EQ(sums[i], one.cells[i].hash(config));
  shards.pop_back();
  EXPECT_THROW(mergeShards(shards), std::invalid_argument);
  shards.push_back(shards.front());
  EXPECT_THROW(mergeShards(shards), std::invalid_argument);
}

// An episode does not depend on what was played before.
TEST(GoalMatrix, EpisodesStandAlone) {
  GoalEpisodes fresh;
  GoalEpisodes used;
  for (std::uint64_t i = 0; i < 5; ++i)
    used.play(keeperText("mixed"), strikerText("dribble"), 1, i);
  const GoalEpisode a = fresh.play(keeperText("random"), strikerText("shot"), 2, 7);
  EXPECT_EQ(a, used.play(keeperText("random"), strikerText("shot"), 2, 7));
  EXPECT_NE(a.digest, used.play(keeperText("random"), strikerText("shot"), 3, 7).digest);
}

// 150 episodes tell apart what the paper calls levels of skill. A ball that rolls to a random place
// does not look where the keeper stands, so moving about is no better there than standing.
TEST(GoalMatrix, PoliciesAreInTheOrderOfTheirSkill) {
  GoalMatrixConfig config;
  for (const char* policy : {"still", "random", "pattern", "blocking", "intercepting"})
    config.keepers.push_back(keeperText(policy));
  for (const char* kind : {"roll", "yardstick-v1"}) config.strikers.push_back(strikerText(kind));
  config.episodes = 150;
  const GoalMatrix matrix = playMatrix(config, {.threads = 2});
  const auto scoring = [&](std::size_t k, std::size_t s) { return matrix.cell(k, s).scoring(); };
  for (const std::size_t moving : {1u, 2u}) {
    EXPECT_GT(scoring(0, 1).low, scoring(moving, 1).high);
    EXPECT_GT(scoring(moving, 1).low, scoring(3, 1).high);
  }
  EXPECT_GT(scoring(3, 1).low, scoring(4, 1).high);
  EXPECT_LT(matrix.difference(4, 3, 1).high, 0.0);
  for (const std::size_t moving : {0u, 1u, 2u})
    EXPECT_GT(scoring(moving, 0).low, scoring(3, 0).high);
  EXPECT_GT(scoring(3, 0).low, scoring(4, 0).high);
  EXPECT_GT(*matrix.cell(0, 1).meanTimeToScore(), 0.5);
}

TEST(GoalMatrix, SkillCostsWhatItIsWorth) {
  GoalMatrixConfig config;
  config.keepers = {"goalkeeper:policy=intercepting", "goalkeeper:policy=intercepting&delay_s=0.4",
                    "goalkeeper:policy=intercepting&speed_m_s=0.4"};
  config.strikers = {strikerText("shot")};
  config.episodes = 100;
  const GoalMatrix matrix = playMatrix(config, {.threads = 2});
  EXPECT_GT(matrix.difference(1, 0, 0).low, 0.1);
  EXPECT_GT(matrix.difference(2, 0, 0).low, 0.1);
}

TEST(GoalMatrix, AFileIsReadAsItWasWritten) {
  const GoalMatrix matrix = playMatrix(someConfig(4), {});
  const std::string json = toJson(matrix, "1.2");
  const GoalMatrix again = readGoalMatrix(json, "m.json");
  EXPECT_EQ(again.config, matrix.config);
  expectSame(again, matrix);
  EXPECT_EQ(toJson(again, "1.2"), json);
  std::uint64_t played = 0;
  EXPECT_TRUE(verify(again, 1000, 1, {.threads = 2}, played).empty());
  EXPECT_EQ(played, 24u);
}

TEST(GoalMatrix, VerifyFindsATamperedEpisode) {
  GoalMatrix matrix = playMatrix(someConfig(4), {});
  GoalEpisode& episode = matrix.cells[3].episodes[2];
  episode.outcome = episode.outcome == GoalOutcome::goal ? GoalOutcome::saved : GoalOutcome::goal;
  // Written with a hash that fits, so that nobody sees it by reading.
  const GoalMatrix read = readGoalMatrix(toJson(matrix, "1"), "m.json");
  std::uint64_t played = 0;
  const auto found = verify(read, 1000, 1, {}, played);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].number, 2u);
  EXPECT_EQ(found[0].keeper, matrix.cells[3].keeper);
  EXPECT_NE(found[0].told, found[0].found);
}

std::string readingOf(const nlohmann::ordered_json& json) {
  try {
    readGoalMatrix(json.dump(), "m.json");
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(GoalMatrix, DamagedFilesAreRefusedWithTheReason) {
  const auto good = nlohmann::ordered_json::parse(toJson(playMatrix(someConfig(3), {}), "1"));
  ASSERT_EQ(readingOf(good), "");
  const auto with = [&](const char* pointer, const nlohmann::ordered_json& value) {
    auto bad = good;
    bad[nlohmann::ordered_json::json_pointer(pointer)] = value;
    return readingOf(bad);
  };
  EXPECT_NE(with("/format", "x").find("expected the format"), std::string::npos);
  EXPECT_NE(with("/cells/0/outcomes", "ggx").find("outcome 'x'"), std::string::npos);
  EXPECT_NE(with("/cells/0/outcomes", "gg").find("2 outcomes"), std::string::npos);
  EXPECT_NE(with("/cells/1/ends_us/1", 5).find("its hash is"), std::string::npos);
  EXPECT_NE(with("/episodes", 4).find("expected those of 4"), std::string::npos);
  EXPECT_NE(with("/episodes", -4).find("m.json"), std::string::npos);
  EXPECT_NE(with("/shard", 2).find("shard is 2/1"), std::string::npos);
  EXPECT_NE(with("/cells/0/keeper", "other").find("cell 0"), std::string::npos);
  EXPECT_NE(with("/cells", nullptr).find("a cell for each"), std::string::npos);
  EXPECT_NE(with("/seed", "x").find("m.json"), std::string::npos);
}

TEST(GoalMatrix, BadEntriesAreRefusedByName) {
  const auto why = [](const std::string& keeper, const std::string& striker) -> std::string {
    GoalMatrixConfig config;
    config.keepers = {keeper};
    config.strikers = {striker};
    config.episodes = 1;
    try {
      playMatrix(config, {});
      return "";
    } catch (const std::exception& error) {
      return error.what();
    }
  };
  EXPECT_NE(why("nobody", "striker").find("'nobody'"), std::string::npos);
  EXPECT_NE(why("goalkeeper:policy=x", "striker").find("policy is 'x'"), std::string::npos);
  EXPECT_NE(why("goalkeeper@blue", "striker").find("gives team, name and start"),
            std::string::npos);
  EXPECT_NE(why("wander", "striker").find("names no robot file"), std::string::npos);
  // One that has nothing to see by is stopped, and the message says in which episode.
  const std::string stopped = why("goalkeeper:stage=no", "striker");
  EXPECT_NE(stopped.find("needs the world's state"), std::string::npos) << stopped;
}

}  // namespace
}  // namespace ortung
