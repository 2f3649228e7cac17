// A filter on a thread of its own: it learns, can be stopped at that, and never holds others up.
#include <gtest/gtest.h>

#include <latch>
#include <optional>
#include <thread>

#include "Await.hpp"
#include "LocalizedArena.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseFixData.hpp"

namespace ortung::test {
namespace {

using Kind = LocalizationState::Kind;
using OrderKind = LocalizationOrder::Kind;

/// Waits until the filter is in a state.
LocalizationState await(const FilterThread& filter, Kind kind) {
  EXPECT_TRUE(
      comesTrue("the filter is in that state", [&] { return filter.state().kind == kind; }));
  return filter.state();
}

/// Learns until it is cancelled.
std::shared_ptr<const RobotTables> learnForEver(const Robot&,
                                                const std::function<bool(double)>& goOn) {
  EXPECT_TRUE(comesTrue("learning is cancelled", [&] { return !goOn(0.25); }));
  return nullptr;
}

TEST(FilterThread, LearningIsCancelledBySwitchingItOff) {
  const LocalizedArena arena;
  FilterThread filter({arena.robotFile, learnForEver, 1});
  EXPECT_EQ(filter.state().kind, Kind::kOff);
  filter.order({OrderKind::kOn});
  EXPECT_EQ(filter.state().kind, Kind::kLearning) << "from now on";
  ASSERT_TRUE(comesTrue("learning has begun", [&] { return filter.state().progress > 0.0; }));
  EXPECT_DOUBLE_EQ(filter.state().progress, 0.25);
  EXPECT_EQ(filter.perceiver(), nullptr);
  filter.order({OrderKind::kOff});
  EXPECT_EQ(filter.state().kind, Kind::kOff);
  filter.order({OrderKind::kOn});
  ASSERT_TRUE(comesTrue("learning has begun", [&] { return filter.state().progress > 0.0; }));
  // Its end cancels learning, too.
}

TEST(FilterThread, SaysWhyItHasFailedAndCanTryAgain) {
  const LocalizedArena arena;
  bool fails = true;
  FilterThread filter({arena.robotFile,
                       [&](const Robot& robot, const std::function<bool(double)>& goOn) {
                         if (std::exchange(fails, false)) throw std::runtime_error("no such luck");
                         return arena.config().tables(robot, goOn);
                       },
                       1});
  filter.order({OrderKind::kOn});
  EXPECT_EQ(await(filter, Kind::kFailed).text, "no such luck");
  filter.order({OrderKind::kPlace, {0.5, -1.5, kTurn / 4}});
  await(filter, Kind::kSearching);
  EXPECT_NE(filter.perceiver(), nullptr);
  EXPECT_FALSE(filter.needs().empty());
  EXPECT_THROW(filter.order({OrderKind::kPlace, {50, 50, 0}}), std::invalid_argument);
}

TEST(FilterThread, AnOrderThatWaitsIsObeyedAfterAFailure) {
  const LocalizedArena arena;
  std::latch given{1};
  bool fails = true;
  FilterThread filter({arena.robotFile,
                       [&](const Robot& robot, const std::function<bool(double)>& goOn) {
                         given.wait();
                         if (std::exchange(fails, false)) throw std::runtime_error("no such luck");
                         return arena.config().tables(robot, goOn);
                       },
                       1});
  filter.order({OrderKind::kOn});
  filter.order({OrderKind::kPlace, {0.5, -1.5, kTurn / 4}});
  given.count_down();
  await(filter, Kind::kSearching);
  filter.order({OrderKind::kOff});
  filter.order({OrderKind::kOn});
  EXPECT_NE(filter.state().kind, Kind::kOff) << "the last order counts";
  await(filter, Kind::kSearching);
  EXPECT_NE(filter.perceiver(), nullptr);
}

/// The newest pose that the filter has published since it was asked last.
std::optional<std::pair<Timestamp, Pose2>> published(FilterThread& filter) {
  std::vector<Message> messages;
  filter.takePublished(messages);
  for (const Message& message : messages) {
    if (message.id.feature != "pose") continue;
    PoseFixData pose(message.id, {});
    pose.setData(message.stamp, message.words);
    return std::pair(message.stamp, pose.reading().at(0).pose);
  }
  return std::nullopt;
}

// A place is where the robot is when it is told, not where it was before what still waits.
TEST(FilterThread, ObeysAnOrderAfterTheReadingsThatCameBeforeIt) {
  const LocalizedArena arena;
  FilterThread filter({arena.robotFile, arena.config().tables, 1});
  filter.order({OrderKind::kPlace, {0.5, -1.5, 0.0}});
  await(filter, Kind::kSearching);
  const auto odometry = [&](int cycle) {
    const double x = 0.02 * cycle;
    return std::vector<Message>{{cycle * 33'000,
                                 {"odometry", "odometry", "pose"},
                                 OdometryData::encode({{x, 0.0, 0.0}, 0.6, 0.0, {}})}};
  };
  filter.take(odometry(0));
  const Pose2 told{-0.5, -1.5, 0.0};
  int cycle = 0;
  for (int turn = 0; turn < 5; ++turn) {
    for (int i = 0; i < 40; ++i) filter.take(odometry(++cycle));
    filter.order({OrderKind::kPlace, told, 0.01, 0.01});
    const Timestamp now = odometry(cycle)[0].stamp;
    std::optional<std::pair<Timestamp, Pose2>> pose;
    ASSERT_TRUE(comesTrue("the place is published",
                          [&] {
                            if (const auto newer = published(filter)) pose = newer;
                            return pose && pose->first == now &&
                                   distance(pose->second, told) < 0.05;
                          }))
        << (pose ? distance(pose->second, told) : -1.0) << " m beside it";
  }
}

TEST(LearnedTables, AreLearnedOnceAndWhoWaitsForThemMayGiveUp) {
  const LocalizedArena arena;
  const TableGiver tables = arena.config().tables;
  const auto robot = openRobot(arena.robotFile);
  std::latch begun{1};
  std::latch let{1};
  std::shared_ptr<const RobotTables> learned;
  std::jthread first([&, isFirst = true](const std::stop_token&) mutable {
    learned = tables(*openRobot(arena.robotFile), [&](double) {
      if (std::exchange(isFirst, false)) {
        begun.count_down();
        let.wait();
      }
      return true;
    });
  });
  begun.wait();
  EXPECT_EQ(tables(*robot, [](double) { return false; }), nullptr) << "it waits for the first";
  let.count_down();
  first.join();
  ASSERT_NE(learned, nullptr);
  EXPECT_EQ(tables(*robot, [](double) { return false; }), learned) << "there already";
  EXPECT_EQ(arena.config().tables(*robot, [](double) { return false; }), nullptr)
      << "a new one gives up at its first step";
}

TEST(GivenTables, MustBeOfTheSameWorld) {
  const LocalizedArena arena;
  const auto robot = openRobot(arena.robotFile);
  TableInfo info{"elsewhere", "fedcba", "scout", kTurn / 180, {}, {}};
  info.region.grid = {0, 0, 0.1, 2, 2};
  info.region.open = info.region.standable = {1, 1, 1, 1};
  writeTables(arena.folder / "other.tables", robot->container, info);
  EXPECT_NE(messageOf<std::invalid_argument>([&] {
              givenTables(arena.folder / "other.tables", "abcdef");
            }).find("was learned in the world fedcba ('elsewhere'), this one is abcdef"),
            std::string::npos);
  EXPECT_THROW(givenTables(arena.folder / "none.tables", ""), TableError);
}

}  // namespace
}  // namespace ortung::test
