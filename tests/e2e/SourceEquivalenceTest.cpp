// The project's promise: it makes no difference what fills the container. The same run gives the
// same words and the same estimates, bit for bit, in process, over the network, and from its
// record.
#include <gtest/gtest.h>

#include <bit>

#include "../server/RunningBoard.hpp"
#include "Files.hpp"
#include "Learn.hpp"
#include "Paths.hpp"
#include "ortung/client/RemoteRobot.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/ServedRecord.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/arena.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";

/// Everything a run gives: readings and estimates.
struct Outcome {
  std::string readings;                  ///< lines of a record
  std::vector<std::uint64_t> estimates;  ///< bits of all numbers
};

class SourceEquivalence : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    app::LearnArguments learn;
    learn.world = kWorld;
    learn.robot = kRobot;
    learn.out = tables();
    learn.cell = 0.1;
    learn.headingStepDeg = 5.0;
    app::runLearn(learn);
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::filesystem::path tables() { return *folder_ / "arena.ortung"; }

  /// Localizes on a source, and writes what it gave into @p record if that has a name.
  static Outcome localize(const std::string& source, const std::filesystem::path& record = {}) {
    Localization localization({.robot = kRobot, .tables = tables(), .source = source});
    const std::filesystem::path file = record.empty() ? *folder_ / "passing.rec" : record;
    RecordWriter writer(file, localization.source().worldFingerprint());
    localization.feeder().recordInto(writer);
    Outcome run;
    while (const auto estimate = localization.next()) {
      const PoseEstimate& e = *estimate;
      for (const double number : {e.pose.x, e.pose.y, e.pose.theta, e.share})
        run.estimates.push_back(std::bit_cast<std::uint64_t>(number));
      for (const double number : e.covariance)
        run.estimates.push_back(std::bit_cast<std::uint64_t>(number));
      run.estimates.push_back(e.samples);
    }
    writer.commit();
    run.readings = readBytes(file);
    return run;
  }

  static void expectSame(const Outcome& a, const Outcome& b) {
    EXPECT_GT(a.estimates.size(), 14u * 20u);
    EXPECT_EQ(a.readings, b.readings);
    EXPECT_EQ(a.estimates, b.estimates);
  }

  static std::string address(const RunningBoard& board) {
    return "127.0.0.1:" + std::to_string(board.port());
  }

  static TemporaryFolder* folder_;
};

TemporaryFolder* SourceEquivalence::folder_ = nullptr;

BoardConfig lockstep() {
  BoardConfig config;
  config.pace = Pace::kLockstep;
  return config;
}

TEST_F(SourceEquivalence, SimulatorNetworkRecordAndServedRecordAreTheSame) {
  const std::filesystem::path record = *folder_ / "run.rec";
  const Outcome live = localize("sim:" + kWorld + "?seed=7&duration=6");

  Outcome remote;
  {
    ServedSimulation world(kWorld, {.seed = 7});
    const RunningBoard board(world, lockstep());
    remote = localize("tcp:" + address(board) + "?duration=6&drive=wander", record);
  }
  expectSame(live, remote);

  const Outcome replayed = localize("record:" + record.string());
  expectSame(remote, replayed);

  ServedRecord world(record);
  const RunningBoard board(world, lockstep());
  expectSame(replayed, localize("tcp:" + address(board)));
}

TEST_F(SourceEquivalence, ARemotePlayerIsAsReproducibleAsOneInProcess) {
  constexpr int kCycles = 300;
  const Pose2 start{0.3, -0.4, 0.5};
  const auto speedAt = [](int cycle) { return cycle < 150 ? 0.4 : 0.1; };
  const auto turnAt = [](int cycle) { return 0.3 + 0.001 * cycle; };

  std::string live;
  {
    PluginFactory factory(PluginFactory::standardFolders());
    Simulation simulation(readWorld(kWorld), {.seed = 3});
    SimRobot& robot = simulation.addRobot(readRobot(kRobot), factory, start);
    for (int cycle = 0; cycle < kCycles; ++cycle) {
      robot.drive().setTranslationalVelocity(speedAt(cycle));
      robot.drive().setRotationalVelocity(turnAt(cycle));
      if (cycle > 0) simulation.move();  // by what it is told once it has sensed
      simulation.sense();
      for (const Message& reading : simulation.readings(0)) {
        writeLine(reading, live);
        live += '\n';
      }
    }
  }

  std::string remote;
  ServedSimulation world(kWorld, {.seed = 3});
  const RunningBoard board(world, lockstep());
  SessionOptions options;
  options.port = board.port();
  options.start = start;
  RobotSession session(options, readBytes(kRobot));
  session.setLockstep(true);
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    session.setTranslationalVelocity(speedAt(cycle));
    session.setRotationalVelocity(turnAt(cycle));
    const auto readings = session.next();
    ASSERT_TRUE(readings.has_value());
    for (const Message& reading : *readings) {
      writeLine(reading, remote);
      remote += '\n';
    }
  }
  EXPECT_GT(live.size(), 10'000u);
  EXPECT_EQ(live, remote);
}

TEST_F(SourceEquivalence, TwoLockstepClientsAndAResetChangeNothing) {
  ServedSimulation world(kWorld, {.seed = 11});
  BoardConfig config = lockstep();
  config.control = {"*"};
  const RunningBoard board(world, config);
  SessionOptions options;
  options.port = board.port();
  options.start = Pose2{-0.5, 0.3, 0.0};
  RobotSession first(options, readBytes(kRobot));
  options.start = Pose2{0.6, 0.3, 3.0};
  RobotSession second(options, readBytes(kRobot));
  const auto play = [&] {
    first.setLockstep(true);
    second.setLockstep(true);
    std::string words;
    for (int cycle = 0; cycle < 100; ++cycle) {
      first.setTranslationalVelocity(0.2);
      second.setRotationalVelocity(0.5);
      std::optional<std::vector<Message>> others;
      std::thread other([&] { others = second.next(); });  // waits for both
      const auto own = first.next();
      other.join();
      for (const auto* readings : {&own, static_cast<const decltype(own)*>(&others)})
        for (const Message& reading : **readings) {
          writeLine(reading, words);
          words += '\n';
        }
    }
    first.setLockstep(false);
    second.setLockstep(false);
    return words;
  };
  const std::string once = play();
  first.ask("RESET");
  EXPECT_GT(once.size(), 10'000u);
  EXPECT_EQ(play(), once);
}

}  // namespace
}  // namespace ortung::test
