#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "Files.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"
#include "ortung/benchmark/Ratings.hpp"
#include "ortung/core/PluginFactory.hpp"

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

TEST(GoalMatrix, MisspeltShortNamesAreToldWithTheNearestFirst) {
  GoalEpisodes episodes;
  const auto complaint = [&](const std::string& keeper, const std::string& striker) {
    return test::messageOf<PluginError>(
        [&] { episodes.check(keeperText(keeper), strikerText(striker)); });
  };
  const std::string keeper = complaint("blokcing", "shot");
  EXPECT_NE(keeper.find("there is no plugin 'blokcing'"), keeper.npos) << keeper;
  EXPECT_TRUE(
      keeper.ends_with("; did you mean 'blocking'? policies of goalkeepers "
                       "(goalkeeper:policy=...) are blocking, intercepting, mixed, still, "
                       "random, pattern"))
      << keeper;
  const std::string striker = complaint("still", "dribbel:delay_s=1");
  EXPECT_NE(
      striker.find("did you mean 'dribble'? kinds of strikers (striker:kind=...) are dribble"),
      striker.npos)
      << striker;
  const std::string neither = complaint("xyzzyx", "shot");
  EXPECT_NE(neither.find("are still, random, pattern"), neither.npos) << neither;
  EXPECT_NE(neither.find("are roll, shot, dribble"), neither.npos) << neither;
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

TEST(GoalMatrix, PoseErrorsAreThoseOfTheEpisodesInWhichAPoseWasTold) {
  GoalCell cell;
  EXPECT_FALSE(cell.keeperError());
  const PoseError errors[] = {{10'000, 2'000}, {}, {40'000, 1'000}, {100'000, 9'000}};
  for (const PoseError& error : errors) cell.episodes.push_back({.keeper = error});
  EXPECT_FALSE(cell.strikerError());
  cell.episodes[1].striker = {7, 8};
  const auto found = cell.keeperError();  // in metres and radians of millionths
  ASSERT_TRUE(found);
  EXPECT_EQ(found->episodes, 3u);
  EXPECT_NEAR(found->mean, 0.05, 1e-12);
  EXPECT_NEAR(found->median, 0.04, 1e-12);
  EXPECT_NEAR(found->meanHeading, 0.004, 1e-12);
  EXPECT_NEAR(found->medianHeading, 0.002, 1e-12);
  ASSERT_TRUE(cell.strikerError());
  EXPECT_EQ(cell.strikerError()->episodes, 1u);
  EXPECT_NEAR(cell.strikerError()->meanHeading, 8e-6, 1e-15);
}

/// The angle between two headings, which knows of no turns.
double angleBetween(double a, double b) {
  return std::atan2(std::abs(std::cos(a) * std::sin(b) - std::sin(a) * std::cos(b)),
                    std::cos(a) * std::cos(b) + std::sin(a) * std::sin(b));
}

// Strikers look towards negative x, where headings jump by a turn.
TEST(GoalMatrix, PoseErrorsAreTheMeanOfWhatIsBelievedWheneverAPlayerActs) {
  struct Sum {
    void add(const std::optional<BelievedPose>& believed, const Pose2& truth, Timestamp now) {
      if (!believed || believed->stamp != now) return;
      ++count;
      position += std::hypot(believed->pose.x - truth.x, believed->pose.y - truth.y);
      heading += angleBetween(believed->pose.theta, truth.theta);
      jumps += std::abs(believed->pose.theta - truth.theta) > 3.0 ? 1 : 0;
    }
    void expect(const PoseError& told) const {
      ASSERT_GT(count, 10);
      EXPECT_NEAR(told.position, 1e6 * position / count, 1.0);
      EXPECT_NEAR(told.heading, 1e6 * heading / count, 1.0);
    }
    int count = 0, jumps = 0;
    double position = 0.0, heading = 0.0;
  };
  GoalEpisodes episodes;
  int jumps = 0;
  for (const std::uint64_t i : {5, 14, 20}) {
    Sum keeper, striker;
    const GoalEpisode played =
        episodes.play(withSight(keeperText("intercepting"), "localized"),
                      strikerText("dribble:sees=localized"), 4, i, [&](const GoalMoment& moment) {
                        keeper.add(moment.keeperBelieves, moment.keeper, moment.stamp);
                        striker.add(moment.strikerBelieves, moment.striker, moment.stamp);
                      });
    keeper.expect(played.keeper);
    striker.expect(played.striker);
    jumps += striker.jumps;
  }
  EXPECT_GT(jumps, 0) << "or nothing is tested here";
}

// However keepers and strikers see.
TEST(GoalMatrix, AllWaysToSeeGiveTheSameBitsFromThreadsAndShards) {
  GoalMatrixConfig config;
  for (const char* sees : {"truth", "features", "scan", "localized"})
    config.keepers.push_back(withSight(keeperText("intercepting"), sees));
  config.strikers = {strikerText("dribble:sees=localized")};
  config.episodes = 2;
  config.seed = 4;
  const auto tables = std::make_shared<TableStore>(GoalEpisodes::world());
  const GoalMatrix one = playMatrix(config, {.tables = tables});
  expectSame(one, playMatrix(config, {.threads = 2}));
  std::vector<GoalMatrix> shards;
  for (const std::uint64_t shard : {1u, 2u}) {
    GoalMatrixConfig part = config;
    part.shard = shard;
    part.shards = 2;
    shards.push_back(playMatrix(part, {.tables = tables}));
  }
  expectSame(one, mergeShards(shards));
  const GoalMatrix read = readGoalMatrix(toJson(one, "1"), "m.json");
  expectSame(one, read);
  std::uint64_t played = 0;
  EXPECT_TRUE(verify(read, 100, 1, {.tables = tables}, played).empty());
  EXPECT_EQ(played, 8u);
  for (std::size_t k = 0; k < 4; ++k) {
    ASSERT_TRUE(one.cell(k, 0).keeperError());
    // Ground truth is told in millimetres.
    EXPECT_LT(one.cell(k, 0).keeperError()->mean, k == 0 ? 1e-9 : k == 1 ? 1e-3 : 0.05);
    ASSERT_TRUE(one.cell(k, 0).strikerError());
    EXPECT_GT(one.cell(k, 0).strikerError()->mean, 0.0);
    EXPECT_LT(one.cell(k, 0).strikerError()->mean, 0.2);
    EXPECT_EQ(one.baselineOf(k), 0u);
  }
}

// It finds the ball by its camera and itself by MCL; nobody keeps the goal.
TEST(GoalMatrix, SeekersScoreByTheirOwnSensors) {
  GoalMatrixConfig config;
  config.keepers = {keeperText("still")};
  config.strikers = {strikerText("seeker"), strikerText("seeker:sees=truth")};
  config.episodes = 30;
  const GoalMatrix matrix = playMatrix(config, {.threads = 2});
  EXPECT_GT(matrix.cell(0, 0).count(GoalOutcome::kGoal), 12u);
  EXPECT_GT(matrix.cell(0, 1).count(GoalOutcome::kGoal), 18u);
  EXPECT_LT(matrix.cell(0, 0).strikerError()->mean, 0.1);
}

// Scanners are added behind the other sensors, so that these have the same noise.
TEST(GoalMatrix, AScannerAloneChangesNothing) {
  GoalEpisodes episodes;
  const std::string keeper = "goalkeeper:policy=intercepting&sees=features";
  for (std::uint64_t i = 0; i < 3; ++i) {
    const GoalEpisode bare = episodes.play(keeper, strikerText("dribble"), 5, i);
    for (const char* robot : {"&robot=goalkeeper_scan.toml", "&robot=goalkeeper_lrf.toml"})
      EXPECT_EQ(bare, episodes.play(keeper + robot, strikerText("dribble"), 5, i)) << robot;
    EXPECT_NE(bare, episodes.play("goalkeeper:policy=intercepting&sees=scan",
                                  strikerText("dribble"), 5, i));
  }
}

TEST(GoalMatrix, ShortNamesMayHaveOptions) {
  EXPECT_EQ(keeperText("blocking:delay_s=1&sees=scan"),
            "goalkeeper:policy=blocking&delay_s=1&sees=scan");
  EXPECT_EQ(shortName(keeperText("blocking:delay_s=1")), "blocking:delay_s=1");
  EXPECT_EQ(strikerText("seeker"), "striker:kind=seeker");
  EXPECT_EQ(keeperText("my_keeper:blocking=2"), "my_keeper:blocking=2");
  EXPECT_EQ(withSight("my_keeper", "scan"), "my_keeper:sees=scan");
  EXPECT_EQ(withSight("my_keeper:sees=truth&a=1", "scan"), "my_keeper:a=1&sees=scan");
  EXPECT_EQ(withSight("my_keeper:a=1&sees=truth&b=2", "scan"), "my_keeper:a=1&b=2&sees=scan");
  EXPECT_EQ(withSight("my_keeper:sees=truth", "scan"), "my_keeper:sees=scan");
}

// 100 episodes tell apart what the paper calls levels of skill.
TEST(GoalMatrix, PoliciesAreInTheOrderOfTheirSkill) {
  GoalMatrixConfig config;
  for (const char* policy : {"still", "random", "pattern", "blocking", "intercepting"})
    config.keepers.push_back(keeperText(policy));
  for (const char* kind : {"roll", "shot", "dribble", "yardstick-v1"})
    config.strikers.push_back(strikerText(kind));
  config.episodes = 100;
  const GoalMatrix matrix = playMatrix(config, {.threads = 2});
  const auto expectLess = [](const Interval& less, const Interval& more) {
    EXPECT_LT(less.high, more.low);
  };
  for (std::size_t s = 0; s < config.strikers.size(); ++s) {
    SCOPED_TRACE(config.strikers[s]);
    const auto scoring = [&](std::size_t k) { return matrix.cell(k, s).scoring(); };
    for (const std::size_t moving : {1u, 2u}) {
      expectLess(scoring(moving), scoring(0));
      expectLess(scoring(3), scoring(moving));
    }
    EXPECT_LT(scoring(4).value, scoring(3).value);
    EXPECT_LT(matrix.difference(4, 3, s).high, 0.0);
  }
  EXPECT_GT(*matrix.cell(0, 1).meanTimeToScore(), 0.5);
  const GoalRatings ratings = rate(matrix);
  for (const std::size_t moving : {1u, 2u}) {
    expectLess(ratings.keepers[0].points, ratings.keepers[moving].points);
    expectLess(ratings.keepers[moving].points, ratings.keepers[3].points);
  }
  expectLess(ratings.keepers[3].points, ratings.keepers[4].points);
  expectLess(ratings.keepers[4].scoring, ratings.keepers[3].scoring);
}

// A blind striker does not care whether the keeper moves about.
TEST(GoalMatrix, ABallToARandomPlaceIsNoHarderForWhoStands) {
  GoalMatrixConfig config;
  config.keepers = {keeperText("still"), keeperText("random"), keeperText("intercepting")};
  config.strikers = {strikerText("roll:aim=random")};
  config.episodes = 150;
  const GoalMatrix matrix = playMatrix(config, {.threads = 2});
  EXPECT_LT(matrix.difference(1, 0, 0).low, 0.0);
  EXPECT_GT(matrix.difference(1, 0, 0).high, 0.0);
  EXPECT_LT(matrix.cell(2, 0).scoring().high, 0.1);
}

TEST(GoalMatrix, SkillCostsWhatItIsWorth) {
  GoalMatrixConfig config;
  config.keepers = {"goalkeeper:policy=intercepting", "goalkeeper:policy=intercepting&delay_s=0.4",
                    "goalkeeper:policy=intercepting&speed_m_s=0.4",
                    "goalkeeper:policy=intercepting&noise_m=0.5"};
  config.strikers = {strikerText("shot")};
  config.episodes = 100;
  const GoalMatrix matrix = playMatrix(config, {.threads = 2});
  EXPECT_GT(matrix.difference(1, 0, 0).low, 0.1);
  EXPECT_GT(matrix.difference(2, 0, 0).low, 0.1);
  EXPECT_GT(matrix.difference(3, 0, 0).low, 0.1);
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
  episode.outcome =
      episode.outcome == GoalOutcome::kGoal ? GoalOutcome::kSaved : GoalOutcome::kGoal;
  // Written with a hash that fits, so that nobody sees it by reading.
  const GoalMatrix read = readGoalMatrix(toJson(matrix, "1"), "m.json");
  std::uint64_t played = 0;
  const auto found = verify(read, 1000, 1, {}, played);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].number, 2u);
  EXPECT_EQ(found[0].keeper, matrix.cells[3].keeper);
  EXPECT_NE(found[0].told, found[0].found);
}

