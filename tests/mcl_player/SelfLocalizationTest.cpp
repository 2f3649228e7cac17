#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "Files.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/mcl_player/SelfLocalization.hpp"
#include "ortung/robot/RobotTables.hpp"
#include "ortung/sim/Learner.hpp"
#include "ortung/sim/PlayerControl.hpp"
#include "ortung/sim/RobotShape.hpp"
#include "ortung/sim/Simulation.hpp"
#include "ortung/sim/TableStore.hpp"

namespace ortung {
namespace {

const std::filesystem::path kWorld = shippedFile("fields", "f2000.toml");

/// Learned once for all tests.
std::shared_ptr<TableStore> store() {
  static const auto kStore = std::make_shared<TableStore>(kWorld);
  return kStore;
}

struct Moment {
  Pose2 truth;
  std::optional<PoseEstimate> estimate;
  bool operator==(const Moment& other) const {
    const auto bits = [](const Moment& m) {
      return m.estimate ? std::array{m.estimate->pose.x, m.estimate->pose.y, m.estimate->pose.theta,
                                     m.estimate->covariance[0], m.estimate->quality}
                        : std::array<double, 5>{};
    };
    return estimate.has_value() == other.estimate.has_value() && bits(*this) == bits(other);
  }
};

/// Drives in a bow, and wants to know where it is.
class Seeker : public Player {
 public:
  using Begin = std::function<void(PlayerSeat&, SelfLocalization&)>;
  using Make = std::function<std::unique_ptr<SelfLocalization>(PlayerSeat&)>;
  Seeker(std::vector<Moment>& moments, Begin begin, Make make)
      : moments_(moments), begin_(std::move(begin)), make_(std::move(make)) {}

  bool needsTables() const override { return true; }
  void begin(PlayerSeat& seat) override {
    self_ = make_(seat);
    if (begin_) begin_(seat, *self_);
  }
  bool senseAndAct(PlayerSeat& seat) override {
    self_->update(seat);
    const Pose2 truth = seat.stage()->robots().front().pose;
    moments_.push_back({truth, self_->estimate(seat.now())});
    const double t = toSeconds(seat.now());
    seat.robot().setTranslationalVelocity(0.5 + 0.3 * std::sin(2.0 * t));
    seat.robot().setRotationalVelocity(0.35 + 0.5 * std::sin(1.3 * t));
    return true;
  }

 private:
  std::vector<Moment>& moments_;
  Begin begin_;
  Make make_;
  std::unique_ptr<SelfLocalization> self_;
};

std::unique_ptr<SelfLocalization> makeAnywhere(PlayerSeat& seat) {
  return std::make_unique<SelfLocalization>(seat);
}

struct Game1 {
  explicit Game1(std::uint64_t seed, std::shared_ptr<TableStore> tables = store())
      : factory(PluginFactory::standardFolders()),
        simulation(readWorld(kWorld), {.seed = seed}),
        plans(simulation.world()),
        players(simulation, plans, factory,
                {.budget = 0.0,
                 .onProblem = [this](const std::string& what) { problem = what; },
                 .tables = std::move(tables)}) {}

  void enter(const Seeker::Begin& begin, const PlayerWish& wish = PlayerWish(),
             const std::string& robot = "pioneer_lrf.toml",
             const Seeker::Make& make = makeAnywhere) {
    SimRobot& added = simulation.addRobot(readRobot(shippedFile("robots", robot)), factory, kStart);
    players.own(added, std::make_unique<Seeker>(moments, begin, make), wish, Random(5, 1));
  }
  void run(double seconds) {
    while (toSeconds(simulation.now()) < seconds && problem.empty()) {
      simulation.sense();
      players.act(Game{});
      simulation.move();
    }
  }

