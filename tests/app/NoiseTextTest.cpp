// What was learned of a sensor's noise, in words and as keys of a robot file.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "NoiseText.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/SightingBias.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::app {
namespace {

constexpr double kPi = std::numbers::pi;

void learn(LearnedNoise& noise, NoiseTerm term, double value, double error, bool isKnown) {
  const auto k = static_cast<std::size_t>(term);
  noise.fit.terms[k] = {value, error};
  noise.fit.isKnown[k] = isKnown;
}

NoiseShape shapeOf(std::size_t values, double sigma, double perMetre, double floor) {
  NoiseShape shape;
  shape.values = values;
  shape.sigma = {sigma, sigma / 20};
  shape.sigmaPerMetre = {perMetre, perMetre / 10};
  shape.outliers = {0.025, 0.004};
  shape.floor = floor;
  shape.independent = 0.25;
  return shape;
}

std::string textOf(const LearnedNoise& noise, std::size_t features = 1) {
  std::vector<std::unique_ptr<ScalarData>> all;
  std::vector<SensorData*> pointers;
  for (std::size_t i = 0; i < features; ++i) {
    all.push_back(std::make_unique<ScalarData>(
        SensorId{"eye", "camera", "post" + std::to_string(i + 1)}, Pose2{}, ScalarData::Config{}));
    pointers.push_back(all.back().get());
  }
  return noiseText(pointers, noise);
}

TEST(NoiseText, ShapesHaveTheirStandardErrorsInTheirUnits) {
  LearnedNoise noise;
  noise.readings = 34;
  noise.fit.distances = shapeOf(120, 0.03, 0.01, 0.02);
  noise.fit.angles = shapeOf(60, kPi / 90, 0.0, 0.012);
  EXPECT_EQ(
      textOf(noise, 3),
      "eye/camera/post1 and 2 more, 34 readings\n"
      "  120 ranges\n"
      "  sigma               0.0300 +- 0.0015 m\n"
      "  sigma per metre     0.0100 +- 0.0010 m/m\n"
      "  outliers            2.5000 +- 0.4000 % (p at least 0.020; a value counts for 0.250)\n"
      "  60 bearings\n"
      "  sigma               2.0000 +- 0.1000 deg\n"
      "  outliers            2.5000 +- 0.4000 % (p at least 0.012; a value counts for "
      "0.250)\n");
}

TEST(NoiseText, TermsAreThoseThatWereLearnedAndSayWhetherTheyAreKnown) {
  LearnedNoise noise;
  noise.readings = 5;
  noise.fit.angles = {};
  EXPECT_EQ(textOf(noise), "eye/camera/post1, 5 readings\n");
  learn(noise, NoiseTerm::kRangeBias, 0.05, 0.001, true);
  learn(noise, NoiseTerm::kBearingBias, kPi / 180, kPi / 1800, true);
  learn(noise, NoiseTerm::kMountTheta, -kPi / 60, kPi / 90, false);
  learn(noise, NoiseTerm::kLatency, 0.125, 0.5, false);
  EXPECT_EQ(textOf(noise),
            "eye/camera/post1, 5 readings\n"
            "  range bias          0.0500 +- 0.0010 m\n"
            "  bearing bias        1.0000 +- 0.1000 deg\n"
            "  mount theta        -3.0000 +- 2.0000 deg (none: less than three errors)\n"
            "  latency             0.1250 +- 0.5000 s (none: less than three errors)\n");
}

// Half of each unit, or half a degree.
TEST(NoiseText, EachTermIsInTheUnitThatItNames) {
  LearnedNoise noise;
  noise.readings = 5;
  for (std::size_t k = 0; k < kNoiseTerms; ++k) {
    const auto term = static_cast<NoiseTerm>(k);
    const bool isAngle = term == NoiseTerm::kBearingBias || term == NoiseTerm::kMountTheta;
    const double unit = isAngle ? kPi / 180 : 1.0;
    learn(noise, term, 0.5 * unit, 0.125 * unit, true);
  }
  EXPECT_EQ(textOf(noise),
            "eye/camera/post1, 5 readings\n"
            "  range bias          0.5000 +- 0.1250 m\n"
            "    per m             0.5000 +- 0.1250 m/m\n"
            "    per m and rad     0.5000 +- 0.1250 1/rad\n"
            "    per m and rad^2   0.5000 +- 0.1250 1/rad^2\n"
            "  bearing bias        0.5000 +- 0.1250 deg\n"
            "    per rad           0.5000 +- 0.1250 rad/rad\n"
            "    per rad^2         0.5000 +- 0.1250 1/rad\n"
            "  mount x             0.5000 +- 0.1250 m\n"
            "  mount y             0.5000 +- 0.1250 m\n"
            "  mount theta         0.5000 +- 0.1250 deg\n"
            "  latency             0.5000 +- 0.1250 s\n");
}

SensorConfig sensorOf(const std::string& plugin,
                      const std::vector<std::pair<std::string, double>>& keys = {},
                      bool isList = false) {
  SensorConfig sensor;
  sensor.plugin = plugin;
  sensor.parameters = Parameters("robot.toml");
  for (const auto& [key, value] : keys) sensor.parameters.set(key, value);
  if (isList) sensor.parameters.set("features", std::string("list"));
  return sensor;
}

using Entries = std::map<std::string, std::string>;

Entries entriesOf(const SensorConfig& sensor, const LearnedNoise& noise) {
  const std::vector<TomlEntry> all = noiseEntries(sensor, noise);
  Entries entries(all.begin(), all.end());
  EXPECT_EQ(entries.size(), all.size()) << "each key once";
  return entries;
}

TEST(NoiseEntries, HaveTheKeysOfTheirPlugins) {
  LearnedNoise noise;
  noise.fit.distances = shapeOf(120, 0.0312, 0.0101, 0.0234);
  const Entries scanner = {
      {"sigma_m", "0.0312"}, {"sigma_per_m", "0.0101"}, {"outliers", "0.0234"}};
  EXPECT_EQ(entriesOf(sensorOf("lrf"), noise), scanner);
  EXPECT_EQ(entriesOf(sensorOf("sonar"), noise), scanner);
  noise.fit.angles = shapeOf(60, kPi / 90, 0.0, 0.0456);
  const Entries eye = {{"range_sigma_m", "0.0312"},
                       {"range_sigma_per_m", "0.0101"},
                       {"bearing_sigma_deg", "2.0000"},
                       {"outliers", "0.0456"}};
  EXPECT_EQ(entriesOf(sensorOf("landmarks"), noise), eye);
  EXPECT_EQ(entriesOf(sensorOf("lrf_cylinders"), noise), eye);
  EXPECT_TRUE(entriesOf(sensorOf("compass"), noise).empty());
}

TEST(NoiseEntries, AModelKeepsSomeNoiseAndSomeOutliersButNotTooMany) {
  LearnedNoise noise;
  noise.fit.distances = shapeOf(120, 0.0, 0.0, 0.0);
  EXPECT_EQ(entriesOf(sensorOf("lrf"), noise),
            (Entries{{"sigma_m", "0.0001"}, {"sigma_per_m", "0.0000"}, {"outliers", "0.0050"}}));
  noise.fit.distances.floor = 0.9;
  EXPECT_EQ(entriesOf(sensorOf("lrf"), noise)["outliers"], "0.5000");
}

TEST(NoiseEntries, TheMountIsThatOfTheRobotFileAndWhatWasFound) {
  LearnedNoise noise;
  EXPECT_FALSE(entriesOf(sensorOf("lrf"), noise).contains("pose"));
  learn(noise, NoiseTerm::kMountX, 0.02, 0.001, true);
  learn(noise, NoiseTerm::kMountY, 0.5, 0.4, false);  // not known, so not used
  EXPECT_EQ(entriesOf(sensorOf("lrf"), noise)["pose"],
            "{ x_m = 0.0200, y_m = 0.0000, theta_deg = 0.0000 }");
  SensorConfig sensor = sensorOf("lrf");
  sensor.parameters =
      parseToml("pose = { x_m = 0.1, y_m = -0.2, z_m = 0.35, theta_deg = 90 }", "robot.toml");
  learn(noise, NoiseTerm::kMountY, 0.05, 0.001, true);
  learn(noise, NoiseTerm::kMountTheta, kPi / 180, 0.001, true);
  EXPECT_EQ(entriesOf(sensor, noise)["pose"],
            "{ x_m = 0.1200, y_m = -0.1500, z_m = 0.3500, theta_deg = 91.0000 }");
}

TEST(NoiseEntries, BiasesHaveKeysOnlyWhereSightingsAreOneFeature) {
  LearnedNoise noise;
  learn(noise, NoiseTerm::kRangeBias, 0.05, 0.001, true);
  learn(noise, NoiseTerm::kBearingBias, kPi / 180, 0.001, true);
  EXPECT_FALSE(entriesOf(sensorOf("landmarks"), noise).contains("range_bias_m"));
  EXPECT_FALSE(entriesOf(sensorOf("lrf"), noise).contains("range_bias_m"));
  for (const SensorConfig& sensor : {sensorOf("landmarks", {}, true), sensorOf("lrf_cylinders")}) {
    const Entries entries = entriesOf(sensor, noise);
    EXPECT_EQ(entries.at("range_bias_m"), "0.0500");
    EXPECT_EQ(entries.at("bearing_bias_deg"), "1.0000");
    EXPECT_FALSE(entries.contains("range_bias_per_m")) << "nothing was found, nothing was there";
  }
  // One that was there is written although it is zero now.
  EXPECT_EQ(entriesOf(sensorOf("lrf_cylinders", {{"range_bias_m", -0.05}}), noise)["range_bias_m"],
            "0.0000");
}

SightingBias biasOf(const Entries& entries) {
  const auto number = [&](const char* key) { return std::stod(entries.at(key)); };
  return {number("range_bias_m"),
          number("range_bias_per_m"),
          number("range_bias_per_m_rad"),
          number("range_bias_per_m_rad2"),
          number("bearing_bias_deg") * kPi / 180,
          number("bearing_bias_per_rad"),
          number("bearing_bias_per_rad2")};
}

// Readings were corrected by the robot file's bias before the other one was found in them, so a
// sensor with both, one after the other, measures what one with their sum does. Keys have four
// digits, and terms of higher order are left out.
TEST(NoiseEntries, TheSumOfTwoBiasesMeasuresWhatBothDo) {
  constexpr SightingBias kOld{0.04, 0.1, 0.06, -0.2, 0.0, 0.0, 0.0};
  constexpr SightingBias kFound{0.02, -0.08, 0.05, 0.1, 0.0, 0.0, 0.0};
  LearnedNoise noise;
  learn(noise, NoiseTerm::kRangeBias, kFound.metres, 1e-4, true);
  learn(noise, NoiseTerm::kRangePerMetre, kFound.perMetre, 1e-4, true);
  learn(noise, NoiseTerm::kRangePerMetreRad, kFound.perMetreRad, 1e-4, true);
  learn(noise, NoiseTerm::kRangePerMetreRad2, kFound.perMetreRad2, 1e-4, true);
  learn(noise, NoiseTerm::kBearingBias, 0.01, 1e-4, true);
  learn(noise, NoiseTerm::kBearingPerRad, 0.03, 1e-4, true);
  learn(noise, NoiseTerm::kBearingPerRad2, -0.02, 1e-4, true);
  const SensorConfig sensor =
      sensorOf("lrf_cylinders", {{"range_bias_m", kOld.metres},
                                 {"range_bias_per_m", kOld.perMetre},
                                 {"range_bias_per_m_rad", kOld.perMetreRad},
                                 {"range_bias_per_m_rad2", kOld.perMetreRad2},
                                 {"bearing_bias_deg", 0.5},
                                 {"bearing_bias_per_rad", 0.1},
                                 {"bearing_bias_per_rad2", 0.2}});
  SightingBias sum = biasOf(entriesOf(sensor, noise));
  EXPECT_NEAR(sum.radians, 0.5 * kPi / 180 + 0.01, 1e-6);
  EXPECT_NEAR(sum.perRad, 0.13, 1e-9);
  EXPECT_NEAR(sum.perRad2, 0.18, 1e-9);
  sum.radians = sum.perRad = sum.perRad2 = 0.0;
  for (const double range : {0.5, 2.0, 5.0}) {
    for (const double bearing : {-0.2, 0.0, 0.15}) {
      const SightingBias::Sight both =
          kOld.measured({kFound.measured({range, bearing}).range, bearing});
      EXPECT_NEAR(sum.measured({range, bearing}).range, both.range, 0.0015) << range << bearing;
    }
  }
}

}  // namespace
}  // namespace ortung::app
