/// Whether a pose by the line points of one picture says when it is wrong.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "MslLines.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/vision/LineErrors.hpp"
#include "ortung/vision/LinePoseVerdict.hpp"

namespace ortung {
namespace {

constexpr double kNoise = 0.03;  // [m]

struct Seen {
  std::vector<LinePlace> points;
  std::vector<double> sigmas;
};

/// Places on the lines within a range ahead of a pose, in its frame, with noise.
Seen seenFrom(const FieldLines& field, const Pose2& pose, double range, Random& random) {
  Seen seen;
  for (const FieldLine& line : field.lines()) {
    const bool isStraight = line.shape == FieldLine::Shape::kStraight;
    const double length = isStraight ? std::hypot(line.x1 - line.x0, line.y1 - line.y0)
                                     : line.radiusX * (line.to - line.from);
    for (double d = 0.0; d <= length; d += 0.15) {
      const double share = d / length;
      const double t = line.from + share * (line.to - line.from);
      const Pose2 at =
          inverse(pose) * (isStraight ? Pose2{line.x0 + share * (line.x1 - line.x0),
                                              line.y0 + share * (line.y1 - line.y0), 0.0}
                                      : Pose2{line.x + line.radiusX * std::cos(t),
                                              line.y + line.radiusX * std::sin(t), 0.0});
      if (std::hypot(at.x, at.y) > range || std::abs(std::atan2(at.y, at.x)) > 0.9) continue;
      seen.points.push_back({at.x + kNoise * random.gaussian(), at.y + kNoise * random.gaussian()});
      seen.sigmas.push_back(kNoise);
    }
  }
  return seen;
}

LinePoseVerdict judged(const LinePoseSearch& field, const Seen& seen, const Pose2& pose) {
  return judgePose(field, seen.points, seen.sigmas, pose, {});
}

std::string reasons(const LinePoseVerdict& judged) {
  std::string text;
  for (const Check& c : judged.verdict.checks)
    if (!c.isMet()) text += c.name + " " + std::to_string(c.found) + "; ";
  return text;
}

// The squared error by the covariance has the mean 3; over 20 poses, the standard deviation of the
// mean is sqrt(6 / 20) = 0.55.
TEST(LinePoseVerdict, PosesThatPointsDetermineAreOffByTheirCovariance) {
  const LinePoseSearch field{FieldLines(mslLines({}))};
  Random random(1);
  double sum = 0.0;
  constexpr int kPoses = 20;
  for (int i = 0; i < kPoses; ++i) {
    const Pose2 pose{8.0 + random.uniform(-0.5, 0.5), random.uniform(-2.0, 2.0),
                     random.uniform(-0.3, 0.3)};
    const Seen seen = seenFrom(field.lines(), pose, 6.0, random);
    const Pose2 found = field.polish(seen.points, seen.sigmas, pose).pose;
    const LinePoseVerdict verdict = judged(field, seen, found);
    EXPECT_TRUE(verdict.verdict.isDetermined()) << i << ": " << reasons(verdict);
    const Eigen::Vector3d off(found.x - pose.x, found.y - pose.y,
                              wrapAngle(found.theta - pose.theta));
    const Eigen::Map<const Eigen::Matrix3d> covariance(verdict.covariance.data());
    sum += off.dot(covariance.ldlt().solve(off));
  }
  EXPECT_GT(sum / kPoses, 1.5);
  EXPECT_LT(sum / kPoses, 5.0);
}

TEST(LinePoseVerdict, TheOtherSideOfTheFieldIsNoRivalButAnotherPlaceIs) {
  const LinePoseSearch field{FieldLines(mslLines({}))};
  Random random(2);
  const Pose2 pose{8.0, 0.5, 0.1};
  const Seen goal = seenFrom(field.lines(), pose, 6.0, random);
  const LinePoseVerdict sure =
      judged(field, goal, field.polish(goal.points, goal.sigmas, pose).pose);
  EXPECT_GT(sure.rivalCost, 9.0);
  EXPECT_GT(std::hypot(sure.rival.x - pose.x, sure.rival.y - pose.y), 0.3);
  EXPECT_GT(std::hypot(sure.rival.x + pose.x, sure.rival.y + pose.y), 0.3);
  // Where the halves differ, the other side is a place like any other.
  std::vector<FieldLine> uneven = mslLines({});
  FieldLine extra;
  extra.x0 = 3.0, extra.x1 = 4.0, extra.y0 = extra.y1 = 5.0, extra.width = 0.1;
  uneven.push_back(extra);
  const LinePoseSearch other{FieldLines(uneven)};
  const LinePoseVerdict unsure =
      judged(other, goal, other.polish(goal.points, goal.sigmas, pose).pose);
  EXPECT_LT(unsure.rivalCost, 9.0);
  EXPECT_LT(std::hypot(unsure.rival.x + pose.x, unsure.rival.y + pose.y), 0.3);
  EXPECT_FALSE(unsure.verdict.isDetermined());
}

TEST(LinePoseVerdict, ASingleLineOnePointOrNoneDetermineNothing) {
  const LinePoseSearch field{FieldLines(mslLines({}))};
  Seen line;
  for (double y = -1.0; y <= 1.0; y += 0.1) {
    line.points.push_back({2.0, y});
    line.sigmas.push_back(kNoise);
  }
  const Pose2 beforeTouchLine{4.0, 7.0 - 0.0625 - 2.0, 0.5 * std::numbers::pi};
  const LinePoseVerdict single = judged(field, line, beforeTouchLine);
  EXPECT_FALSE(single.verdict.isDetermined());
  EXPECT_GT(single.sigmas[0], 1.0) << "along the line";
  EXPECT_LT(single.sigmas[1], 0.1) << "across it";
  EXPECT_FALSE(judged(field, {{{2.0, 0.0}}, {kNoise}}, beforeTouchLine).verdict.isDetermined());
  EXPECT_FALSE(judged(field, {}, beforeTouchLine).verdict.isDetermined());
}

TEST(LinePoseVerdict, LinesThatAreNotThereCountAgainstIt) {
  const LinePoseSearch field{FieldLines(mslLines({}))};
  Random random(3);
  const Pose2 pose{8.0, 0.5, 0.1};
  const Seen seen = seenFrom(field.lines(), pose, 6.0, random);
  const Pose2 found = field.polish(seen.points, seen.sigmas, pose).pose;
  const auto with = [&](double missing) {
    return judgePose(field, seen.points, seen.sigmas, found, {.found = 6.0, .missing = missing})
        .verdict.isDetermined();
  };
  EXPECT_TRUE(with(1.0));
  EXPECT_FALSE(with(4.0));
}

// A chain of errors e[i] = c e[i - 1] + noise has the correlation c, and the sum of its errors the
// variance of (1 + c) / (1 - c) times as many independent ones.
TEST(LineErrors, NeighboursThatErrAlikeCountAsFewer) {
  FieldLine line;
  line.x0 = -1000.0, line.x1 = 1000.0, line.width = 0.1;
  const FieldLines field({&line, 1});
  Random random(4);
  for (const double c : {0.0, 0.5, 0.8}) {
    std::vector<LineError> errors;
    double e = 0.0;
    for (int i = 0; i < 4000; ++i) {
      e = c * e + std::sqrt(1.0 - c * c) * 0.8 * random.gaussian();
      errors.push_back({0, {-900.0 + 0.1 * i, 0.01 * e}, std::abs(e)});
    }
    EXPECT_NEAR(alikeness(field, errors), (1.0 + c) / (1.0 - c), 0.15 * (1.0 + c) / (1.0 - c));
  }
  EXPECT_EQ(alikeness(field, std::vector<LineError>(5)), 1.0) << "too few to tell";
}

}  // namespace
}  // namespace ortung
