// Each key of [mcl] does what docs/mcl.md says of it. (Rates of injection: RecoveryTest.)
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "FakeRun.hpp"
#include "MovingRobot.hpp"
#include "Told.hpp"
#include "ortung/mcl/Mcl.hpp"

namespace ortung {
namespace {

using test::FakeRun;
using test::kPi;
using test::MovingRobot;
using test::Told;

/// A robot of which the readings say what the test wants.
struct ToldRobot {
  explicit ToldRobot(Told::Answer answer, PoseResolution resolution = {}) {
    container.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "pose"}));
    add("x", std::move(answer), resolution);
  }
  void add(const char* name, Told::Answer answer, PoseResolution resolution) {
    container.add(std::make_unique<Told>(name, std::move(answer), resolution));
  }
  void odometry(double seconds, const Pose2& pose) {
    OdometryData::Reading reading;
    reading.pose = pose;
    container.set(
        {fromSeconds(seconds), {"base", "odometry", "pose"}, OdometryData::encode(reading)});
  }
  void reading(double seconds, const char* name = "x") {
    container.set({fromSeconds(seconds), {"told", "test", name}, {1}});
  }
  std::unique_ptr<Mcl> mcl(const MclConfig& config) const {
    return std::make_unique<Mcl>(config, test::Room{}.region(0.5, 0.2),
                                 std::make_unique<OdometryMotion>(OdometryNoise{0, 0, 0, 0, 0, 0}));
  }
  SensorContainer container;
};

MclConfig ofSize(std::size_t samples) {
  MclConfig config;
  config.maxSamples = config.minSamples = samples;
  return config;
}

// Half of the samples have all the weight: the effective share is one half.
TEST(MclSettings, ResampleBelowSaysAtWhichEffectiveShare) {
  const auto leftHalf = [](const SampleView& poses, std::size_t i) {
    return poses.x[i] < 0.0F ? 0.0F : -50.0F;
  };
  const auto weightsDiffer = [&](double resampleBelow) {
    ToldRobot robot(leftHalf);
    MclConfig config = ofSize(2000);
    config.resampleBelow = resampleBelow;
    config.recoverSlow = 0.0;
    const auto mcl = robot.mcl(config);
    mcl->startAt({0, 0, 0}, 0.5, 0.1);
    robot.reading(1.0);
    EXPECT_TRUE(mcl->update(robot.container));
    const auto& weights = mcl->samples().logWeight;
    const auto right = std::count_if(mcl->samples().x.begin(), mcl->samples().x.end(),
                                     [](float x) { return x >= 0.0F; });
    const bool differ = *std::min_element(weights.begin(), weights.end()) < -40.0F;
    EXPECT_EQ(differ, right > 500) << "those without weight are gone, or they keep it";
    return differ;
  };
  EXPECT_TRUE(weightsDiffer(0.0)) << "never";
  EXPECT_TRUE(weightsDiffer(0.4));
  EXPECT_FALSE(weightsDiffer(0.6));
  EXPECT_FALSE(weightsDiffer(1.0));
}

TEST(MclSettings, WeightsMultiplyUntilTheyAreResampled) {
  const auto slope = [](const SampleView& poses, std::size_t i) { return -poses.x[i]; };
  ToldRobot robot(slope);
  MclConfig config = ofSize(500);
  config.resampleBelow = 0.0;
  const auto mcl = robot.mcl(config);
  mcl->startAt({0, 0, 0}, 0.5, 0.1);
  for (int k = 1; k <= 400; ++k) {
    robot.odometry(k, {});  // it stands
    robot.reading(k);
    ASSERT_TRUE(mcl->update(robot.container));
  }
  const SampleSet& set = mcl->samples();
  const auto best =
      static_cast<std::size_t>(std::min_element(set.x.begin(), set.x.end()) - set.x.begin());
  EXPECT_EQ(set.logWeight[best], 0.0F) << "kept small: the best is 1";
  for (std::size_t i = 0; i < set.size(); i += 50)
    EXPECT_NEAR(set.logWeight[i], -400 * (set.x[i] - set.x[best]), 0.05);
}

