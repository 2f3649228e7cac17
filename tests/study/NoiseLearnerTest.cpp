// A robot whose sensors err in known ways: each is found again, within its standard errors.
#include <gtest/gtest.h>

#include <cmath>

#include "FakeRoom.hpp"
#include "ortung/study/Evaluation.hpp"
#include "ortung/study/NoiseLearner.hpp"

namespace ortung {
namespace {

using test::Room;

constexpr double kSeconds = 300.0;
constexpr double kPeriod = 0.1;  ///< of readings [s]
constexpr double kErrors = 4.0;  ///< farther off than so many standard errors is once in 16,000

/// How a sensor errs.
struct Faulty {
  double rangeBias = 0.0;
  double bearingBias = 0.0;
  Pose2 moved;  ///< from where the robot file says that it is
  double latency = 0.0;
  double sigma = 0.03;
  double perMetre = 0.0;
  double bearingSigma = 0.01;
  double outliers = 0.0;
};

/// Where the robot is: round and round, with curves to both sides.
Pose2 poseAt(double seconds) {
  const double a = 0.3 * seconds;
  const double b = 0.41 * seconds;
  const double vx = -2.5 * 0.3 * std::sin(a);
  const double vy = 1.4 * 0.41 * std::cos(b);
  return {2.5 * std::cos(a), 1.4 * std::sin(b), std::atan2(vy, vx)};
}

class NoiseLearnerTest : public testing::Test {
 protected:
  const Room room{8, 5};
  const TableInfo info{"room", "room-1", "robot", test::kPi / 90, room.region(0.1, 0.2), {}};
  NoiseLog log;
  Random random{7};

  NoiseLearnerTest() {
    for (double t = 0.0; t < kSeconds; t += 0.02)
      log.reference.emplace_back(fromSeconds(t), poseAt(t));
  }

