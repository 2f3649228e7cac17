// What sensors take where a robot file says nothing, against the tables of their READMEs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "Paths.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "sensors/compass/CompassSettings.hpp"
#include "sensors/ground_truth/GroundTruthSettings.hpp"
#include "sensors/iconic/IconicSettings.hpp"
#include "sensors/landmarks/LandmarksSettings.hpp"
#include "sensors/lrf/LrfSettings.hpp"
#include "sensors/lrf_iconic/LrfIconicSettings.hpp"
#include "sensors/odometry/OdometrySettings.hpp"
#include "sensors/sonar/SonarSettings.hpp"

namespace ortung {
namespace {

using Defaults = std::map<std::string, std::string>;  ///< key -> its number, or its numbers

std::string text(double value) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.6g", value);
  return digits;
}

template <class T>
std::string text(const std::vector<T>& values) {
  std::string all;
  for (const T value : values) all += (all.empty() ? "" : " ") + text(static_cast<double>(value));
  return all;
}

std::string angle(double radians) { return text(degrees(radians)); }

/// What stands between @p mark, but for those in brackets.
std::vector<std::string> split(const std::string& cell, char mark) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : cell) {
    depth += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (c == mark && depth == 0)
      parts.emplace_back();
    else if (c != ' ' || !parts.back().empty())
      parts.back() += c;
  }
  return parts;
}

/// The keys of a cell; of a table that it shows, those within.
std::vector<std::string> keysOf(const std::string& cell) {
  std::vector<std::string> keys;
  static const std::regex code("`([^`]*)`");
  static const std::regex name("[a-z_0-9]+");
  for (std::sregex_iterator it(cell.begin(), cell.end(), code), end; it != end; ++it) {
    const std::string one = (*it)[1];
    const std::string names = one.substr(one.find('{') == one.npos ? 0 : one.find('{'));
    for (std::sregex_iterator n(names.begin(), names.end(), name); n != end; ++n)
      keys.push_back(n->str());
  }
  return keys;
}

/// "0.50" as "0.5", "[1, 2]" as "1 2", "true" as "1"; what is no number as "".
std::string numbersOf(const std::string& value) {
  if (value.starts_with("true")) return "1";
  if (value.find_first_of("[-0123456789") != 0) return "";
  static const std::regex number("-?[0-9.]+");
  std::vector<double> numbers;
  for (std::sregex_iterator it(value.begin(), value.end(), number), end; it != end; ++it)
    numbers.push_back(std::stod(it->str()));
  return text(numbers);
}

/// The numbers in the third column of the tables of a README whose head begins with @p head.
/// @param when of "360; camera 60" the part that begins with it, else the first one
Defaults defaultsOf(const std::string& plugin, const std::string& head = "key",
                    const std::string& when = "?") {
  std::ifstream in(std::filesystem::path(ORTUNG_SOURCE_DIR) / "plugins/sensors" / plugin /
                   "README.md");
  EXPECT_TRUE(in.good()) << plugin;
  Defaults defaults;
  bool inTable = false;
  for (std::string line; std::getline(in, line);) {
    inTable = line.starts_with("| " + head + " |") || (inTable && line.starts_with("|"));
    if (!inTable || line.find('`') == line.npos) continue;
    const std::vector<std::string> cells = split(line, '|');
    const std::vector<std::string> keys = keysOf(cells.at(1));
    std::string said;
    for (const std::string& part : split(cells.at(3), ';'))
      if (said.empty() || part.starts_with(when))
        said = part.starts_with(when) ? part.substr(when.size() + 1) : part;
    const std::vector<std::string> values = split(said, ',');
    for (std::size_t i = 0; i < keys.size() && i < values.size(); ++i)
      if (const std::string numbers = numbersOf(values[i]); !numbers.empty())
        defaults[keys[i]] = numbers;
  }
  return defaults;
}

Defaults both(Defaults first, const Defaults& second) {
  first.insert(second.begin(), second.end());
  return first;
}

Parameters parameters(const std::string& toml) { return parseToml(toml, "test.toml"); }

Defaults of(const Mounting& mounting) {
  return {{"x_m", text(mounting.pose.x)},
          {"y_m", text(mounting.pose.y)},
          {"z_m", text(mounting.z)},
          {"theta_deg", angle(mounting.pose.theta)}};
}