  static constexpr Pose2 kStart{-3.0, -1.0, 0.4};
  PluginFactory factory;
  Simulation simulation;
  FloorPlans plans;
  std::string problem;
  PlayerControl players;
  std::vector<Moment> moments;
};

double medianError(const std::vector<Moment>& moments, std::size_t from) {
  std::vector<double> errors;
  for (std::size_t i = from; i < moments.size(); ++i)
    errors.push_back(distance(moments[i].truth, moments[i].estimate.value().pose));
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                   errors.end());
  return errors[errors.size() / 2];
}

TEST(SelfLocalization, MayBeginNearAtOnce) {
  Game1 later(3);
  later.enter([](PlayerSeat& seat, SelfLocalization& self) {
    self.startNear(Game1::kStart, 0.2, 0.1, seat.random());
  });
  later.run(1.0);
  Game1 atOnce(3);
  atOnce.enter({}, PlayerWish(), "pioneer_lrf.toml", [](PlayerSeat& seat) {
    return std::make_unique<SelfLocalization>(seat, Game1::kStart, 0.2, 0.1);
  });
  atOnce.run(1.0);
  ASSERT_EQ(atOnce.moments.size(), 100u);
  EXPECT_EQ(atOnce.moments, later.moments);
}

// Centimetres, by a scanner with noise of 2 cm.
TEST(SelfLocalization, TellsWhereItsRobotIs) {
  Game1 game(3);
  game.enter([](PlayerSeat& seat, SelfLocalization& self) {
    self.startNear(Game1::kStart, 0.2, 0.1, seat.random());
  });
  game.run(12.0);
  EXPECT_EQ(game.problem, "");
  ASSERT_EQ(game.moments.size(), 1200u);
  ASSERT_TRUE(game.moments.front().estimate.has_value());
  EXPECT_LT(medianError(game.moments, 300), 0.05);
  for (std::size_t i = 300; i < game.moments.size(); ++i) {
    ASSERT_LT(distance(game.moments[i].truth, game.moments[i].estimate->pose), 0.25) << i;
    ASSERT_GT(game.moments[i].estimate->quality, 0.95) << i;
  }
  // It has seen by then that no stamps are late.
  EXPECT_EQ(game.moments.back().estimate->status, TrackStatus::kTracking);
}

// A rectangular field looks the same after half a turn: by the scanner alone it is one of two.
TEST(SelfLocalization, FindsItselfAnywhere) {
  Game1 game(4);
  game.enter({});
  game.run(4.0);
  EXPECT_EQ(game.problem, "");
  const Moment last = game.moments.back();
  ASSERT_TRUE(last.estimate.has_value());
  const Pose2 mirrored{-last.truth.x, -last.truth.y, last.truth.theta};
  EXPECT_LT(
      std::min(distance(last.truth, last.estimate->pose), distance(mirrored, last.estimate->pose)),
      0.2);
}

TEST(SelfLocalization, OfTheSameSeedHasTheSameBits) {
  const auto run = [](std::uint64_t seed) {
    Game1 game(seed);
    game.enter([](PlayerSeat&, SelfLocalization& self) { self.startAt(Game1::kStart, 0.2, 0.1); });
    game.run(2.0);
    return game.moments;
  };
  const auto first = run(7);
  EXPECT_EQ(first, run(7));
  EXPECT_NE(first, run(8));
}

// Odometry alone would carry the old place on.
TEST(SelfLocalization, IsToldWhereItWasCarried) {
  Game1 game(3);
  SelfLocalization* self = nullptr;
  game.enter([&](PlayerSeat&, SelfLocalization& its) {
    its.startAt(Game1::kStart, 0.1, 0.05);
    self = &its;
  });
  game.run(1.0);
  const Pose2 there{2.0, 1.5, -2.0};
  game.simulation.place(*game.simulation.robots()[0], there);
  self->setPose(there, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01});
  game.run(1.5);
  EXPECT_LT(distance(game.moments.back().truth, game.moments.back().estimate->pose), 0.15);
}