// Two hundred places, then one: as many samples as Fox's formula asks for, within the bounds.
TEST(MclSettings, SizeOfTheSetFollowsItsSpreadAndTheSettings) {
  const auto sizeOf = [](double spread, const std::function<void(MclConfig&)>& change) {
    ToldRobot robot([](const SampleView&, std::size_t i) { return i % 2 == 0 ? 0.0F : -50.0F; });
    MclConfig config;
    config.maxSamples = 20000;
    config.minSamples = 200;
    config.recoverSlow = 0.0;
    config.resampleBelow = 1.0;
    change(config);
    const auto mcl = robot.mcl(config);
    mcl->startAt({0, 0, 0}, spread, 0.0);
    robot.reading(1.0);
    mcl->update(robot.container);
    return static_cast<double>(mcl->samples().size());
  };
  const auto nothing = [](MclConfig&) {};
  EXPECT_EQ(sizeOf(0.0, nothing), 200.0) << "min_particles";
  EXPECT_EQ(sizeOf(0.0, [](MclConfig& c) { c.minSamples = 700; }), 700.0);
  EXPECT_EQ(sizeOf(5.0, [](MclConfig& c) { c.maxSamples = 1500; }), 1500.0) << "particles";
  const double usual = sizeOf(0.5, nothing);
  EXPECT_GT(usual, 1000.0);
  EXPECT_LT(usual, 10000.0);
  EXPECT_NEAR(sizeOf(0.5, [](MclConfig& c) { c.kldError = 0.04; }), usual / 2, 2.0) << "1 / error";
  EXPECT_GT(sizeOf(0.5, [](MclConfig& c) { c.kldQuantile = 3.5; }), 1.05 * usual);
  const double coarse = sizeOf(0.5, [](MclConfig& c) { c.binMetres = 0.5; });
  EXPECT_LT(coarse, 0.5 * usual) << "a quarter as many bins in the middle";
}

// Samples at two places 0.9 m, or 45 degrees, apart: one cluster or two.
TEST(MclSettings, BinsSayWhatHangsTogether) {
  const auto shareOf = [](const Pose2& apart, double binMetres, double binDegrees) {
    const auto two = [apart](const SampleView& poses, std::size_t i) {
      const bool left =
          std::hypot(poses.x[i], poses.y[i]) < 0.02 && std::abs(poses.theta[i]) < 0.02;
      const bool right = std::hypot(poses.x[i] - apart.x, poses.y[i]) < 0.02 &&
                         std::abs(poses.theta[i] - apart.theta) < 0.02;
      return left || right ? 0.0F : -200.0F;
    };
    ToldRobot robot(two);
    MclConfig config = ofSize(60000);
    config.binMetres = binMetres;
    config.binRadians = binDegrees * kPi / 180;
    config.recoverSlow = 0.0;
    const auto mcl = robot.mcl(config);
    mcl->startAt({apart.x / 2, 0, apart.theta / 2}, std::max(0.02, apart.x / 2),
                 std::max(0.02, apart.theta / 2));
    for (const double time : {1.0, 2.0}) {  // the first one leaves samples at the two places alone
      robot.odometry(time, {});             // it stands
      robot.reading(time);
      mcl->update(robot.container);
    }
    return mcl->estimate().share;
  };
  EXPECT_LT(shareOf({0.9, 0, 0}, 0.25, 10), 0.75);
  EXPECT_GT(shareOf({0.9, 0, 0}, 0.9, 10), 0.99);
  EXPECT_LT(shareOf({0, 0, kPi / 4}, 0.25, 10), 0.75);
  EXPECT_GT(shareOf({0, 0, kPi / 4}, 0.25, 45), 0.99);
}

