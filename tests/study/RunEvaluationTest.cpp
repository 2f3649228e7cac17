// A run of a drive in a known room: errors against the truth that the drive was made from.
#include <algorithm>
#include <cmath>

#include "../run/RoomRun.hpp"
#include "ortung/study/Figures.hpp"
#include "ortung/study/RunEvaluation.hpp"

namespace ortung::test {
namespace {

using EvaluatedRuns = RoomRun;

double valueOf(const NamedFigures& figures, const std::string& name) {
  for (const NamedFigure& one : figures)
    if (one.name == name) return one.value;
  ADD_FAILURE() << name << " is missing";
  return std::nan("");
}

TEST_F(EvaluatedRuns, CompareWithTheTruthAtAllTimes) {
  Localization localization(fromRecord());
  double share = -1.0;
  const EvaluatedRun run = evaluate(localization, "drive", {}, [&](double done) {
    EXPECT_GE(done, share);
    share = done;
    return true;
  });
  EXPECT_EQ(run.first, 0);
  EXPECT_EQ(run.figures.source, "drive");
  EXPECT_EQ(run.figures.steps, run.estimates.size());
  EXPECT_EQ(run.updateMs.size(), run.estimates.size());
  EXPECT_DOUBLE_EQ(run.figures.duration, 4.0);
  ASSERT_GE(run.figures.points.size(), 38U);  // 4 s at 10 Hz, but the ends
  for (const EvaluationPoint& point : run.figures.points) {
    // The truth at that time: a circle of 0.9 m around (0, 0), 0.35 rad in a second.
    const double angle = 0.35 * toSeconds(point.stamp);
    EXPECT_NEAR(point.truth.x, 0.9 * std::cos(angle), 0.06);  // steps of the drive are chords
    EXPECT_NEAR(point.positionError, distance(point.estimate, point.truth), 1e-9);
    EXPECT_LT(point.positionError, 0.15);  // cells of 0.1 m
  }
  EXPECT_TRUE(std::ranges::is_sorted(run.path, {}, &PoseEstimate::stamp));
}

TEST_F(EvaluatedRuns, EndWhenTheyAreToldTo) {
  Localization localization(fromRecord());
  int left = 20;
  const EvaluatedRun run = evaluate(localization, "drive", {}, [&](double) { return left-- > 0; });
  EXPECT_NEAR(run.figures.duration, 1.9, 1e-9);
}

TEST_F(EvaluatedRuns, HaveFiguresByName) {
  Localization localization(fromRecord());
  // The drive is right from the start, so errors after convergence are those of all times.
  const EvaluatedRun run = evaluate(localization, "drive", {.convergedSeconds = 1.0});
  const NamedFigures errors = errorFigures(run.figures);
  EXPECT_EQ(valueOf(errors, "steps"), static_cast<double>(run.estimates.size()));
  double squares = 0.0;
  for (const EvaluationPoint& point : run.figures.points)
    squares += point.positionError * point.positionError;
  EXPECT_NEAR(valueOf(errors, "position_rmse_m"),
              std::sqrt(squares / static_cast<double>(run.figures.points.size())), 1e-9);
  EXPECT_EQ(valueOf(correctionFigures(run.figures), "position_median_m"),
            run.figures.atCorrections.positionMedian);
}

TEST_F(EvaluatedRuns, NeedReadingsThatDependOnThePose) {
  for (auto& moment : moments) moment.erase(moment.begin() + 1);  // the scanner's
  record("room-1");
  Localization localization(fromRecord());
  try {
    evaluate(localization, "drive", {});
    FAIL() << "a run without scans was evaluated";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("nothing to localize with"), std::string::npos);
  }
}

}  // namespace
}  // namespace ortung::test