/// Of a scan of less than a whole turn about the front.
Defaults of(const ScanData::Config& scan) {
  EXPECT_NEAR(scan.firstAngle, -0.5 * scan.angleStep * (scan.beams - 1), 1e-12);
  return {{"beams", text(scan.beams)},
          {"fov_deg", angle(scan.angleStep * (scan.beams - 1))},
          {"min_range_m", text(scan.minRange)},
          {"max_range_m", text(scan.maxRange)}};
}

TEST(SensorDefaults, OfALaserRangeFinderAreThoseOfItsPage) {
  const LrfSettings s = readLrfSettings(parameters(""));
  const Defaults own = {{"period_s", text(s.period)},
                        {"sigma_m", text(s.scan.model.sigma)},
                        {"sigma_per_m", text(s.scan.model.sigmaPerMetre)},
                        {"resolution_m", text(s.scan.resolution.metres)},
                        {"resolution_per_m", text(s.scan.resolution.perMetre)},
                        {"outliers", text(s.scan.model.outliers)},
                        {"max_range_mass", text(s.scan.model.maxRangeMass)},
                        {"exponent", text(s.scan.model.exponent)},
                        {"localizes", text(s.scan.localizes)},
                        {"used_beams", text(s.scan.usedBeams)},
                        {"endpoint_cell_m", text(s.scan.endPointCell)},
                        {"dropout_share", text(s.dropoutShare)}};
  EXPECT_EQ(both(both(own, of(s.scan)), of(s.mounting)), defaultsOf("lrf"));
}

/// All that has a number on its page whether or not there is a scan of its own.
Defaults of(const LrfIconicSettings& s) {
  return {{"break_m", text(s.shapes.breakDistance)},
          {"line_tolerance_m", text(s.shapes.lineTolerance)},
          {"shortest_line_m", text(s.shapes.shortest)},
          {"largest_round_m", text(s.shapes.largestRound)},
          {"wall_sigma_m", text(s.wallSigma)},
          {"share_matched", text(s.shareMatched)},
          {"most_positions", text(s.mostFixes)},
          {"sigma_m", text(s.fix.addedSigma)},
          {"sigma_deg", angle(s.fix.addedHeadingSigma)},
          {"outliers", text(s.fix.model.outliers)},
          {"exponent", text(s.fix.model.exponent)},
          {"noise_sigma_m", text(s.noiseSigma)},
          {"noise_sigma_per_m", text(s.noiseSigmaPerMetre)},
          {"dropout_share", text(s.dropoutShare)}};
}

TEST(SensorDefaults, OfALaserThatSaysWhatItSeesAreThoseOfItsPage) {
  const LrfIconicSettings s = readLrfIconicSettings(parameters(""));
  EXPECT_EQ(of(s), defaultsOf("lrf_iconic"));
  EXPECT_EQ(s.rangeSigma, s.noiseSigma);
  EXPECT_EQ(s.rangeSigmaPerMetre, s.noiseSigmaPerMetre);
  const LrfIconicSettings noisy =
      readLrfIconicSettings(parameters("noise_sigma_m = 0.07\nnoise_sigma_per_m = 0.02"));
  EXPECT_EQ(noisy.rangeSigma, 0.07);
  EXPECT_EQ(noisy.rangeSigmaPerMetre, 0.02);
  // "as of lrf": its place and its own scan.
  const LrfSettings lrf = readLrfSettings(parameters(""));
  EXPECT_EQ(of(s.mounting), of(lrf.mounting));
  EXPECT_EQ(of(s.scan), of(lrf.scan));
  EXPECT_EQ(s.period, lrf.period);
}

TEST(SensorDefaults, OfALaserThatReadsAScanOfOthersAreThoseOfItsPage) {
  const LrfIconicSettings s = readLrfIconicSettings(parameters("reads = '*/LRF/*'"));
  EXPECT_EQ(both(of(s), {{"range_sigma_m", text(s.rangeSigma)},
                         {"range_sigma_per_m", text(s.rangeSigmaPerMetre)}}),
            defaultsOf("lrf_iconic", "key", "with `reads`"));
}