// A reading that says nothing fits everywhere: beside the places that the search finds, candidates
// all over the floor are tried.
TEST(MclSettings, VagueStartTriesSoManyCandidatesASquareMetre) {
  const auto triedOf = [](double perSquareMetre, std::size_t samples) {
    ToldRobot robot([](const SampleView&, std::size_t) { return 0.0F; });
    std::size_t tried = 0;
    robot.container.add(std::make_unique<Told>("counts", [&tried](const SampleView&, std::size_t) {
      ++tried;
      return -1.0F;
    }));
    MclConfig config = ofSize(samples);
    config.startCandidates = perSquareMetre;
    config.budgetMs = 1e6;
    const auto mcl = robot.mcl(config);
    mcl->startGlobal();
    robot.container.set({1, {"told", "test", "counts"}, {1}});
    EXPECT_TRUE(mcl->update(robot.container));
    return tried;
  };
  // Cells of 0.25 m^2 whose centre is 0.2 m from the walls of 8 x 5 m: all 16 x 10. What lies
  // around the 50 places is left out: 2 % of all.
  const auto asMany = [](std::size_t tried, double expected) {
    EXPECT_LE(static_cast<double>(tried), expected);
    EXPECT_GT(static_cast<double>(tried), 0.96 * expected);
  };
  const std::size_t fewest = triedOf(1, 1000);
  asMany(triedOf(500, 1000) - fewest, 40.0 * 500 - 2 * 500);
  asMany(triedOf(100, 1000) - fewest, 40.0 * 100 - 2 * 500);
  asMany(triedOf(1e5, 1000) - fewest, 100000.0 - 2 * 500);
}

TEST(MclSettings, FeaturesAreNewsOnlyAfterSoMuchMotionOrTime) {
  const auto indifferent = [](const SampleView&, std::size_t) { return -1.0F; };
  const auto weighs = [&](const Pose2& moved, double seconds,
                          const std::function<void(MclConfig&)>& change) {
    ToldRobot robot(indifferent);
    MclConfig config = ofSize(100);
    config.minDistance = 0.05;
    config.minRotation = 0.03;
    config.maxInterval = 0.5;
    change(config);
    const auto mcl = robot.mcl(config);
    mcl->startAt({0, 0, 0}, 0.1, 0.1);
    robot.odometry(0.0, {});
    robot.reading(0.0);
    EXPECT_TRUE(mcl->update(robot.container));
    robot.odometry(seconds, moved);
    robot.reading(seconds);
    return mcl->update(robot.container);
  };
  const auto nothing = [](MclConfig&) {};
  EXPECT_FALSE(weighs({0.04, 0, 0.02}, 0.4, nothing));
  EXPECT_TRUE(weighs({0.03, 0.05, 0}, 0.4, nothing));
  EXPECT_TRUE(weighs({0, 0, -0.04}, 0.4, nothing));
  EXPECT_TRUE(weighs({0, 0, 0}, 0.6, nothing));
  EXPECT_TRUE(weighs({0.04, 0, 0}, 0.4, [](MclConfig& c) { c.minDistance = 0.03; }));
  EXPECT_FALSE(weighs({0.06, 0, 0}, 0.4, [](MclConfig& c) { c.minDistance = 0.1; }));
  EXPECT_TRUE(weighs({0, 0, 0.02}, 0.4, [](MclConfig& c) { c.minRotation = 0.01; }));
  EXPECT_FALSE(weighs({0, 0, 0.04}, 0.4, [](MclConfig& c) { c.minRotation = 0.1; }));
  EXPECT_TRUE(weighs({0, 0, 0}, 0.4, [](MclConfig& c) { c.maxInterval = 0.3; }));
  EXPECT_FALSE(weighs({0, 0, 0}, 0.6, [](MclConfig& c) { c.maxInterval = 1.0; }));
}

// Tables with cells of 0.3 m and directions of 0.1 rad know no pose finer than that: the variance
// of a uniform distribution, of the coarsest of all readings.
TEST(MclSettings, CovarianceHoldsTheResolutionOfTables) {
  const auto indifferent = [](const SampleView&, std::size_t) { return -1.0F; };
  ToldRobot robot(indifferent, {0.3, 0.0});
  robot.add("y", indifferent, {0.2, 0.1});
  const auto mcl = robot.mcl(ofSize(100));
  mcl->startAt({1, 1, 0}, 0.0, 0.0);
  robot.reading(1.0, "x");
  robot.reading(1.0, "y");
  ASSERT_TRUE(mcl->update(robot.container));
  const auto& covariance = mcl->estimate().covariance;
  EXPECT_NEAR(covariance[0], 0.3 * 0.3 / 12, 1e-9);
  EXPECT_NEAR(covariance[4], 0.3 * 0.3 / 12, 1e-9);
  EXPECT_NEAR(covariance[8], 0.1 * 0.1 / 12, 1e-9);
  EXPECT_EQ(mcl->estimate(fromSeconds(1.0))->covariance, covariance);
}

