#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "Files.hpp"
#include "Played.hpp"
#include "ortung/benchmark/GoalEpisodes.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung::learning {
namespace {

using ortung::test::readBytes;
using ortung::test::TemporaryFolder;
using test::heuristicActions;
using test::playedHash;

constexpr std::array kQuick = {"goalkeeper-v0", "striker-v0", "keeper-vs-striker-v0"};

std::string whyNot(const auto& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(Batch, TheSameBitsFromAnyNumberOfThreads) {
  for (const EnvironmentInfo& info : environments()) {
    const bool isQuick = info.id != "localize-and-score-v0";
    const auto play = [&](unsigned threads) {
      Batch batch(info.id, {}, {.episodes = isQuick ? 12u : 3u, .threads = threads, .seed = 5});
      return playedHash(batch, isQuick ? 60 : 10);
    };
    const std::uint64_t alone = play(1);
    EXPECT_EQ(play(2), alone) << info.id;
    EXPECT_EQ(play(5), alone) << info.id;
  }
}

TEST(Batch, AnEpisodeIsAFunctionOfSeedAndNumberAlone) {
  for (const char* id : kQuick) {
    Batch many(id, {}, {.episodes = 4, .seed = 11});
    Batch one(id, {}, {.episodes = 1, .seed = 13});  // the third one's
    const std::size_t size = one.observations().size();
    for (int i = 0; i < 150; ++i) {  // several episodes, one after the other
      const auto third = many.observations().subspan(2 * size, size);
      ASSERT_TRUE(std::equal(third.begin(), third.end(), one.observations().begin())) << id << i;
      ASSERT_EQ(many.numbers()[2], one.numbers()[0]);
      many.step(heuristicActions(many));
      one.step(heuristicActions(one));
    }
    EXPECT_GT(one.numbers()[0], 0u) << id;
  }
}

// With so many, the memory of the next one is asked for while one is stepped.
TEST(Batch, EpisodesAreTheSameAmongManyAndFew) {
  constexpr std::size_t kMany = 130;
  Batch many("goalkeeper-v0", {}, {.episodes = kMany, .threads = 2, .seed = 50});
  Batch few("goalkeeper-v0", {}, {.episodes = 2, .seed = 50 + kMany - 2});
  for (int i = 0; i < 60; ++i) {
    many.step(heuristicActions(many));
    few.step(heuristicActions(few));
    const auto last = many.observations().last(few.observations().size());
    ASSERT_TRUE(std::equal(last.begin(), last.end(), few.observations().begin())) << i;
  }
  EXPECT_GT(few.numbers()[0], 0u);
}

TEST(Batch, WithoutASeedTheNextEpisodeComesAndASeedBeginsAnew) {
  Batch batch("goalkeeper-v0", {}, {.episodes = 2, .seed = 3});
  const std::vector<float> first(batch.observations().begin(), batch.observations().end());
  batch.reset();
  EXPECT_EQ(batch.numbers()[0], 1u);
  EXPECT_FALSE(std::equal(first.begin(), first.end(), batch.observations().begin()));
  batch.reset(0, 3);
  batch.reset(1, 4);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), batch.observations().begin()));
}