TEST(SensorDefaults, OfARingOfSonarsAreThoseOfItsPage) {
  const SonarSettings s = readSonarSettings(parameters(""));
  ASSERT_EQ(s.mounts.size(), 1u);
  const double bearing = std::atan2(s.mounts[0].y, s.mounts[0].x);
  EXPECT_EQ(bearing, s.mounts[0].theta);
  EXPECT_EQ((Defaults{{"x_m", "0"},  // one sonar tells the place of the ring's middle
                      {"y_m", text(s.mounts[0].y)},
                      {"z_m", text(s.z)},
                      {"theta_deg", angle(s.mounts[0].theta)},
                      {"period_s", text(s.period)},
                      {"angles_deg", angle(bearing)},
                      {"ring_radius_m", text(s.mounts[0].x)},
                      {"opening_deg", angle(s.cone.openingAngle)},
                      {"min_range_m", text(s.minRange)},
                      {"max_range_m", text(s.cone.maxRange)},
                      {"sigma_m", text(s.cone.model.sigma)},
                      {"sigma_per_m", text(s.cone.model.sigmaPerMetre)},
                      {"resolution_m", text(s.cone.resolution.metres)},
                      {"resolution_per_m", text(s.cone.resolution.perMetre)},
                      {"outliers", text(s.cone.model.outliers)},
                      {"max_range_mass", text(s.cone.model.maxRangeMass)},
                      {"exponent", text(s.cone.model.exponent)},
                      {"missed_share", text(s.missedShare)},
                      {"false_share", text(s.falseShare)}}),
            defaultsOf("sonar"));
}

TEST(SensorDefaults, OfAnObserverOfLandmarksAreThoseOfItsPage) {
  const LandmarksSettings s = readLandmarksSettings(parameters(""));
  EXPECT_EQ(both(of(s.mounting), {{"period_s", text(s.period)},
                                  {"identities", text(s.identities)},
                                  {"min_range_m", text(s.minRange)},
                                  {"max_range_m", text(s.maxRange)},
                                  {"fov_deg", angle(s.fieldOfView)},
                                  {"range_sigma_m", text(s.range.sigma)},
                                  {"range_sigma_per_m", text(s.range.sigmaPerMetre)},
                                  {"bearing_sigma_deg", angle(s.bearing.sigma)},
                                  {"outliers", text(s.range.outliers)},
                                  {"exponent", text(s.range.exponent)},
                                  {"range_scale", text(s.rangeScale)},
                                  {"identified", text(s.isIdentified)},
                                  {"range_bias_m", text(s.bias.metres)},
                                  {"range_bias_per_m", text(s.bias.perMetre)},
                                  {"range_bias_per_m_rad", text(s.bias.perMetreRad)},
                                  {"range_bias_per_m_rad2", text(s.bias.perMetreRad2)},
                                  {"bearing_bias_deg", angle(s.bias.radians)},
                                  {"bearing_bias_per_rad", text(s.bias.perRad)},
                                  {"bearing_bias_per_rad2", text(s.bias.perRad2)},
                                  {"occlusion", text(s.occlusion)},
                                  {"slack_m", text(s.slack)},
                                  {"missed_share", text(s.missedShare)},
                                  {"false_share", text(s.falseShare)}}),
            defaultsOf("landmarks"));
  EXPECT_EQ(s.kind, "post");
  EXPECT_FALSE(s.isList);
  EXPECT_FALSE(s.slant);
  EXPECT_EQ(s.bearing.outliers, s.range.outliers);
  EXPECT_EQ(s.bearing.exponent, s.range.exponent);
}

Defaults of(const IconicSettings& s) {
  return both(of(s.mounting), {{"period_s", text(s.period)},
                               {"fov_deg", angle(s.fieldOfView)},
                               {"min_range_m", text(s.minRange)},
                               {"max_range_m", text(s.maxRange)},
                               {"occlusion", text(s.occlusion)},
                               {"slack_m", text(s.slack)},
                               {"visible_share", text(s.visibleShare)},
                               {"noise_range_sigma_m", text(s.noiseRangeSigma)},
                               {"noise_range_sigma_per_m", text(s.noiseRangeSigmaPerMetre)},
                               {"noise_bearing_sigma_deg", angle(s.noiseBearingSigma)},
                               {"missed_share", text(s.missedShare)},
                               {"false_share", text(s.falseShare)}});
}

