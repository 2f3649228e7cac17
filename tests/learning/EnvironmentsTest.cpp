#include <gtest/gtest.h>

#include <map>
#include <string>

#include "Played.hpp"

namespace ortung::learning {
namespace {

using test::heuristicActions;
using test::play;
using test::randomlyPlayedHash;
using test::Score;

/// What an environment's version promises. If this fails, a new version is needed: nobody could
/// compare what was learned before and after.
TEST(Environments, DoWhatTheyDidWhenTheyWereNew) {
  const std::map<std::string, std::uint64_t> golden = {
      {"goalkeeper-v0", 0x374d051d377bfb99U},
      {"striker-v0", 0xfeb0ca32a83bfdf5U},
      {"keeper-vs-striker-v0", 0xdda000129f373d5dU},
      {"localize-and-score-v0", 0x5709e9e5255f6e6aU}};
  for (const EnvironmentInfo& info : environments()) {
    // MCL may become better.
    const Options options = info.id == "localize-and-score-v0"
                                ? Options{{"observation", {std::string("features")}}}
                                : Options{};
    Batch batch(info.id, options, {.episodes = 4, .seed = 2026});
    EXPECT_EQ(randomlyPlayedHash(batch, 150), golden.at(info.id)) << info.id;
  }
}

TEST(Environments, GoalkeeperIsSolvedByItsHeuristic) {
  const auto score = [](const char* striker, const auto& act) {
    Batch batch("goalkeeper-v0", {{"striker", {std::string(striker)}}},
                {.episodes = 100, .threads = 2, .seed = 1});
    return play(batch, 50, act);
  };
  const auto blocks = [](const Batch& batch) {
    std::vector<float> actions(2 * batch.size());
    const std::size_t seen = batch.info().observation.size();
    for (std::size_t i = 0; i < batch.size(); ++i)
      blocking(batch.observations().subspan(i * seen, seen), std::span(actions).subspan(2 * i, 2));
    return actions;
  };
  const Score solved = score("shot", heuristicActions);
  const Score blocked = score("shot", blocks);
  EXPECT_GT(solved.saves / solved.episodes, 0.85);
  EXPECT_LT(blocked.saves / blocked.episodes, 0.5);
  EXPECT_GT(blocked.saves / blocked.episodes, 0.1);
  const Score yardstick = score("yardstick-v1", heuristicActions);
  const Score nothing = score(
      "yardstick-v1", [](const Batch& batch) { return std::vector<float>(2 * batch.size()); });
  EXPECT_LT(yardstick.goals / yardstick.episodes, 0.15);
  EXPECT_GT(nothing.goals / nothing.episodes, 0.85);
}

TEST(Environments, StrikerIsSolvedByItsHeuristic) {
  const auto score = [](const char* keeper) {
    Batch batch("striker-v0", {{"keeper", {std::string(keeper)}}},
                {.episodes = 60, .threads = 2, .seed = 1});
    return play(batch, 60, heuristicActions);
  };
  const Score still = score("still");
  const Score blocking = score("blocking");
  EXPECT_GT(still.goals / still.episodes, 0.9);
  // The benchmark's own strikers score 0.19 to 0.29 against it.
  EXPECT_GT(blocking.goals / blocking.episodes, 0.35);
}

TEST(Environments, LocalizeAndScoreIsSolvedByItsHeuristic) {
  Batch batch("localize-and-score-v0", {}, {.episodes = 12, .threads = 2, .seed = 1});
  const Score score = play(batch, 65, heuristicActions);
  EXPECT_GE(score.episodes, 12);
  EXPECT_GT(score.goals / score.episodes, 0.85);
}

TEST(Environments, HeuristicsRefuseWhatIsNoObservation) {
  std::vector<float> observation(5);
  std::vector<float> action(3);
  EXPECT_THROW(heuristic(environment("striker-v0"), 0, observation, action), std::invalid_argument);
  EXPECT_THROW(heuristic(environment("striker-v0"), 1, std::vector<float>(26), action),
               std::invalid_argument);
  EXPECT_THROW(blocking(observation, action), std::invalid_argument);
}

}  // namespace
}  // namespace ortung::learning
