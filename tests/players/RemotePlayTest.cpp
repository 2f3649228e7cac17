// Players in the simulator and as clients of a server.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <limits>
#include <optional>
#include <thread>

#include "Await.hpp"
#include "Files.hpp"
#include "Paths.hpp"
#include "PlayedScene.hpp"
#include "RunningBoard.hpp"
#include "TestClient.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/mcl_player/SelfLocalization.hpp"
#include "ortung/remote/RemotePlay.hpp"
#include "ortung/robot/TableInfo.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/sim/Learner.hpp"
#include "ortung/sim/RobotShape.hpp"

namespace ortung::test {
namespace {

const std::string kWorld = ORTUNG_SOURCE_DIR "/maps/fields/arena.toml";
const std::string kRobot = ORTUNG_SOURCE_DIR "/maps/robots/pioneer.toml";
constexpr Pose2 kStart{0.5, -1.5, 0.7};

/// What a player has sensed when it was asked to act.
struct Seen {
  Timestamp now = 0;
  std::vector<float> ranges;
  Pose2 odometry;
  bool operator==(const Seen& other) const {
    return now == other.now && ranges == other.ranges && odometry.x == other.odometry.x &&
           odometry.y == other.odometry.y && odometry.theta == other.odometry.theta;
  }
};

/// Plays as another one does, and notes what that one gets to see.
class Noted : public Player {
 public:
  Noted(std::unique_ptr<Player> player, std::vector<Seen>& seen)
      : player_(std::move(player)), seen_(seen) {}
  std::filesystem::path robotFile() const override { return player_->robotFile(); }
  double period() const override { return player_->period(); }
  void begin(PlayerSeat& seat) override { player_->begin(seat); }
  bool senseAndAct(PlayerSeat& seat) override {
    Seen seen{seat.now(), {}, {}};
    if (const auto scan = seat.container().get<ScanData>({.type = "LRF"}))
      seen.ranges = scan->ranges;
    const auto odometry = seat.container().get<OdometryData>({.type = "odometry"});
    if (odometry) seen.odometry = odometry->pose;
    seen_.push_back(std::move(seen));
    return player_->senseAndAct(seat);
  }
  void end(PlayerSeat& seat) override { player_->end(seat); }

 private:
  std::unique_ptr<Player> player_;
  std::vector<Seen>& seen_;
};

PluginFactory& factory() {
  static PluginFactory plugins({ORTUNG_PLUGINS_DIR, TEST_EXAMPLES});
  return plugins;
}

std::unique_ptr<Player> shy(double seconds) {
  Parameters options("test");
  options.set("plays_s", seconds);
  return factory().make<Player>("shy", options);
}

RemotePlayConfig on(const RunningBoard& board, const std::string& plugin) {
  RemotePlayConfig config;
  config.session.port = board.port();
  config.session.start = kStart;
  config.plugin = plugin;
  config.robot = kRobot;
  config.isLockstep = true;
  return config;
}

TEST(RemotePlay, APlayerSeesAndDoesTheSameAsInTheSimulator) {
  constexpr double kPlays = 15.0;
  std::vector<Seen> inside;
  {
    Scene scene = Scene::open(kWorld);
    SceneRun run(scene, {.noise = false}, factory());
    RobotConfig robot = readRobot(kRobot);
    PlayerWish wish;
    wish.plugin = "shy";
    run.players().own(run.addRobot(robot, factory(), kStart, 0),
                      std::make_unique<Noted>(shy(kPlays), inside), wish, Random(1));
    playToTheEnd(run);
  }
  std::vector<Seen> outside;
  {
    ServedSimulation world(kWorld, {.noise = false});
    const RunningBoard board(world, lockstepConfig());
    RemotePlay play(std::make_unique<Noted>(shy(kPlays), outside), on(board, "shy"));
    play.run();
    EXPECT_EQ(play.now(), fromSeconds(kPlays));
  }
  ASSERT_EQ(inside.size(), 301u);  // every 50 ms
  EXPECT_EQ(inside, outside);
  // It has met a wall and turned away.
  EXPECT_NE(inside.back().odometry.theta, inside.front().odometry.theta);
  EXPECT_GT(std::abs(inside.back().odometry.x - inside.front().odometry.x), 0.1);
}

/// Drives a curve and notes where it believes to be.
class Localizer : public Player {
 public:
  explicit Localizer(std::vector<std::optional<PoseEstimate>>& poses) : poses_(poses) {}
  bool needsTables() const override { return true; }
  double period() const override { return 0.05; }
  void begin(PlayerSeat& seat) override {
    self_ = std::make_unique<SelfLocalization>(seat);
    self_->startNear(kStart, 0.2, 0.1, seat.random());
  }
  bool senseAndAct(PlayerSeat& seat) override {
    self_->update(seat);
    poses_.push_back(self_->estimate(seat.now()));
    seat.robot().setTranslationalVelocity(0.3);
    seat.robot().setRotationalVelocity(0.6);
    return poses_.size() < 60;
  }