// docs/learning.md tells the memory of an episode, of which a tenth more is allowed: some of it are
// paths of files, which are as long as they are. The engine's stack is left out: it touches the
// first few of its 100 kB, so the others take no memory.
TEST(Batch, AnEpisodeTakesLittleMemory) {
  const auto used = [] { return static_cast<double>(mallinfo2().uordblks); };
  if (used() == 0.0) GTEST_SKIP() << "another allocator, which does not tell";
  constexpr double kStack = 102'400.0;
  constexpr std::size_t kEpisodes = 64;
  const Options shot = {{"striker", {std::string("shot")}}};
  Batch first("goalkeeper-v0", shot, {.episodes = 1});  // loads what all share
  const double before = used();
  Batch batch("goalkeeper-v0", shot, {.episodes = kEpisodes});
  for (int i = 0; i < 60; ++i) batch.step(heuristicActions(batch));
  EXPECT_LT((used() - before) / kEpisodes - kStack, 1.1 * 61'000.0);
}

TEST(Batch, SomePlacesBeginAnewAndTheOthersStayWhereTheyAre) {
  Batch batch("goalkeeper-v0", {}, {.episodes = 3, .threads = 2, .seed = 3});
  batch.step(heuristicActions(batch));
  const auto rowOf = [&](const Batch& of, std::size_t i) {
    const auto row =
        of.observations().subspan(i * of.info().observation.size(), of.info().observation.size());
    return std::vector<float>(row.begin(), row.end());
  };
  const std::vector<float> kept = rowOf(batch, 1);
  const std::vector<std::uint8_t> places = {1, 0, 1};
  const std::vector<std::optional<std::uint64_t>> seeds = {40, 41, std::nullopt};
  batch.reset(places, seeds);
  EXPECT_EQ(rowOf(batch, 1), kept);
  Batch alone("goalkeeper-v0", {}, {.episodes = 1, .seed = 40});
  EXPECT_EQ(rowOf(batch, 0), rowOf(alone, 0));
  Batch last("goalkeeper-v0", {}, {.episodes = 1, .seed = 5});
  last.reset();
  EXPECT_EQ(rowOf(batch, 2), rowOf(last, 0));
  EXPECT_EQ(batch.seeds()[1], 4u);
  EXPECT_EQ(batch.numbers()[2], 1u);
  batch.reset(places, {});
  EXPECT_EQ(batch.numbers()[0], 1u);
  EXPECT_NE(whyNot([&] { batch.reset(std::vector<std::uint8_t>(2), {}); }).find("2 flags"),
            std::string::npos);
  EXPECT_NE(whyNot([&] { batch.reset(places, std::span(seeds).first(1)); }).find("1 seeds"),
            std::string::npos);
}

/// The keeper that does nothing is the benchmark's `still`, so both play the same episodes.
TEST(Batch, PlaysTheEpisodesOfTheBenchmark) {
  GoalEpisodes benchmark;
  for (const char* kind : {"roll", "shot", "dribble"}) {
    constexpr std::size_t kEpisodes = 8;
    Batch batch("goalkeeper-v0", {{"striker", {std::string(kind)}}, {"cycle_ms", {10.0}}},
                {.episodes = 1, .autoreset = Autoreset::kNextStep, .seed = 77});
    const std::vector<float> nothing(2);
    for (std::size_t n = 0; n < kEpisodes; ++n) {
      const GoalEpisode truth = benchmark.play("goalkeeper:policy=still", strikerText(kind), 77, n);
      do batch.step(nothing);
      while (batch.endings()[0] == 0);
      EXPECT_EQ(batch.endings()[0], static_cast<int>(truth.outcome) + 1) << kind << n;
      EXPECT_NEAR(static_cast<double>(batch.states()[0]), toSeconds(truth.end), 1e-6) << kind << n;
      EXPECT_EQ(batch.numbers()[0], n);
      batch.step(nothing);  // begins the next one
      EXPECT_EQ(batch.endings()[0], 0);
    }
  }
}

TEST(Batch, NextStepTakesNoActionAndGivesNoReward) {
  Batch batch("goalkeeper-v0", {{"striker", {std::string("roll")}}}, {.seed = 1});
  const std::vector<float> nothing(2);
  while (batch.endings()[0] == 0) batch.step(nothing);
  EXPECT_TRUE(batch.terminated()[0]);
  EXPECT_NE(batch.rewards()[0], 0.0);
  batch.step(nothing);
  EXPECT_EQ(batch.numbers()[0], 1u);
  EXPECT_FALSE(batch.terminated()[0] || batch.truncated()[0]);
  EXPECT_EQ(batch.rewards()[0], 0.0);
  EXPECT_EQ(batch.states()[0], 0.0f);
}

TEST(Batch, SameStepHasTheEndAmongItsFinalObservations) {
  Batch next("goalkeeper-v0", {}, {.autoreset = Autoreset::kNextStep, .seed = 9});
  Batch same("goalkeeper-v0", {}, {.autoreset = Autoreset::kSameStep, .seed = 9});
  const std::vector<float> nothing(2);
  while (next.endings()[0] == 0) {
    next.step(nothing);
    same.step(nothing);
    ASSERT_EQ(next.endings()[0], same.endings()[0]);
  }
  EXPECT_TRUE(std::equal(next.observations().begin(), next.observations().end(),
                         same.finalObservations().begin()));
  EXPECT_EQ(same.rewards()[0], next.rewards()[0]);
  next.step(nothing);
  EXPECT_TRUE(std::equal(next.observations().begin(), next.observations().end(),
                         same.observations().begin()));
}

TEST(Batch, AnEpisodeThatIsOverMustBeReset) {
  Batch batch("goalkeeper-v0", {}, {.episodes = 2, .autoreset = Autoreset::kDisabled, .seed = 9});
  const std::vector<float> nothing(4);
  while (batch.endings()[0] == 0 && batch.endings()[1] == 0) batch.step(nothing);
  const std::size_t over = batch.endings()[0] != 0 ? 0 : 1;
  const float before = batch.states()[(1 - over) * 12];
  EXPECT_EQ(whyNot([&] { batch.step(nothing); }),
            "episode " + std::to_string(over) +
                " of goalkeeper-v0 is over, and must be reset before it is stepped again");
  EXPECT_EQ(batch.states()[(1 - over) * 12], before);  // nothing has moved
  batch.reset(over, {});
  batch.step(nothing);
}

TEST(Batch, AResetForgetsHowEpisodesEnded) {
  for (const int how : {0, 1, 2}) {
    Batch batch("goalkeeper-v0", {{"striker", {std::string("roll")}}},
                {.episodes = 2, .autoreset = Autoreset::kDisabled, .seed = 1});
    const std::vector<float> nothing(4);
    while (batch.endings()[0] == 0 && batch.endings()[1] == 0) batch.step(nothing);
    if (how == 0) batch.reset();
    if (how == 1) batch.reset(std::vector<std::uint64_t>{5, 6});
    if (how == 2)
      for (const std::size_t episode : {0, 1}) batch.reset(episode, {});
    for (const std::size_t episode : {0, 1}) {
      EXPECT_EQ(batch.rewards()[episode], 0.0) << how;
      EXPECT_EQ(batch.terminated()[episode], 0) << how;
      EXPECT_EQ(batch.truncated()[episode], 0) << how;
      EXPECT_EQ(batch.endings()[episode], 0) << how;
    }
    batch.step(nothing);
  }
}

TEST(Batch, TheTrueBallIsSeenFromTheFirstMomentOn) {
  Batch batch("keeper-vs-striker-v0", {{"observation", {std::string("truth")}}},
              {.episodes = 6, .seed = 3});
  const std::size_t seen = batch.info().observation.size();
  for (std::size_t e = 0; e < batch.size(); ++e) {
    const auto state = batch.states().subspan(12 * e, 12);
    const auto keeper = batch.observations().subspan(2 * e * seen, seen);
    EXPECT_NEAR(keeper[8], state[1] + 6.0f, 1e-5);
    EXPECT_NEAR(keeper[9], state[2], 1e-5);
  }
}

TEST(Batch, TimeTruncates) {
  Batch batch("keeper-vs-striker-v0", {{"duration_s", {1.0}}}, {.seed = 2});
  const std::vector<float> nothing(6);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(batch.truncated()[0], 0);
    batch.step(nothing);
  }
  EXPECT_EQ(batch.truncated()[0], 1);
  EXPECT_EQ(batch.terminated()[0], 0);
  EXPECT_EQ(batch.endings()[0], static_cast<std::uint8_t>(Ending::kTime));
}