/// Writes what a robot learns of a small room.
void writeTablesOfAnotherWorld(const std::filesystem::path& file) {
  PluginFactory factory(PluginFactory::standardFolders());
  const auto world = readWorld(shippedFile("fields", "arena.toml"));
  const RobotConfig robot = readRobot(shippedFile("robots", "pioneer_lrf.toml"));
  SensorContainer container;
  const auto devices = fillContainer(container, robot, factory);
  const LearnArea area = learnArea(*world, 0.5, sizeOf(robot));
  learn(*world, area.region, devices, factory, {.cell = 0.5});
  TableInfo info;
  info.worldFingerprint = world->fingerprint();
  info.world = "arena";
  info.region = area.region;
  info.headingStep = LearnOptions{}.headingStep;
  writeTables(file, container, info);
}

std::string refusalOf(std::shared_ptr<TableStore> tables, const PlayerWish& wish) {
  Game1 game(3, std::move(tables));
  return test::messageOf<std::invalid_argument>([&] { game.enter({}, wish); });
}

TEST(SelfLocalization, WhoHasNoTablesOfThisWorldIsRefused) {
  PlayerWish wish;
  wish.plugin = "seeker";
  EXPECT_EQ(refusalOf(nullptr, wish),
            "robot pioneer_lrf: the player 'seeker' needs tables of its robot for this world "
            "(tables=FILE)");
  const test::TemporaryFolder folder;
  wish.tables = folder / "arena.tables";
  writeTablesOfAnotherWorld(wish.tables);
  EXPECT_NE(refusalOf(store(), wish).find("arena.tables was learned in the world"),
            std::string::npos);
}

TEST(SelfLocalization, SaysWhatARobotLacks) {
  Game1 game(3);
  game.enter({}, PlayerWish(), "goalkeeper.toml");  // which has a camera for balls alone
  EXPECT_NE(game.problem.find("it has no feature that localizes"), std::string::npos)
      << game.problem;
}

TEST(TableStore, LearnsOnceForRobotsThatSenseAlike) {
  Game1 game(1);
  const auto add = [&](const std::string& file, const std::string& name, double x) -> SimRobot& {
    RobotConfig robot = readRobot(shippedFile("robots", file));
    robot.name = name;
    return game.simulation.addRobot(robot, game.factory, {x, 2.0, 0.0});
  };
  const auto first = store()->of(add("pioneer_lrf.toml", "a", -2.0), game.factory);
  EXPECT_EQ(store()->of(add("pioneer_lrf.toml", "b", 0.0), game.factory), first);
  EXPECT_NE(store()->of(add("pioneer_posts.toml", "c", 2.0), game.factory), first);
  EXPECT_EQ(first->info().worldFingerprint, game.simulation.world().fingerprint());
}

// Who is asked whether to go on may say no at any time; nothing that is half learned is kept.
TEST(TableStore, GivesNothingWhenItIsStopped) {
  Game1 game(1);
  RobotConfig robot = readRobot(shippedFile("robots", "pioneer_lrf.toml"));
  const SimRobot& sim = game.simulation.addRobot(robot, game.factory, {-2.0, 2.0, 0.0});
  TableStore tables(kWorld);
  for (const int most : {0, 3, 3}) {
    std::vector<double> shares;
    const auto learned = tables.of(robot, sim.container(), game.factory, [&](double share) {
      shares.push_back(share);
      return static_cast<int>(shares.size()) <= most;
    });
    EXPECT_EQ(learned, nullptr);
    ASSERT_EQ(shares.size(), static_cast<std::size_t>(most) + 1U) << "it begins anew each time";
    for (std::size_t i = 0; i < shares.size(); ++i) {
      EXPECT_GT(shares[i], i == 0 ? 0.0 : shares[i - 1]);
      EXPECT_LT(shares[i], 1.0);
    }
  }
}

}  // namespace
}  // namespace ortung
