// HEATMAP and WHY of records: what a robot perceives depends on the moment that is looked at alone.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <future>
#include <span>
#include <thread>

#include "FakeRobots.hpp"
#include "Files.hpp"
#include "LocalizedArena.hpp"
#include "Paths.hpp"
#include "StandingPioneer.hpp"
#include "TestClient.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/mcl_served/HeatMap.hpp"
#include "ortung/mcl_served/LocalizationCommands.hpp"
#include "ortung/mcl_served/PerceivedPlayback.hpp"
#include "ortung/mcl_served/WorldTables.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/server/ServedPlayback.hpp"

namespace ortung::test {
namespace {

const Pose2 kFirst{1.53, -0.72, 0.6};
const Pose2 kSecond{-4.21, 2.64, -2.1};
constexpr Timestamp kSecondBegins = 2'000'000;  // [us]

/// Writes what a Pioneer without noise senses where it stands for a second, with stamps from
/// @p begin on.
void standAt(const Pose2& pose, Timestamp begin, RecordWriter& record) {
  test::standAt(pose, 100, [&](const std::span<Message> readings) {
    for (Message& message : readings) {
      message.stamp += begin;
      record.write(message);
    }
    record.endMoment();
  });
}

/// It stands at one place from 0 to 1 s, at another from 2 to 3 s; a single reading comes at 8 s.
struct Recorded {
  TemporaryFolder folder;
  Recorded() {
    RecordWriter record(folder / "run.rec", "");
    standAt(kFirst, 0, record);
    standAt(kSecond, kSecondBegins, record);
    record.write({8'000'000, {"odometry", "odometry", "pose"}, OdometryData::encode({})});
    record.endMoment();
    record.commit();
  }
  ServedPlayback::Config config() const {
    return {.name = "run", .runs = {{folder / "run.rec", "run"}}};
  }
};

/// The middle of the brightest cells of a reply.
Pose2 brightestOf(const BoardCommand::Reply& reply) {
  const auto number = [&](const char* key) { return std::stod(valueOf(reply.words, key)); };
  const FieldGrid grid{number("x_min_m"), number("y_min_m"), number("step_m"),
                       static_cast<int>(number("columns")), static_cast<int>(number("rows"))};
  int most = 0;
  std::size_t best = 0;
  for (std::size_t i = 0; i < reply.bytes.size(); ++i)
    if (const int level = static_cast<unsigned char>(reply.bytes[i]); level > most) {
      most = level;
      best = i;
    }
  return {grid.centreX(best), grid.centreY(best), 0.0};
}

double wayTo(const Pose2& a, const Pose2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The commands of a board that shows the record.
class Asked {
 public:
  explicit Asked(PerceivedPlayback& world) : commands_(perceptionCommands(world)) {}
  BoardCommand::Reply ask(const std::string& name, std::map<std::string, std::string> keys = {}) {
    BoardCommand::Call call;
    call.keys = std::move(keys);
    call.keys["robot"] = "1";
    for (const BoardCommand& command : commands_)
      if (command.name == name) return command.handle(call);
    throw std::logic_error("no command " + name);
  }
  std::string refusal() {
    try {
      ask("HEATMAP");
    } catch (const ServeError& error) {
      return error.code() + " " + error.what();
    }
    return "";
  }

 private:
  std::vector<BoardCommand> commands_;
};

bool learnAll(PerceivedPlayback& world) {
  return world.fetchTables([](double) { return true; });
}

TEST(PerceivedPlayback, OffersMapsAndReasonsButNoLocalization) {
  Recorded recorded;
  ServedPlayback playback(recorded.config());
  PerceivedPlayback world(playback, {kPioneer, learnedTables(kF2000)});
  std::vector<std::string> names;
  for (const BoardCommand& command : perceptionCommands(world)) names.push_back(command.name);
  EXPECT_EQ(names, (std::vector<std::string>{"HEATMAP", "WHY"}));
}

TEST(PerceivedPlayback, HasTheMapOfTheMomentWhetherItWasPlayedOrJumpedTo) {
  Recorded recorded;
  ServedPlayback playback(recorded.config());
  PerceivedPlayback world(playback, {kPioneer, learnedTables(kF2000)});
  ASSERT_TRUE(learnAll(world));
  Asked client(world);
  world.seek(900'000);
  const BoardCommand::Reply first = client.ask("HEATMAP");
  EXPECT_LT(wayTo(brightestOf(first), kFirst), 0.15);
  while (world.now() < 2'900'000) world.step();
  const BoardCommand::Reply second = client.ask("HEATMAP");
  EXPECT_LT(wayTo(brightestOf(second), kSecond), 0.15);
  EXPECT_GE(std::stoll(valueOf(second.words, "stamp")), kSecondBegins);
  world.seek(900'000);
  const BoardCommand::Reply again = client.ask("HEATMAP");
  EXPECT_EQ(again.words, first.words);
  EXPECT_EQ(again.bytes, first.bytes) << "nothing is left of a later moment";
  // A step plays up to its time, a jump includes it.
  world.seek(world.now() + 1'999'999);
  EXPECT_EQ(client.ask("HEATMAP").bytes, second.bytes);
}

TEST(PerceivedPlayback, TellsWhyWithWhatWasMeasuredThen) {
  Recorded recorded;
  ServedPlayback playback(recorded.config());
  PerceivedPlayback world(playback, {kPioneer, learnedTables(kF2000)});
  ASSERT_TRUE(learnAll(world));
  Asked client(world);
  world.seek(kSecondBegins + 900'000);
  const auto why = [&](const Pose2& pose) {
    return client.ask("WHY", {{"x_m", std::to_string(pose.x)},
                              {"y_m", std::to_string(pose.y)},
                              {"theta_rad", std::to_string(pose.theta)}});
  };
  const double there = std::stod(valueOf(why(kSecond).words, "p"));
  const double elsewhere = std::stod(valueOf(why(kFirst).words, "p"));
  EXPECT_GT(there, 1e3 * elsewhere);
  // Without noise a beam measures what is expected, but for the grid of the tables.
  std::size_t near = 0;
  std::size_t beams = 0;
  for (const std::string& line : why(kSecond).lines) {
    if (line.find("value LMS200/LRF/") != 0 || line.find("measured=") == line.npos) continue;
    const std::string measured = valueOf(line, "measured");
    const std::string expected = valueOf(line, "expected");
    if (measured == "inf" || expected == "inf" || expected.empty()) continue;
    ++beams;
    if (std::abs(std::stod(measured) - std::stod(expected)) < 0.3) ++near;
  }
  EXPECT_GT(beams, 100U);
  EXPECT_GT(near, beams * 8 / 10);
}

TEST(PerceivedPlayback, ForgetsReadingsThatAreOld) {
  Recorded recorded;
  ServedPlayback playback(recorded.config());
  PerceivedPlayback world(playback, {kPioneer, learnedTables(kF2000)});
  ASSERT_TRUE(learnAll(world));
  Asked client(world);
  world.seek(2'900'000);
  EXPECT_GT(std::stoi(valueOf(client.ask("HEATMAP").words, "readings")), 5);
  while (world.now() < 7'000'000) world.step();
  EXPECT_EQ(valueOf(client.ask("HEATMAP").words, "readings"), "0") << "all are from 3 s before";
}

TEST(PerceivedPlayback, LearnsTablesBesideItselfAndSaysHowFarItIs) {
  Recorded recorded;
  ServedPlayback playback(recorded.config());
  std::promise<void> isShared;
  std::promise<void> mayGoOn;
  const TableGiver real = learnedTables(kF2000);
  PerceivedPlayback world(playback, {kPioneer, [&](const Robot& robot, const auto& goOn) {
                                       goOn(0.4);
                                       isShared.set_value();
                                       mayGoOn.get_future().wait();
                                       return real(robot, [](double) { return true; });
                                     }});
  Asked client(world);
  EXPECT_EQ(client.refusal().find("state tables are being learned"), 0U);
  isShared.get_future().wait();
  EXPECT_EQ(client.refusal(), "state tables are being learned, 40 % are done");
  mayGoOn.set_value();
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (!client.refusal().empty() && std::chrono::steady_clock::now() < end)
    std::this_thread::yield();
  EXPECT_EQ(client.refusal(), "");
}

TEST(PerceivedPlayback, SaysWhyThereAreNoTables) {
  Recorded recorded;
  ServedPlayback playback(recorded.config());
  const TableGiver none =
      [](const Robot&, const std::function<bool(double)>&) -> std::shared_ptr<const RobotTables> {
    throw std::runtime_error("no room");
  };
  PerceivedPlayback world(playback, {kPioneer, none});
  EXPECT_THROW(learnAll(world), std::runtime_error);
  Asked client(world);
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (client.refusal().find("learned") != std::string::npos &&
         std::chrono::steady_clock::now() < end)
    std::this_thread::yield();
  EXPECT_EQ(client.refusal(), "state there are no tables: no room");
  EXPECT_THROW(world.perceiver(2), ServeError);
}

}  // namespace
}  // namespace ortung::test