// What is not in the digest could be changed without anybody noticing.
TEST(GoalMatrix, TheDigestOfACellCoversAllOfItsEpisodes) {
  const GoalMatrixConfig config = someConfig(2);
  GoalEpisode some;
  some.outcome = GoalOutcome::kSaved;
  some.end = 1'500'000;
  some.digest = 77;
  some.keeper = {12'000, 34'000};
  some.striker = {56'000, 78'000};
  const auto digestOf = [&](const GoalEpisode& first) {
    return GoalCell{"keeper", "striker", {first, some}}.hash(config);
  };
  std::vector<GoalEpisode> others(10, some);
  others[1].outcome = GoalOutcome::kGoal;
  others[2].end += 1;
  others[3].digest += 1;
  others[4].keeper.position += 1;
  others[5].keeper.heading += 1;
  others[6].striker.position += 1;
  others[7].striker.heading += 1;
  others[8].keeper = {};
  others[9].striker = {};
  std::set<std::uint64_t> digests;
  for (const GoalEpisode& other : others) digests.insert(digestOf(other));
  EXPECT_EQ(digests.size(), others.size()) << "each differs from the first, and from the others";
  // Who told no pose has no error, whatever stands there.
  GoalEpisode none = others[8];
  none.keeper.heading = 5;
  EXPECT_EQ(digestOf(none), digestOf(others[8]));
  EXPECT_NE((GoalCell{"keeper", "striker", {others[1], some}}.hash(config)),
            (GoalCell{"keeper", "striker", {some, others[1]}}.hash(config)))
      << "which episode is which counts, too";
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
  const auto refuses = [&](const char* pointer, const nlohmann::ordered_json& value,
                           const char* expected) {
    const std::string why = with(pointer, value);
    EXPECT_NE(why.find(expected), std::string::npos) << pointer << value << " " << why;
  };
  for (const char* key : {"/episodes", "/shard", "/shards"})
    for (const auto& value :
         {nlohmann::ordered_json(-1), nlohmann::ordered_json(0), nlohmann::ordered_json(1.5),
          nlohmann::ordered_json("1"), nlohmann::ordered_json(18446744073709551615U)})
      refuses(key, value, "expected 1 to 9223372036854775807");
  refuses("/seed", -1, "expected a whole number from 0 on");
  refuses("/seed", 1.5, "expected a whole number from 0 on");
  for (const auto& value :
       {nlohmann::ordered_json(-1), nlohmann::ordered_json(1.5),
        nlohmann::ordered_json(9223372036854775807), nlohmann::ordered_json("1")})
    refuses("/cells/0/ends_us/0", value, "an end is ");
  refuses("/keepers/0", "goal\x1b[2Jkeeper", "has control characters");
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

TEST(GoalMatrix, EpisodesAndShardsHaveLimits) {
  struct Numbers {
    std::uint64_t episodes, shard, shards;
  };
  const auto checked = [](const Numbers& numbers) {
    GoalMatrixConfig config = someConfig(1);
    config.episodes = numbers.episodes;
    config.shard = numbers.shard;
    config.shards = numbers.shards;
    config.check();
  };
  for (const Numbers& good :
       {Numbers{1, 1, 1}, {10'000'000, 1, 1}, {10, 1, 10}, {10, 10, 10}, {10, 3, 3}})
    EXPECT_NO_THROW(checked(good)) << good.episodes << " " << good.shard << "/" << good.shards;
  for (const Numbers& bad : {Numbers{0, 1, 1},
                             {10, 0, 1},
                             {10, 1, 0},
                             {10, 0, 0},
                             {10, 2, 1},
                             {10, 11, 10},
                             {10, 1, 11},
                             {10, 11, 11},
                             {10'000'001, 1, 1},
                             {1ULL << 63, 1, 1}})
    EXPECT_THROW(checked(bad), std::invalid_argument)
        << bad.episodes << " " << bad.shard << "/" << bad.shards;
}

TEST(GoalMatrix, PlayersAreGivenOnceAtLeastOneOfThem) {
  const auto why = [](const std::vector<std::string>& keepers,
                      const std::vector<std::string>& strikers) {
    GoalMatrixConfig config;
    config.keepers = keepers;
    config.strikers = strikers;
    try {
      config.check();
      return std::string();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(why({"a"}, {"a"}), "");
  EXPECT_EQ(why({}, {"a"}), "there are no keepers");
  EXPECT_EQ(why({"a"}, {}), "there are no strikers");
  EXPECT_EQ(why({"a", "b", "a"}, {"a"}), "'a' is given twice among the keepers");
  EXPECT_EQ(why({"a"}, {"a", "b", "b"}), "'b' is given twice among the strikers");
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
  // The benchmark's own are team, name and start.
  for (const char* more : {"@blue", ":name=a", ":start=0,0,0"}) {
    for (const std::string& found : {why(std::string("goalkeeper") + more, "striker"),
                                     why("goalkeeper", std::string("striker") + more)})
      EXPECT_NE(found.find("sets team, name and start"), std::string::npos)
          << more << ": " << found;
  }
  EXPECT_NE(why("wander", "striker").find("names no robot file"), std::string::npos);
  // One that has nothing to see by is stopped, and the message says in which episode.
  const std::string stopped = why("goalkeeper:stage=no", "striker");
  EXPECT_NE(stopped.find("needs the world's state"), std::string::npos) << stopped;
}

}  // namespace
}  // namespace ortung
