/// Whether calibrations and poses by lines say when they are wrong, with cameras that are known.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "DrawnPoints.hpp"
#include "MslLines.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/vision/FloorSight.hpp"

namespace ortung {
namespace {

/// A camera by what is estimated of it, in the units of LineCalibration::settings.
struct Truth {
  double focal = 330.0, k1 = 0.0, k2 = 0.0, u = 303.5, v = 399.5;
  double tilt = 3.0, roll = 0.0;  ///< [degrees]
  double height = 0.75;           ///< [m]

  CameraView view() const {
    Parameters p("camera");
    p.set("model", "fisheye");
    p.set("size_px", std::vector<double>{608, 800});
    p.set("focal_px", std::vector<double>{focal, focal});
    p.set("centre_px", std::vector<double>{u, v});
    p.set("distortion", std::vector<double>{k1, k2, 0.0, 0.0});
    return {readCamera(p), {.z = height, .tilt = radians(tilt), .roll = radians(roll)}};
  }
  std::array<double, 8> settings() const { return {focal, k1, k2, u, v, tilt, roll, height}; }
};

/// Drawn from what a guess expects, but for the focal length and the horizon, which are searched.
Truth drawn(Random& random) {
  Truth t;
  t.focal = 330.0 + 10.0 * random.gaussian();
  t.k1 = 0.03 * random.gaussian();
  t.k2 = 0.01 * random.gaussian();
  t.u += 8.0 * random.gaussian();
  t.v += 8.0 * random.gaussian();
  t.roll = 1.5 * random.gaussian();
  t.height = 0.75 + 0.04 * random.gaussian();
  return t;
}

LineCalibrationGuess nearGuess() {
  LineCalibrationGuess guess;
  guess.focals = {0.41};
  return guess;
}

const Pose2 kPlaces[] = {{-8.2, 1.0, 2.8}, {2.5, 1.0, 2.9}, {8.5, -4.0, -0.6}};

LineCalibration calibrated(const FieldLines& field, const std::vector<LinePicture>& pictures,
                           const LineCalibrationGuess& guess = nearGuess()) {
  auto found = calibrateByLines({608, 800}, pictures, LinePoseSearch(field), guess);
  EXPECT_TRUE(found);
  return std::move(*found);
}

const Check& checkOf(const Verdict& verdict, const std::string& name) {
  for (const Check& check : verdict.checks)
    if (check.name == name) return check;
  ADD_FAILURE() << "there is no check of " << name;
  return verdict.checks.front();
}

std::string reasons(const Verdict& verdict) {
  std::string text;
  for (const Check& c : verdict.checks)
    if (!c.isMet()) text += c.name + " " + std::to_string(c.found) + "; ";
  return text;
}

// The squared error by the covariance has the mean 8, the number of parameters. Its standard
// deviation over five cameras is 4 / sqrt(5) = 1.8.
TEST(LineVerdict, CamerasThatPicturesDetermineAreOffByTheirCovariance) {
  const FieldLines field(mslLines({}));
  Random random(3);
  double sum = 0.0;
  constexpr int kCameras = 5;
  for (int i = 0; i < kCameras; ++i) {
    const Truth truth = drawn(random);
    std::vector<LinePicture> pictures;
    for (const Pose2& pose : kPlaces)
      pictures.push_back(PerfectDetector{}(field, truth.view(), pose, random));
    const LineCalibration found = calibrated(field, pictures);
    EXPECT_TRUE(found.verdict.isDetermined()) << i << ": " << reasons(found.verdict);
    ASSERT_EQ(found.settings.size(), 8U);
    Eigen::Matrix<double, 8, 1> off;
    for (int k = 0; k < 8; ++k)
      off[k] = found.settings[static_cast<std::size_t>(k)].value -
               truth.settings()[static_cast<std::size_t>(k)];
    const Eigen::Map<const Eigen::Matrix<double, 8, 8>> covariance(found.covariance.data());
    const double squared = off.dot(covariance.ldlt().solve(off));
    sum += squared;
    std::printf("focal %.1f, off by %.1f, sigma %.1f; floor %.2f %%; squared error %.1f\n",
                truth.focal, off[0], found.settings[0].sigma, 100.0 * found.floorSigma, squared);
  }
  EXPECT_GT(sum / kCameras, 3.0);
  EXPECT_LT(sum / kCameras, 16.0);
}

TEST(LineVerdict, OnePointSaysNothing) {
  const FieldLines field(mslLines({}));
  const LinePicture one{{{{300.0, 600.0}, 5.0, true}}, 415.0};
  const LineCalibration found = calibrated(field, {one});
  EXPECT_FALSE(found.verdict.isDetermined());
  EXPECT_FALSE(checkOf(found.verdict, "points within 5 m").isMet());
  EXPECT_FALSE(checkOf(found.verdict, "sigma of the focal length").isMet());
  EXPECT_TRUE(found.verdict.sentence().starts_with("not determined: take pictures that"))
      << found.verdict.sentence();
  EXPECT_FALSE(found.pictures[0].place.verdict.isDetermined());
}

TEST(LineVerdict, FarLinesAloneSayTooLittle) {
  const FieldLines field(mslLines({}));
  Random random(4);
  const PerfectDetector far{.least = 5.5};
  std::vector<LinePicture> pictures;
  for (const Pose2& pose : kPlaces) pictures.push_back(far(field, Truth{}.view(), pose, random));
  const LineCalibration found = calibrated(field, pictures);
  EXPECT_FALSE(found.verdict.isDetermined());
  EXPECT_FALSE(checkOf(found.verdict, "points within 5 m").isMet());
}

// The touch line alone, from three places: its direction and distance say little of a lens.
TEST(LineVerdict, OneStraightLineSaysTooLittle) {
  const FieldLines field(mslLines({}));
  Random random(5);
  const PerfectDetector one{.most = 6.0, .isPainted = [](std::size_t i) { return i == 0; }};
  const std::vector<LinePicture> pictures = {one(field, Truth{}.view(), {2.0, -4.0, -1.4}, random)};
  ASSERT_GT(pictures[0].points.size(), 30U);
  const LineCalibration found = calibrated(field, pictures);
  EXPECT_FALSE(found.verdict.isDetermined());
  EXPECT_FALSE(found.pictures[0].place.verdict.isDetermined());
}

// From the middle of the circle all headings look the same.
TEST(LineVerdict, AViewThatLooksTheSameFromElsewhereSaysTooLittle) {
  const FieldLines field(mslLines({}));
  Random random(6);
  const PerfectDetector circle{.isPainted = [&](std::size_t i) {
    return field.lines()[i].shape == FieldLine::Shape::kArc && field.lines()[i].radiusX > 1.5;
  }};
  const std::vector<LinePicture> pictures = {
      circle(field, Truth{}.view(), {0.1, 0.0, 0.3}, random)};
  ASSERT_GT(pictures[0].points.size(), 30U);
  const LineCalibration found = calibrated(field, pictures);
  EXPECT_FALSE(found.verdict.isDetermined());
  EXPECT_FALSE(found.pictures[0].place.verdict.isDetermined());
}

// Three cameras of a kind are known: a fourth that the pictures determine well, but that is of
// quite another focal length, is none of them.
TEST(LineVerdict, AFocalLengthIsComparedWithItsKind) {
  LineCalibration c{.view = Truth{}.view(), .rivalCost = 100.0};
  for (const char* name :
       {"focal_px", "k1", "k2", "centre_u_px", "centre_v_px", "tilt_deg", "roll_deg", "height_m"})
    c.settings.push_back({name, 1.0, 0.001, 1.0, 1.0});
  c.settings[0] = {"focal_px", 330.0, 4.0, 330.0, 100.0};
  LinePictureFit fit;
  fit.points = 100;
  fit.inSight.found = 5.0;
  c.pictures = {fit};
  LineCalibrationGuess guess;
  EXPECT_TRUE(judgeCalibration(c, guess).isDetermined()) << reasons(judgeCalibration(c, guess));
  guess.kind = {332.0, 326.0, 338.0};
  EXPECT_TRUE(judgeCalibration(c, guess).isDetermined()) << reasons(judgeCalibration(c, guess));
  c.settings[0].value = 280.0;
  // The median deviation of 332 is 6 px, of a normal distribution 8.9 px: with its own sigma of
  // 4 px, 52 px are 5.3 sigmas.
  const Verdict verdict = judgeCalibration(c, guess);
  EXPECT_FALSE(verdict.isDetermined());
  EXPECT_NEAR(checkOf(verdict, "focal length against its kind").found, 5.33, 0.01);
  guess.kind = {332.0, 326.0};
  EXPECT_TRUE(judgeCalibration(c, guess).isDetermined()) << "two cameras are no kind";
}

TEST(LineVerdict, AnotherWorldThatFitsAsWellIsARival) {
  LineCalibration c{.view = Truth{}.view(), .cost = 0.5};
  c.points = 100.0;
  c.rivalCost = std::numeric_limits<double>::infinity();
  LineCalibration same = c;
  same.cost = 0.52;
  considerRival(c, same);
  EXPECT_TRUE(std::isinf(c.rivalCost)) << "the same camera is no rival";
  LineCalibration other{.view = Truth{.focal = 290.0, .height = 0.66}.view(), .cost = 0.53};
  other.settings = {{"focal_px", 290.0, 4.0, 330.0, 100.0}};
  considerRival(c, other);
  EXPECT_NEAR(c.rivalCost, 3.0, 1e-9);  // 0.03 more for each of 100 points
  EXPECT_EQ(c.rivalFocal, 290.0);
}

}  // namespace
}  // namespace ortung