TEST(Batch, WhatOneWinsTheOtherLoses) {
  Batch batch("keeper-vs-striker-v0", {}, {.episodes = 8, .seed = 2});
  double won = 0.0;
  for (int i = 0; i < 60; ++i) {
    batch.step(heuristicActions(batch));
    for (std::size_t e = 0; e < batch.size(); ++e) {
      EXPECT_EQ(batch.rewards()[2 * e], -batch.rewards()[2 * e + 1]);
      won += std::abs(batch.rewards()[2 * e]);
    }
  }
  EXPECT_GT(won, 0.0);
}

/// By the state, which comes another way.
TEST(Batch, ObservationsSayWhereThingsAre) {
  for (const char* how : {"truth", "features"}) {
    Batch batch("keeper-vs-striker-v0", {{"observation", {std::string(how)}}},
                {.episodes = 6, .seed = 21});
    const std::size_t seen = batch.info().observation.size();
    for (int step = 0; step < 15; ++step) batch.step(heuristicActions(batch));
    for (std::size_t e = 0; e < batch.size(); ++e) {
      const auto state = batch.states().subspan(12 * e, 12);
      if (state[0] < 1.4f) continue;  // another episode has begun
      const auto keeper = batch.observations().subspan(2 * e * seen, seen);
      const auto striker = batch.observations().subspan((2 * e + 1) * seen, seen);
      EXPECT_NEAR(keeper[0], state[5] + 6.0f, 1e-5);
      EXPECT_NEAR(keeper[1], state[6], 1e-5);
      EXPECT_NEAR(std::atan2(striker[3], striker[2]), state[10], 1e-5);
      EXPECT_NEAR(keeper[7], 10.0f - state[0], 1e-5);
      // The camera is out by 3 % of the way and more; sights are up to 0.04 s old.
      const double tolerance = std::string(how) == "truth" ? 0.25 : 0.6;
      EXPECT_NEAR(keeper[8], state[1] + 6.0f, tolerance) << how;
      EXPECT_NEAR(keeper[9], state[2], tolerance) << how;
      EXPECT_NEAR(striker[23], state[5] + 6.0f, tolerance) << how;
      for (std::size_t i = 0; i < seen; ++i) {
        EXPECT_GE(keeper[i], batch.info().observation[i].low);
        EXPECT_LE(keeper[i], batch.info().observation[i].high);
      }
    }
  }
}

