// The first half of an update: the samples are moved (eq. 8).
#include <algorithm>
#include <cmath>

#include "BeliefTuning.hpp"
#include "Drift.hpp"
#include "FilterTuning.hpp"
#include "MclImpl.hpp"
#include "MotionPieces.hpp"
#include "MotionTuning.hpp"
#include "Resampling.hpp"

namespace ortung {
namespace {

using namespace tuning::prediction;
using tuning::common::kUsualKept;

// Number of the first random number of each alternative hypothesis, so that its noise is not that
// of the belief's samples.
constexpr std::size_t kNumberOfRivals = 1U << 24;

}  // namespace

/// Returns the time over which process noise acts [s].
double Mcl::Impl::secondsSinceWeighing(Timestamp stamp) const {
  return reached.stamp ? driftSeconds(*reached.stamp, stamp) : 0.0;
}

/// Moves the samples without readings, once the robot has moved by a piece (isPiece()).
void Mcl::Impl::followMotion(const Pose2& odometry) {
  if (!reached.odometry && !track->waitsForStart)
    reached.odometry = odometry;  // odometry's pose at the start
  if (!reached.odometry) return;
  if (!isPiece(inverse(*reached.odometry) * odometry)) return;
  ++step;
  moveBy(odometry);
}

/// Moves all hypotheses that are for the time of the belief.
template <class MoveSome>
void Mcl::Impl::move(const MoveSome& moveSome) {
  if (track->waitsForStart) return;
  track->belief.move(0, moveSome, &tools.workers);
  std::size_t number = 0;
  for (Hypothesis* rival : track->rivals.hypotheses())
    if (rival != nullptr) rival->move(++number * kNumberOfRivals, moveSome, &tools.workers);
  track->present.reset();
}

void Mcl::Impl::moveBy(const Pose2& odometry) {
  const Pose2 change =
      reached.odometry ? parts.polish.odometry().corrected(inverse(*reached.odometry) * odometry)
                       : Pose2{};
  reached.odometry = odometry;
  const double come = std::hypot(change.x, change.y);
  track->travelled.metres += come;
  track->travelled.all += come + std::abs(change.theta);
  const std::uint64_t seed = tools.config.seed;
  const MotionChange its = changeOf(*tools.motion, change, seed, stream(Purpose::kMotion));
  parts.polish.move(its);
  parts.biases.move(its);
  parts.separation.move(parts.polish.odometry().expected(its));
  move([&](const MovableSamples& some, std::size_t first) {
    tools.motion->sampleMotion(some, change, seed, stream(Purpose::kMotion), first);
  });
}

/// Predicts the samples to the time when a reading was taken.
Predicted Mcl::Impl::predict(Timestamp stamp) {
  Predicted predicted{stamp};
  const std::optional<Pose2> now = parts.lateness.odometryAt(stamp);
  track->isBlind = !reached.odometry;
  if (track->isBlind) moveBlindly(stamp);
  if (now) moveBy(*now);
  if (now && track->trust.isLost()) {
    // Untrusted odometry that says that the robot is stationary counts as no odometry.
    track->isBlind = track->travelled.all < tuning::trust::kStationary;
    if (track->isBlind)
      moveBlindly(stamp);
    else
      predicted.drifted = spread(stamp);
  }
  followIntervals(stamp);
  reached.stamp = stamp;
  return predicted;
}

/// The usual interval rises at once and falls slowly: what was usual a while ago is still usual.
void Mcl::Impl::followIntervals(Timestamp stamp) {
  if (reached.stamp)
    usualInterval = std::max(toSeconds(stamp - *reached.stamp), kUsualKept * usualInterval);
}

/// Moves the samples by process noise: without odometry, before its first reading, or if it is not
/// trusted and says that the robot is stationary.
void Mcl::Impl::moveBlindly(Timestamp stamp) {
  const double seconds = secondsSinceWeighing(stamp);
  if (seconds == 0.0) return;
  // distance that the robot may have travelled [m]
  const double come = tools.config.driftMetres * std::sqrt(seconds);
  track->travelled.metres += come;
  track->travelled.all += come;
  parts.forgetPlace();
  if (!track->waitsForStart) enlarge();
  const Pose2 ahead = track->momentum.changeAt(stamp);
  move([&](const MovableSamples& some, std::size_t first) {
    drift(tools.config, some, ahead, seconds, stream(Purpose::kMotion), first);
  });
}

/// Moves half of the samples by process noise instead of odometry, while odometry is not trusted.
/// @returns first sample that was moved by process noise; 0: none
std::size_t Mcl::Impl::spread(Timestamp stamp) {
  const double seconds = secondsSinceWeighing(stamp);
  if (seconds == 0.0 || track->waitsForStart) return 0;
  Spread both = ortung::spread(tools.config, track->belief.samples(), track->anchor,
                               track->momentum.changeAt(stamp), seconds, kSpreadSamples,
                               stream(Purpose::kSpread));
  parts.forgetPlace();
  track->belief.setSamples(std::move(both.samples));
  track->present.reset();
  return both.drifted;
}

/// Enlarges the set by resampling, so that it can cover all places where a robot without odometry
/// may be.
void Mcl::Impl::enlarge() {
  Hypothesis& belief = track->belief;
  const std::size_t n = std::min(tools.config.maxSamples, kSpreadSamples);
  if (belief.samples().size() >= n) return;
  const double offset = random(Purpose::kResampling).uniform();
  belief.setSamples(taken(belief.samples(), lowVariance(belief.weights(), n, offset)));
}

}  // namespace ortung