 private:
  std::vector<std::optional<PoseEstimate>>& poses_;
  std::unique_ptr<SelfLocalization> self_;
};

/// Tables of the robot for the world.
void writeTablesOf(const std::filesystem::path& file) {
  const auto world = readWorld(kWorld);
  const RobotConfig robot = readRobot(kRobot);
  SensorContainer container;
  const auto devices = fillContainer(container, robot, factory());
  TableInfo info;
  info.region = learnArea(*world, 0.1, sizeOf(robot)).region;
  learn(*world, info.region, devices, factory(), {});
  info.worldFingerprint = world->fingerprint();
  info.headingStep = LearnOptions{}.headingStep;
  info.field = fieldModelOf(*world);
  writeTables(file, container, info);
}

TEST(RemotePlay, APlayerLocalizesItselfToTheSameBitsAsInTheSimulator) {
  const TemporaryFolder folder;
  const auto tables = folder / "arena.tables";
  writeTablesOf(tables);
  std::vector<std::optional<PoseEstimate>> inside;
  {
    SceneRun run(Scene::open(kWorld), {.noise = false}, factory());
    PlayerWish wish;
    wish.plugin = "localizer";
    wish.tables = tables;
    run.players().own(run.addRobot(readRobot(kRobot), factory(), kStart, 0),
                      std::make_unique<Localizer>(inside), wish, Random(1, 1));
    playToTheEnd(run);
  }
  std::vector<std::optional<PoseEstimate>> outside;
  ServedSimulation world(kWorld, {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  RemotePlayConfig config = on(board, "localizer");
  const auto play = [&] { RemotePlay(std::make_unique<Localizer>(outside), config).run(); };
  EXPECT_THROW(play(), std::invalid_argument) << "it has no tables";
  config.tables = tables;
  play();
  ASSERT_EQ(inside.size(), 60u);
  ASSERT_EQ(outside.size(), inside.size());
  for (std::size_t i = 0; i < inside.size(); ++i) {
    ASSERT_EQ(inside[i].has_value(), outside[i].has_value()) << i;
    if (!inside[i]) continue;
    EXPECT_EQ(inside[i]->pose.x, outside[i]->pose.x) << i;
    EXPECT_EQ(inside[i]->pose.theta, outside[i]->pose.theta) << i;
    EXPECT_EQ(inside[i]->covariance, outside[i]->covariance) << i;
  }
  EXPECT_GT(inside.back()->quality, 0.9);
}

/// Does as it is told when it acts for the third time.
class Odd : public Player {
 public:
  explicit Odd(std::function<void(PlayerSeat&)> act) : act_(std::move(act)) {}
  bool senseAndAct(PlayerSeat& seat) override {
    if (++count_ == 3) act_(seat);
    return true;
  }

 private:
  std::function<void(PlayerSeat&)> act_;
  int count_ = 0;
};

/// Why it was stopped; its robot is gone afterwards.
std::string whyStopped(const std::function<void(PlayerSeat&)>& act, double budget = 1.0) {
  ServedSimulation world(kWorld, {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  std::string why;
  {
    RemotePlayConfig config = on(board, "odd");
    config.budget = budget;
    RemotePlay play(std::make_unique<Odd>(act), config);
    try {
      play.run();
    } catch (const PlayerStopped& stopped) {
      why = stopped.what();
    }
  }
  EXPECT_TRUE(comesTrue("its robot is gone", [&] { return board.statistics().robots == 0; }));
  return why;
}

TEST(RemotePlay, WhoDoesWrongIsStoppedByName) {
  const std::string who = "the player 'odd' of robot robot failed in senseAndAct: ";
  const std::string thrown =
      whyStopped([](PlayerSeat&) { throw std::runtime_error("no idea what to do"); });
  EXPECT_NE(thrown.find(who), std::string::npos) << thrown;
  EXPECT_NE(thrown.find("no idea what to do"), std::string::npos) << thrown;
  const std::string nan = whyStopped([](PlayerSeat& seat) {
    seat.robot().setTranslationalVelocity(std::numeric_limits<double>::quiet_NaN());
  });
  EXPECT_NE(nan.find(who), std::string::npos) << nan;
  EXPECT_NE(nan.find("commands a translational velocity of"), std::string::npos) << nan;
  const std::string refused =
      whyStopped([](PlayerSeat& seat) { seat.robot().setManipulator("wing", "up"); });
  EXPECT_NE(refused.find(who), std::string::npos) << refused;
  EXPECT_NE(refused.find("no manipulator 'wing'"), std::string::npos) << refused;
  const std::string text = whyStopped([](PlayerSeat& seat) { seat.say("two\nlines"); });
  EXPECT_NE(text.find("printable"), std::string::npos) << text;
  const std::string slow = whyStopped(
      [](PlayerSeat&) {
        const std::clock_t begin = std::clock();
        while (std::clock() - begin < CLOCKS_PER_SEC / 20) {
        }
      },
      0.03);
  EXPECT_NE(slow.find("s of processor time, expected at most 0.03"), std::string::npos) << slow;
}

TEST(RemotePlay, AServerThatIsGoneIsNotThePlayersFault) {
  ServedSimulation world(kWorld, {.noise = false});
  std::optional<RunningBoard> board;
  board.emplace(world, lockstepConfig());
  RemotePlay play(std::make_unique<Odd>([&](PlayerSeat& seat) {
                    board.reset();
                    seat.robot().setTranslationalVelocity(0.1);
                  }),
                  on(*board, "odd"));
  EXPECT_THROW(play.run(), ConnectionLost);
}

TEST(RemotePlay, KnowsItsRobot) {
  ServedSimulation world(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml", {.noise = false});
  const RunningBoard board(world, lockstepConfig());
  RemotePlayConfig config = on(board, "odd");
  config.robot = ORTUNG_SOURCE_DIR "/maps/robots/msl_omni.toml";
  config.session.name = "striker";
  config.session.start = Pose2{1.0, 0.0, 0.0};
  config.team = "blue";
  RobotAbilities able;
  RemotePlay play(std::make_unique<Odd>([&](PlayerSeat& seat) {
                    able = seat.abilities();
                    EXPECT_EQ(seat.name(), "striker");
                    EXPECT_EQ(seat.team(), "blue");
                    EXPECT_EQ(seat.stage(), nullptr);
                    EXPECT_EQ(seat.game().phase, Game::Phase::kFree);
                    EXPECT_THROW(seat.robot().setMotion(std::vector<double>{0.0, NAN, 0.0}),
                                 std::invalid_argument);
                    throw std::runtime_error("enough");
                  }),
                  config);
  EXPECT_THROW(play.run(), PlayerStopped);
  Simulation::Config bare;
  Scene scene = Scene::open(ORTUNG_SOURCE_DIR "/maps/fields/msl.toml");
  SceneRun run(scene, bare, factory());
  const SimRobot& robot = run.addRobot(readRobot(config.robot), factory(), config.session.start, 0);
  const DriveLimits limits = robot.drive().limits();
  EXPECT_GT(limits.speed, 0.0);
  EXPECT_EQ(able.limits.speed, limits.speed);
  EXPECT_EQ(able.limits.turn, limits.turn);
  EXPECT_EQ(able.limits.acceleration, limits.acceleration);
  EXPECT_EQ(able.limits.turnAcceleration, limits.turnAcceleration);
  EXPECT_EQ(able.radius, robot.config().radius);
  EXPECT_EQ(able.motionHelp, robot.drive().commandHelp());
  ASSERT_EQ(able.manipulators.size(), robot.shape().manipulators.size());
  EXPECT_EQ(able.manipulators[0].name, robot.shape().manipulators[0].name);
  EXPECT_EQ(able.manipulators[0].states.size(), robot.shape().manipulators[0].states.size());
}

}  // namespace
}  // namespace ortung::test