TEST(Batch, BadActionsAreRefusedByPlaceAndNothingMoves) {
  Batch batch("keeper-vs-striker-v0", {}, {.episodes = 3});
  const std::vector<float> before(batch.states().begin(), batch.states().end());
  std::vector<float> actions(18);
  EXPECT_EQ(whyNot([&] { batch.step(std::span(actions).first(17)); }),
            "keeper-vs-striker-v0: actions of 17 numbers, expected 18 (3 episodes, 2 agents, 3 "
            "numbers)");
  actions[6 + 3 + 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(whyNot([&] { batch.step(actions); }),
            "episode 1 of keeper-vs-striker-v0: the action of striker has nan as 'turn', expected "
            "a finite number");
  EXPECT_TRUE(std::equal(before.begin(), before.end(), batch.states().begin()));
  actions[6 + 3 + 1] = 1e30f;  // counts as 1
  batch.step(actions);
}

// An action has as many numbers as that of the agent with the most.
TEST(Batch, WhatAnAgentDoesNotUseMayBeAnything) {
  Batch batch("keeper-vs-striker-v0", {}, {.episodes = 2});
  Batch same("keeper-vs-striker-v0", {}, {.episodes = 2});
  ASSERT_EQ(batch.info().actions[0].size(), 2u) << "a keeper does not kick";
  ASSERT_EQ(batch.info().actions[1].size(), 3u);
  std::vector<float> actions(12, 0.5f);
  same.step(actions);
  for (const std::size_t unused : {2u, 6u + 2u})
    actions[unused] = std::numeric_limits<float>::quiet_NaN();
  batch.step(actions);
  EXPECT_TRUE(std::equal(batch.states().begin(), batch.states().end(), same.states().begin()));
}

TEST(Batch, TheEnvironmentNamesAndPlacesItsPlayers) {
  for (const char* said :
       {"striker:kind=roll@blue", "striker:kind=roll&name=bert", "striker:kind=roll&start=1,2,3"})
    EXPECT_NE(whyNot([&] {
                Batch("goalkeeper-v0", {{"striker", {std::string(said)}}}, {});
              }).find("the environment sets team, name and start"),
              std::string::npos)
        << said;
}

TEST(Batch, RecordsOfAPlaceAreThoseOfItsSeedAndNumberAlone) {
  const TemporaryFolder folder;
  const auto play = [&](std::uint64_t seed, std::size_t episodes, std::size_t place,
                        const std::string& name) {
    Batch batch("goalkeeper-v0", {}, {.episodes = episodes, .threads = 2, .seed = seed});
    batch.record(place, folder.path() / (name + "-{seed}-{number}.rec"));
    batch.reset();  // the present episodes are number 0
    while (batch.numbers()[place] < 3) batch.step(heuristicActions(batch));
  };
  play(21, 1, 0, "one");
  play(20, 4, 1, "many");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "one-21-0.rec"));
  for (const char* end : {"-21-1.rec", "-21-2.rec"}) {
    const std::string record = readBytes(folder.path() / (std::string("one") + end));
    EXPECT_GT(record.size(), 500U);
    EXPECT_EQ(readBytes(folder.path() / (std::string("many") + end)), record);
  }
  EXPECT_NE(readBytes(folder.path() / "one-21-1.rec"), readBytes(folder.path() / "one-21-2.rec"));
}