TEST(SensorDefaults, OfCamerasAreThoseOfTheirPage) {
  EXPECT_EQ(of(readOmnivisionSettings(parameters(""))), defaultsOf("iconic"));
  EXPECT_EQ(of(readCameraSettings(parameters(""))), defaultsOf("iconic", "key", "camera"));
  const IconicSettings s = readCameraSettings(parameters(""));
  EXPECT_EQ(s.see, kIconicFeatures);
  EXPECT_EQ((Defaults{{"rays", text(s.rays)},
                      {"max_range_m", text(s.lines.maxRange)},
                      {"sigma_m", text(s.lines.model.sigma)},
                      {"sigma_per_m", text(s.lines.model.sigmaPerMetre)},
                      {"outliers", text(s.lines.model.outliers)},
                      {"exponent", text(s.lines.model.exponent)},
                      {"used_points", text(s.lines.usedPoints)},
                      {"cell_m", text(s.lines.cell)}}),
            defaultsOf("iconic", "key of `lines`"));
}

TEST(SensorDefaults, OfGoalsAndPostsAreThoseOfTheirPage) {
  const IconicSettings s = readCameraSettings(parameters("max_range_m = 7"));
  const IconicSettings alike = readCameraSettings(
      parameters("max_range_m = 7\ngoals = { identified = false }\nposts.identified = false"));
  const auto check = [](const IconicLandmarks& one, const IconicLandmarks& points,
                        const std::string& what) {
    EXPECT_EQ((Defaults{{"identified", text(one.areIdentified)},
                        {"identities", text(one.list.identities)},
                        {"range_sigma_m", text(one.list.range.sigma)},
                        {"range_sigma_per_m", text(one.list.range.sigmaPerMetre)},
                        {"bearing_sigma_deg", angle(one.list.bearing.sigma)},
                        {"sigma_m", text(points.points.model.sigma)},
                        {"sigma_per_m", text(points.points.model.sigmaPerMetre)},
                        {"outliers", text(one.list.range.outliers)},
                        {"exponent", text(one.list.range.exponent)}}),
              defaultsOf("iconic", "key of `goals`, `posts`", what));
    for (const SensorModel& model : {one.list.bearing, points.points.model}) {
      EXPECT_EQ(model.outliers, one.list.range.outliers);
      EXPECT_EQ(model.exponent, one.list.range.exponent);
    }
    EXPECT_EQ(one.list.maxRange, 7.0);  // that of the camera
    EXPECT_EQ(points.points.maxRange, 7.0);
  };
  check(s.goals, alike.goals, "goals");
  check(s.posts, alike.posts, "posts");
}

TEST(SensorDefaults, OfCompassOdometryAndGroundTruthAreThoseOfTheirPages) {
  const CompassSettings compass = readCompassSettings(parameters(""));
  EXPECT_EQ(both(of(compass.mounting), {{"north_deg", angle(compass.north)},
                                        {"period_s", text(compass.period)},
                                        {"sigma_deg", angle(compass.model.sigma)},
                                        {"outliers", text(compass.model.outliers)},
                                        {"exponent", text(compass.model.exponent)}}),
            defaultsOf("compass"));
  EXPECT_EQ((Defaults{{"period_s", text(readOdometrySettings(parameters("")).period)}}),
            defaultsOf("odometry"));
  EXPECT_EQ((Defaults{{"period_s", text(readGroundTruthSettings(parameters("")).period)}}),
            defaultsOf("ground_truth"));
}

TEST(SensorDefaults, SimulatedNoiseIsThatOfTheModel) {
  const LrfSettings lrf = readLrfSettings(parameters("sigma_m = 0.2\nsigma_per_m = 0.03"));
  EXPECT_EQ(lrf.noiseSigma, 0.2);
  EXPECT_EQ(lrf.noiseSigmaPerMetre, 0.03);
  const SonarSettings sonar = readSonarSettings(parameters("sigma_m = 0.2\nsigma_per_m = 0.03"));
  EXPECT_EQ(sonar.noiseSigma, 0.2);
  EXPECT_EQ(sonar.noiseSigmaPerMetre, 0.03);
  const LandmarksSettings landmarks = readLandmarksSettings(
      parameters("range_sigma_m = 0.2\nrange_sigma_per_m = 0.03\nbearing_sigma_deg = 5"));
  EXPECT_EQ(landmarks.noiseRangeSigma, 0.2);
  EXPECT_EQ(landmarks.noiseRangeSigmaPerMetre, 0.03);
  EXPECT_EQ(landmarks.noiseBearingSigma, radians(5.0));
  EXPECT_EQ(readCompassSettings(parameters("sigma_deg = 5")).noiseSigma, radians(5.0));
}

}  // namespace
}  // namespace ortung
