#include "ortung/calibration/StandCalibration.hpp"

#include <algorithm>
#include <cmath>

#include "LineFit.hpp"

namespace ortung {
namespace {

constexpr int kSteps = 40;
constexpr int kOffsets = 8;          ///< offsets of the tilt that are tried on each side
constexpr std::size_t kRefined = 6;  ///< number of tries that are refined
constexpr int kRounds = 3;
constexpr std::size_t kPoses = 8;     ///< number of poses of each stand that are refined
constexpr double kNearby = 0.3;       ///< how far a stand may be from its known place [m]
constexpr double kWorstScale = 0.15;  ///< how far a field may be from its scale, as a share
/// Standard deviations of settings that all stands share, once all stands have been fitted together
/// and each is fitted alone.
constexpr double kSharedShare = 0.003;
constexpr double kSharedRoll = 0.005;    // [rad]
constexpr double kSharedCentre = 0.002;  // of the longer side

LineCalibrationGuess linesGuessOf(const StandGuess& guess) {
  LineCalibrationGuess lines;
  lines.height = guess.height;
  lines.heightShare = guess.heightShare;
  lines.tilt = 0.0;
  lines.tiltSigma = guess.offsetSigma;
  lines.focalShare = guess.focalShare;
  if (guess.isPlain) lines.distortion = LineCalibrationGuess::kPlainLens;
  return lines;
}

/// Tries focal lengths, heights and offsets one by one: the best first.
std::vector<LineSolution> bestTries(const LineFit& fit, const LineCalibrationGuess& lines,
                                    const StandGuess& guess) {
  std::vector<double> focals = lines.focals;
  const double side = std::max(fit.size().width, fit.size().height);
  if (guess.focal > 0.0) focals = {guess.focal / side};
  std::vector<LineSolution> tries;
  for (const double focal : focals)
    for (const double height : {-1.0, 0.0, 1.0})
      for (int step = -kOffsets; step <= kOffsets; ++step) {
        const Settings prior = fit.start(focal, guess.height, 1.0);
        Settings start = prior;
        start[kHeight] += height * guess.heightShare;
        start[kTilt] += 2.0 * guess.offsetSigma * step / kOffsets;
        tries.push_back(fit.search(start, prior));
      }
  std::stable_sort(tries.begin(), tries.end(),
                   [](const LineSolution& a, const LineSolution& b) { return a.cost < b.cost; });
  tries.resize(std::min(tries.size(), kRefined));
  return tries;
}

/// The camera that fits all stands best.
LineSolution fitTogether(const LineFit& fit, const LineCalibrationGuess& lines,
                         const StandGuess& guess) {
  std::optional<LineSolution> best;
  for (LineSolution& solution : bestTries(fit, lines, guess)) {
    for (int round = 0; round < 2; ++round) {
      fit.refine(solution, kSteps);
      LineSolution again = fit.search(solution.settings, solution.prior);
      fit.refine(again, kSteps);
      if (!(again.cost < solution.cost)) break;
      solution = std::move(again);
    }
    if (!best || solution.cost < best->cost) best = std::move(solution);
  }
  return *best;
}

/// Returns the distance to a known place, on whichever half.
double offBy(const LinePlace& found, const LinePlace& known) {
  return std::min(std::hypot(found.x - known.x, found.y - known.y),
                  std::hypot(found.x + known.x, found.y + known.y));
}

/// Whether a pose may be where the robot is known to have stood, as the field may not be to scale.
bool mayBeAt(const Pose2& camera, const Stand& stand, const StandGuess& guess) {
  if (!stand.place) return true;
  const Pose2 robot = camera * Pose2{-guess.ahead, 0.0, 0.0};
  const double range = std::hypot(stand.place->x, stand.place->y);
  return offBy({robot.x, robot.y}, *stand.place) < kNearby + kWorstScale * range;
}

/// One stand, fitted with what all stands have in common.
struct Alone {
  LineSolution solution;
  LinePictureFit fit;
};

Alone fitAlone(const LineFit& all, const LineSolution& together, const Stand& stand,
               const LinePicture& picture, const StandGuess& guess) {
  LineCalibrationGuess lines = linesGuessOf(guess);
  lines.heightShare = lines.focalShare = kSharedShare;
  lines.tiltSigma = guess.tiltSigma;
  lines.rollSigma = kSharedRoll;
  lines.centreSigma = kSharedCentre;
  const LineFit fit(all.size(), {&picture, 1}, all.field(), lines);
  const LineFit::Places places = fit.placesOf(together.settings, 0);
  std::vector<LinePose> poses = all.field().search(places.points, places.sigmas, kPoses);
  std::erase_if(poses, [&](const LinePose& pose) { return !mayBeAt(pose.pose, stand, guess); });
  if (poses.empty()) poses.push_back({});
  std::optional<LineSolution> best;
  for (const LinePose& pose : poses) {
    LineSolution solution{together.settings, together.settings, {pose.pose}};
    fit.refine(solution, kSteps);
    if (!best || solution.cost < best->cost) best = std::move(solution);
  }
  return {*best, fit.fits(*best)[0]};
}

/// Describes a stand in the world's lengths; enlarge() adds the robot's place.
StandFit describe(const Alone& alone, const LinePicture& picture) {
  StandFit fit;
  fit.camera = alone.fit.pose;
  fit.tilt = picture.tilt + alone.solution.settings[kTilt];
  fit.points = alone.fit.points;
  fit.median = alone.fit.median;
  return fit;
}

void enlarge(StandFit& fit, double scale, double ahead) {
  fit.camera.x *= scale;
  fit.camera.y *= scale;
  fit.median *= scale;
  const Pose2 robot = fit.camera * Pose2{-ahead, 0.0, 0.0};
  fit.robot = {robot.x, robot.y};
}

/// Returns the scale that known places say; the way from place to camera is not scaled.
std::optional<FieldScale> scaleBy(std::span<const Stand> stands, std::span<const StandFit> fits,
                                  double ahead) {
  std::optional<FieldScale> scale;
  // The camera is ahead of the place by a true length, so the scale decides where it is expected.
  for (int round = 0; round < 3; ++round) {
    std::vector<LinePlace> found, known;
    for (std::size_t i = 0; i < stands.size(); ++i) {
      if (!stands[i].place || fits[i].points == 0) continue;
      const Pose2 robot = fits[i].camera * Pose2{-ahead / (scale ? scale->scale : 1.0), 0.0, 0.0};
      found.push_back({robot.x, robot.y});
      known.push_back(*stands[i].place);
    }
    scale = scaleOf(found, known);
    if (!scale) return scale;
  }
  return scale;
}

Verdict judge(const StandCalibration& calibration) {
  constexpr std::size_t kLeastPoints = 20;
  double good = 0.0, worst = 0.0;
  for (const StandFit& fit : calibration.stands) {
    if (fit.points < kLeastPoints) continue;
    good += 1.0;
    worst = std::max(worst, fit.median);
  }
  Verdict verdict;
  verdict.checks.push_back({"stands with 20 points within 5 m", good, 2.0, true, "", 0,
                            "pictures from more stands, each with several lines within 5 m"});
  verdict.checks.push_back({"distance to the lines in the worst stand", worst, 0.03, false, "m", 3,
                            "pictures of lines that are where the world has them"});
  verdict.checks.push_back({"sigma of the height",
                            100.0 * calibration.heightSigma / calibration.view.place().z, 8.0,
                            false, "%", 1, "pictures with lines near the camera and far away"});
  if (calibration.scale)
    verdict.checks.push_back({"known places, off after scaling", calibration.scale->rootMeanSquare,
                              0.15, false, "m", 3, "the measure of the places once more"});
  return verdict;
}

}  // namespace

std::optional<StandCalibration> calibrateStand(ImageSize size, std::span<const Stand> stands,
                                               const LinePoseSearch& field,
                                               const StandGuess& guess) {
  std::vector<LinePicture> pictures;
  for (const Stand& stand : stands) {
    pictures.push_back(stand.lines);
    pictures.back().tilt = stand.tilt;
  }
  if (std::all_of(pictures.begin(), pictures.end(),
                  [](const LinePicture& picture) { return picture.points.empty(); }))
    return std::nullopt;
  const LineCalibrationGuess lines = linesGuessOf(guess);
  const LineFit fit(size, pictures, field, lines);
  LineSolution together = fitTogether(fit, lines, guess);
  std::vector<Alone> alone;
  // With the poses that stands have alone, of which some may be right only now.
  for (int round = 0; round < kRounds; ++round) {
    alone.clear();
    for (std::size_t i = 0; i < stands.size(); ++i)
      alone.push_back(fitAlone(fit, together, stands[i], pictures[i], guess));
    if (round + 1 == kRounds) break;
    for (std::size_t i = 0; i < stands.size(); ++i) together.poses[i] = alone[i].fit.pose;
    fit.refine(together, kSteps);
  }
  StandCalibration result{viewOf(size, together.settings)};
  const LineFit::Certainty certainty = fit.certainty(together);
  result.offsetSigma = std::sqrt(certainty.covariance(kTilt, kTilt));
  for (std::size_t i = 0; i < stands.size(); ++i)
    result.stands.push_back(describe(alone[i], pictures[i]));
  result.scale = scaleBy(stands, result.stands, guess.ahead);
  const double factor = result.scale ? result.scale->scale : 1.0;
  Settings settings = together.settings;
  settings[kHeight] += std::log(factor);
  result.view = viewOf(size, settings);
  result.heightSigma = result.view.place().z * std::sqrt(certainty.covariance(kHeight, kHeight));
  for (std::size_t i = 0; i < stands.size(); ++i) {
    enlarge(result.stands[i], factor, guess.ahead);
    if (stands[i].place) result.stands[i].off = offBy(result.stands[i].robot, *stands[i].place);
  }
  result.verdict = judge(result);
  return result;
}

}  // namespace ortung