TEST(Batch, RecordsDontTouchAnEpisodeAndAnEmptyNameEndsThem) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "striker.rec";
  const auto hashOf = [&](bool records) {
    Batch batch("striker-v0", {}, {.episodes = 2, .seed = 8});
    if (records) batch.record(1, file);
    return playedHash(batch, 150);
  };
  EXPECT_EQ(hashOf(true), hashOf(false));
  Batch batch("striker-v0", {}, {.episodes = 1, .seed = 8});
  batch.record(0, file);
  batch.reset();
  batch.step(heuristicActions(batch));
  batch.record(0, {});
  const std::string whole = readBytes(file);
  batch.step(heuristicActions(batch));
  batch.reset();
  EXPECT_EQ(readBytes(file), whole);
}

TEST(Batch, BadOptionsAreRefusedByName) {
  const auto make = [](const char* id, const Options& options) {
    return whyNot([&] { Batch(id, options, {}); });
  };
  EXPECT_EQ(make("goalkeeper-v9", {}),
            "there is no environment 'goalkeeper-v9', expected goalkeeper-v0, striker-v0, "
            "keeper-vs-striker-v0, localize-and-score-v0 (did you mean 'goalkeeper-v0'?)");
  EXPECT_EQ(make("striker-v0", {{"keeper", {std::string("blokcing")}}})
                .find("keeper is 'blokcing', expected blocking, "),
            0U);
  EXPECT_NE(make("goalkeeper-v0", {{"strikr", {std::string("roll")}}}).find("strikr"),
            std::string::npos);
  const std::string kind = make("goalkeeper-v0", {{"striker", {std::string("striker:kind=lob")}}});
  EXPECT_NE(kind.find("lob"), std::string::npos) << kind;
  for (const char* more : {"@yellow", ":name=a", ":start=0,0,0"}) {
    const std::string own = make("goalkeeper-v0", {{"striker", {std::string("striker") + more}}});
    EXPECT_NE(own.find("sets team, name and start"), std::string::npos) << more << ": " << own;
  }
  EXPECT_NE(make("goalkeeper-v0", {{"action_s", {0.15}}}).find("multiple of cycle_ms"),
            std::string::npos);
  EXPECT_NE(make("goalkeeper-v0", {{"observation", {std::string("localized")}}}).find("features"),
            std::string::npos);
  EXPECT_EQ(whyNot([] { Batch("goalkeeper-v0", {}, {.episodes = 0}); }),
            "BatchConfig::episodes is 0, must be in [1, 65536]");
  Batch batch("goalkeeper-v0", {}, {.episodes = 2});
  EXPECT_EQ(whyNot([&] { batch.reset(std::vector<std::uint64_t>{1}); }),
            "goalkeeper-v0: 1 seeds, expected 2");
}

TEST(Batch, OptionsHoldForEpisodesThatBegin) {
  Batch batch("goalkeeper-v0", {}, {.episodes = 2, .seed = 4});
  Batch roll("goalkeeper-v0", {{"striker", {std::string("roll")}}}, {.episodes = 2, .seed = 4});
  batch.setOptions(1, {{"striker", {std::string("roll")}}});
  EXPECT_THROW(batch.setOptions(0, {{"striker", {std::string("nobody")}}}), std::exception);
  batch.reset(std::vector<std::uint64_t>{4, 5});
  const std::size_t seen = batch.info().observation.size();
  const auto differs = [&](std::size_t e) {
    const auto a = batch.states().subspan(12 * e, 12);
    return !std::equal(a.begin(), a.end(), roll.states().begin() + static_cast<long>(12 * e));
  };
  EXPECT_TRUE(differs(0));
  EXPECT_FALSE(differs(1));
  EXPECT_EQ(seen, 26u);
}

}  // namespace
}  // namespace ortung::learning