TEST(MclSettings, CovarianceOfSamplesThatFillACellIsTheirOwn) {
  ToldRobot robot([](const SampleView&, std::size_t) { return -1.0F; }, {0.3, 0.1});
  const auto mcl = robot.mcl(ofSize(20000));
  mcl->startAt({1, 1, 0}, 0.2, 0.05);
  robot.reading(1.0, "x");
  ASSERT_TRUE(mcl->update(robot.container));
  const auto& covariance = mcl->estimate().covariance;
  EXPECT_NEAR(covariance[0], 0.2 * 0.2, 0.002);
  EXPECT_NEAR(covariance[4], 0.2 * 0.2, 0.002);
  EXPECT_NEAR(covariance[8], 0.05 * 0.05, 0.0002);
}

// Two metres forth and back leave the robot where it was, but not what is known of that. It stands
// for so long that a delay of the readings would make no difference.
TEST(MclSettings, MotionWithoutReadingsIsFollowedInPieces) {
  MovingRobot robot;
  const auto mcl = robot.mcl(OdometryNoise{0, 0, 0.1, 0, 0, 0}, 5000);
  mcl->startAt({0, 0, 0}, 0.0, 0.0);
  robot.odometry(0.0, {{0, 0, 0}, 0, 0.0, {}});
  robot.feature("early", 0.0);
  mcl->update(robot.container);
  for (int i = 1; i <= 120; ++i) {
    robot.odometry(0.1 * i, {{0.05 * std::max(0, std::min(i, 80 - i)), 0, 0}, 0, 0.0, {}});
    EXPECT_FALSE(mcl->update(robot.container));
  }
  robot.feature("late", 12.0);
  ASSERT_TRUE(mcl->update(robot.container));
  EXPECT_NEAR(mcl->estimate().pose.x, 0.0, 0.02);
  EXPECT_NEAR(mcl->estimate().covariance[0], 4 * 0.01, 0.004);
}

// Nobody says how the robot moves: sigmas grow with the root of time.
TEST(MclSettings, WithoutOdometrySamplesDrift) {
  const auto sigmasAfter = [](double seconds, int readings, double metres, double radians) {
    ToldRobot robot([](const SampleView&, std::size_t) { return -1.0F; });
    MclConfig config = ofSize(5000);
    config.driftMetres = metres;
    config.driftRadians = radians;
    config.binMetres = 100;
    config.binRadians = 6.28;
    const auto mcl = robot.mcl(config);
    mcl->startAt({1, 2, 0.5}, 0.0, 0.0);
    for (int i = 0; i <= readings; ++i) {
      robot.reading(1.0 + i * seconds / readings);
      EXPECT_TRUE(mcl->update(robot.container));
    }
    EXPECT_FALSE(mcl->hasOdometry());
    EXPECT_NEAR(mcl->estimate().pose.x, 1.0, 0.05);
    EXPECT_NEAR(mcl->estimate(fromSeconds(99))->pose.x, mcl->estimate().pose.x, 0.03);
    const auto& covariance = mcl->estimate().covariance;
    EXPECT_NEAR(std::sqrt(covariance[4] / covariance[0]), 1.0, 0.05);
    return std::pair(std::sqrt(covariance[0]), std::sqrt(covariance[8]));
  };
  const auto [metres, radians] = sigmasAfter(1.0, 10, 0.5, 0.2);
  EXPECT_NEAR(metres, 0.5, 0.02);
  EXPECT_NEAR(radians, 0.2, 0.01);
  EXPECT_NEAR(sigmasAfter(1.0, 1, 0.5, 0.2).first, 0.5, 0.02) << "however many readings";
  EXPECT_NEAR(sigmasAfter(4.0, 10, 0.5, 0.2).first, 1.0, 0.04);
  EXPECT_NEAR(sigmasAfter(1.0, 10, 0.1, 0.2).first, 0.1, 0.01);
  EXPECT_NEAR(sigmasAfter(1.0, 10, 0.5, 0.05).second, 0.05, 0.004);
}