  template <class Words>
  LearnedNoise learn(SensorData& feature, const Faulty& faulty, const Words& words) {
    std::vector<NoiseLog::Reading>& readings = log.readings[toText(feature.id())];
    const Pose2& mount = feature.mount();
    const Pose2 truly{mount.x + faulty.moved.x, mount.y + faulty.moved.y,
                      mount.theta + faulty.moved.theta};
    for (double t = 1.0; t < kSeconds - 1.0; t += kPeriod)
      readings.push_back({fromSeconds(t), words(poseAt(t - faulty.latency) * truly)});
    SensorData* const features[] = {&feature};
    return learnNoise(features, info, {&log, 1}, {});
  }
  double noisy(const Faulty& faulty, double range) {
    if (random.uniform() < faulty.outliers) return 0.2 + 7.0 * random.uniform();
    return range + faulty.rangeBias + (faulty.sigma + faulty.perMetre * range) * random.gaussian();
  }
};

void expectNear(const Learned& learned, double truth, double mostError, const char* what) {
  EXPECT_LT(learned.error, mostError) << what;
  EXPECT_LT(std::abs(learned.value - truth), kErrors * learned.error + 1e-3) << what;
}

TEST_F(NoiseLearnerTest, FindsWhatIsWrongWithACameraThatSeesLandmarks) {
  const std::vector<test::Point> points = {
      {1, -3.5, -2.0}, {2, 3.5, -2.0}, {3, 3.0, 2.2}, {4, -3.0, 1.0}};
  LandmarksData camera({"omnivision", "camera", "posts"}, {0.1, 0.05, 0.0},
                       {.identities = {1, 2, 3, 4}, .maxRange = 10.0});
  test::learnEverywhere(camera, info.region, info.headingStep, [&](const Pose2& sensor) {
    return test::landmarkWords(points, sensor, 10.0);
  });
  const Faulty faulty{.rangeBias = -0.05,
                      .bearingBias = 0.02,
                      .moved = {0.06, -0.04, 0.0},
                      .latency = 0.08,
                      .sigma = 0.03,
                      .perMetre = 0.01,
                      .bearingSigma = 0.012,
                      .outliers = 0.08};
  const LearnedNoise learned = learn(camera, faulty, [&](const Pose2& sensor) {
    LandmarksData::Reading reading;
    for (const test::Point& p : points) {
      const double range = std::hypot(p.x - sensor.x, p.y - sensor.y);
      const double bearing = test::bearingTo(sensor, p.x, p.y);
      reading.push_back(
          {p.identity, noisy(faulty, range),
           random.uniform() < faulty.outliers
               ? 6.0 * random.uniform() - 3.0
               : bearing + faulty.bearingBias + faulty.bearingSigma * random.gaussian()});
    }
    return LandmarksData::encode(reading);
  });
  const NoiseFit& fit = learned.fit;
  const auto term = [&](NoiseTerm t) { return fit.terms[static_cast<std::size_t>(t)]; };
  expectNear(term(NoiseTerm::kRangeBias), faulty.rangeBias, 0.003, "range bias");
  expectNear(term(NoiseTerm::kBearingBias), faulty.bearingBias, 0.002, "bearing bias");
  expectNear(term(NoiseTerm::kMountX), faulty.moved.x, 0.005, "mount x");
  expectNear(term(NoiseTerm::kMountY), faulty.moved.y, 0.005, "mount y");
  expectNear(term(NoiseTerm::kLatency), faulty.latency, 0.005, "latency");
  expectNear(fit.distances.sigma, faulty.sigma, 0.003, "sigma");
  expectNear(fit.distances.sigmaPerMetre, faulty.perMetre, 0.001, "sigma per metre");
  expectNear(fit.angles.sigma, faulty.bearingSigma, 0.001, "sigma of bearings");
  expectNear(fit.distances.outliers, faulty.outliers, 0.01, "outliers");
  expectNear(fit.angles.outliers, faulty.outliers, 0.01, "outliers of bearings");
}

// Such a camera takes distances for those along its axis, which are shorter by the cosine; its lens
// bends bearings. Of a mount that is not open.
TEST_F(NoiseLearnerTest, FindsThatACameraMeasuresAlongItsAxis) {
  const std::vector<test::Point> points = {
      {1, -3.5, -2.0}, {2, 3.5, -2.0}, {3, 3.0, 2.2}, {4, -3.0, 1.0}};
  LandmarksData camera({"omnivision", "camera", "posts"}, {},
                       {.identities = {1, 2, 3, 4}, .maxRange = 10.0});
  test::learnEverywhere(camera, info.region, info.headingStep, [&](const Pose2& sensor) {
    return test::landmarkWords(points, sensor, 10.0);
  });
  std::vector<NoiseLog::Reading>& readings = log.readings[toText(camera.id())];
  for (double t = 1.0; t < kSeconds - 1.0; t += kPeriod) {
    LandmarksData::Reading reading;
    for (const test::Point& p : points) {
      const double bearing = test::bearingTo(poseAt(t), p.x, p.y);
      if (std::abs(bearing) > 0.6) continue;
      const double range = std::hypot(p.x - poseAt(t).x, p.y - poseAt(t).y);
      reading.push_back({p.identity, 1.03 * range * std::cos(bearing) + 0.02 * random.gaussian(),
                         bearing - 0.05 * bearing * bearing + 0.005 * random.gaussian()});
    }
    readings.push_back({fromSeconds(t), LandmarksData::encode(reading)});
  }
  SensorData* const features[] = {&camera};
  NoiseLearning how;
  for (const NoiseTerm term : {NoiseTerm::kMountX, NoiseTerm::kMountY, NoiseTerm::kLatency})
    how.wanted[static_cast<std::size_t>(term)] = false;
  const NoiseFit fit = learnNoise(features, info, {&log, 1}, how).fit;
  const auto term = [&](NoiseTerm t) { return fit.terms[static_cast<std::size_t>(t)].value; };
  EXPECT_NEAR(term(NoiseTerm::kRangePerMetre), 0.03, 0.004);
  EXPECT_NEAR(term(NoiseTerm::kRangePerMetreRad2), -0.5 * 1.03, 0.03);
  EXPECT_NEAR(term(NoiseTerm::kRangePerMetreRad), 0.0, 0.005);
  EXPECT_NEAR(term(NoiseTerm::kBearingPerRad2), -0.05, 0.01);
  EXPECT_NEAR(fit.distances.sigma.value + 3.0 * fit.distances.sigmaPerMetre.value, 0.02, 0.004);
}

TEST_F(NoiseLearnerTest, SaysNothingOfWhatIsNotWrong) {
  const std::vector<test::Point> points = {{1, -3.5, -2.0}, {2, 3.5, -2.0}};
  LandmarksData camera({"omnivision", "camera", "posts"}, {},
                       {.identities = {1, 2}, .maxRange = 10.0});
  test::learnEverywhere(camera, info.region, info.headingStep, [&](const Pose2& sensor) {
    return test::landmarkWords(points, sensor, 10.0);
  });
  const LearnedNoise learned = learn(camera, {}, [&](const Pose2& sensor) {
    return test::landmarkWords(points, sensor, 10.0, &random, 0.05, 0.02);
  });
  for (std::size_t k = 0; k < kNoiseTerms; ++k)
    EXPECT_LT(std::abs(learned.fit.terms[k].value), 0.003) << k;
  expectNear(learned.fit.distances.sigma, 0.05, 0.003, "sigma");
  EXPECT_LT(learned.fit.distances.outliers.value, 0.005);
  EXPECT_GT(learned.fit.distances.independent, 0.4);
}

TEST_F(NoiseLearnerTest, FindsTheMountOfAScanner) {
  ScanData scanner({"LMS200", "LRF", "scan"}, {0.1, 0.0, 0.0},
                   {.beams = 61,
                    .firstAngle = -test::kPi / 2,
                    .angleStep = test::kPi / 60,
                    .maxRange = 12.0,
                    .resolution = {.metres = 0.02, .perMetre = 0.0}});
  test::learnEverywhere(scanner, info.region, info.headingStep, [&](const Pose2& sensor) {
    return test::scanWords(room, sensor, scanner.config());
  });
  const Faulty faulty{
      .rangeBias = 0.04, .moved = {0.05, 0.0, 0.03}, .sigma = 0.05, .outliers = 0.1};
  const LearnedNoise learned = learn(scanner, faulty, [&](const Pose2& sensor) {
    std::vector<float> ranges;
    for (int i = 0; i < scanner.config().beams; ++i) {
      const double angle =
          sensor.theta + scanner.config().firstAngle + i * scanner.config().angleStep;
      ranges.push_back(static_cast<float>(noisy(faulty, room.range(sensor.x, sensor.y, angle))));
    }
    std::vector<std::uint32_t> words;
    ScanData::encode(ranges, scanner.config().maxRange, words);
    return words;
  });
  const auto term = [&](NoiseTerm t) { return learned.fit.terms[static_cast<std::size_t>(t)]; };
  // Tables are of cells of 10 cm and levels of 2 cm: they are no better than some millimetres.
  EXPECT_NEAR(term(NoiseTerm::kRangeBias).value, faulty.rangeBias, 0.004);
  EXPECT_NEAR(term(NoiseTerm::kMountX).value, faulty.moved.x, 0.006);
  EXPECT_NEAR(term(NoiseTerm::kMountTheta).value, faulty.moved.theta, 0.002);
  EXPECT_NEAR(term(NoiseTerm::kLatency).value, 0.0, 0.01);
  EXPECT_NEAR(learned.fit.distances.sigma.value, faulty.sigma, 0.005);
  EXPECT_NEAR(learned.fit.distances.outliers.value, faulty.outliers, 0.02);
}

TEST_F(NoiseLearnerTest, RefusesLogsWithoutAReference) {
  LandmarksData camera({"omnivision", "camera", "posts"}, {}, {.identities = {1}});
  test::learnEverywhere(camera, info.region, info.headingStep, [&](const Pose2& sensor) {
    return test::landmarkWords({{1, 0.0, 2.0}}, sensor, 20.0);
  });
  log.reference.clear();
  EXPECT_THROW(learn(camera, {},
                     [&](const Pose2& sensor) {
                       return test::landmarkWords({{1, 0.0, 2.0}}, sensor, 20.0);
                     }),
               std::runtime_error);
}

}  // namespace
}  // namespace ortung