// Nobody tells how far it has come then: what it may have come counts as way between readings.
TEST(MclSettings, WithoutOdometryAKidnapIsNoticedTooUnlessNobodyIsToLook) {
  const auto errorWith = [](double recoverSlow) {
    FakeRun run;
    MclConfig config = run.config();
    config.recoverSlow = recoverSlow;
    const auto mcl = run.mcl(config);
    run.begin(FakeRun::onCircle(1.5, 0.5, 0.3), 3);
    mcl->startAt(run.truth, 0.1, 0.1);
    run.tellsOdometry = false;
    for (int i = 0; i < 30; ++i) {
      run.drive();
      mcl->update(run.container);
    }
    EXPECT_LT(distance(mcl->estimate().pose, run.truth), 0.3);
    run.truth = FakeRun::onCircle(-2, -0.5, 4.5);
    for (int i = 0; i < 100; ++i) {
      run.drive();
      mcl->update(run.container);
    }
    return distance(mcl->estimate().pose, run.truth);
  };
  EXPECT_LT(errorWith(MclConfig().recoverSlow), 0.3);
  EXPECT_GT(errorWith(0.0), 0.5);
}

// A laser all around follows a robot without odometry; with the samples standing it does not.
TEST(MclSettings, DriftFollowsARobotThatTellsNoOdometry) {
  const auto errorWith = [](double metres, double radians) {
    FakeRun run;
    MclConfig config = run.config();
    config.driftMetres = metres;
    config.driftRadians = radians;
    config.recoverSlow = 0.0;  // by following, not by searching anew
    const auto mcl = run.mcl(config);
    run.begin(FakeRun::onCircle(1, 0.5, 0.3), 3);
    mcl->startAt(run.truth, 0.1, 0.1);
    run.tellsOdometry = false;
    double worst = 0.0;
    for (int i = 0; i < 80; ++i) {
      run.drive();
      mcl->update(run.container);
      worst = std::max(worst, distance(mcl->estimate().pose, run.truth));
    }
    EXPECT_FALSE(mcl->hasOdometry());
    return worst;
  };
  EXPECT_LT(errorWith(MclConfig().driftMetres, MclConfig().driftRadians), 0.3);
  EXPECT_GT(errorWith(0.0, 0.0), 1.0);
}

TEST(MclSettings, MclUsesWhatItsTableSays) {
  Parameters p("r.toml");
  const std::vector<std::pair<const char*, double>> values = {
      {"particles", 3000},      {"min_particles", 300},
      {"resample_below", 0.25}, {"kld_error", 0.03},
      {"kld_quantile", 1.5},    {"bin_m", 0.3},
      {"bin_deg", 20},          {"recover_fast", 0.3},
      {"recover_slow", 0.02},   {"min_distance_m", 0.06},
      {"min_rotation_deg", 3},  {"max_interval_s", 0.7},
      {"drift_m", 0.8},         {"budget_ms", 25},
      {"drift_deg", 45},        {"start_candidates_per_m2", 120}};
  for (const auto& [key, value] : values) p.set(key, value);
  p.set("learns_biases", false);
  p.set("learns_odometry", false);
  p.set("watches_map", false);
  for (const MclConfig::Option& option : MclConfig::options())
    EXPECT_TRUE(p.has(option.key)) << option.key << " is not looked at here";
  const MclConfig c = MclConfig::read(p);
  EXPECT_FALSE(c.learnsBiases);
  EXPECT_FALSE(c.learnsOdometry);
  EXPECT_FALSE(c.watchesMap);
  EXPECT_EQ(c.budgetMs, 25.0);
  EXPECT_EQ(c.maxSamples, 3000u);
  EXPECT_EQ(c.minSamples, 300u);
  EXPECT_EQ(c.resampleBelow, 0.25);
  EXPECT_EQ(c.kldError, 0.03);
  EXPECT_EQ(c.kldQuantile, 1.5);
  EXPECT_EQ(c.binMetres, 0.3);
  EXPECT_NEAR(c.binRadians, kPi / 9, 1e-12);
  EXPECT_EQ(c.recoverFast, 0.3);
  EXPECT_EQ(c.recoverSlow, 0.02);
  EXPECT_EQ(c.minDistance, 0.06);
  EXPECT_NEAR(c.minRotation, kPi / 60, 1e-12);
  EXPECT_EQ(c.maxInterval, 0.7);
  EXPECT_EQ(c.driftMetres, 0.8);
  EXPECT_NEAR(c.driftRadians, kPi / 4, 1e-12);
  EXPECT_EQ(c.startCandidates, 120.0);
}

}  // namespace
}  // namespace ortung
