// The first half of an update: the samples are moved (eq. 8).
#include <algorithm>
#include <cmath>

#include "BeliefTuning.hpp"
#include "Drift.hpp"
#include "FilterTuning.hpp"
#include "MclImpl.hpp"
#include "MotionPieces.hpp"
#include "MotionTuning.hpp"
#include "ReadingsTuning.hpp"
#include "Resampling.hpp"
#include "ScaledNoise.hpp"

namespace ortung {
namespace {

using namespace tuning::prediction;

// Number of the first random number of each alternative hypothesis, so that its noise is not that
// of the belief's samples.
constexpr std::size_t kNumberOfRivals = 1U << 24;
/// Fork of the random numbers by which samples ride lifts.
constexpr std::uint64_t kForkOfRides = 9;

}  // namespace

/// Returns since when nothing has said how the robot moves: since the last weighing without trusted
/// odometry, or since odometry has been missing. Nothing: odometry says it.
std::optional<Timestamp> Mcl::Impl::aloneSince(Timestamp stamp) const {
  if (!reached.stamp || !reached.odometry || track->trust.isLost()) return reached.stamp;
  const std::optional<Timestamp> silent = silentSince(stamp);
  return silent ? std::optional(std::max(*reached.stamp, *silent)) : std::nullopt;
}

/// Returns the time over which process noise acts [s].
double Mcl::Impl::secondsAlone(Timestamp stamp) const {
  const std::optional<Timestamp> since = aloneSince(stamp);
  return since ? driftSeconds(*since, stamp) : 0.0;
}

/// Returns since when odometry has been missing for a reading with this stamp, by readings' clock.
std::optional<Timestamp> Mcl::Impl::silentSince(Timestamp stamp) const {
  const std::optional<Timestamp> since = intake.odometrySilentSince(stamp - delay());
  return since ? std::optional(*since + delay()) : std::nullopt;
}

/// Returns whether a reading comes soon after what was heard before. If it doesn't, its stamp may
/// be wrong, and must not spread the belief.
bool Mcl::Impl::isNear(Timestamp stamp) const {
  const std::optional<Timestamp> newest = newestTime();
  return newest && toSeconds(stamp - *newest) < tuning::intake::kTimeJump;
}

/// Moves the samples without readings, once the robot has moved by a piece (isPiece()).
void Mcl::Impl::followMotion(const Pose2& odometry) {
  // Odometry's pose at the start; without it the samples wait for the next reading.
  if (!reached.odometry && !reached.stamp && !track->waitsForStart) reached.odometry = odometry;
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
  const LearnedOdometry& learned = parts.polish.odometry();
  const Pose2 change =
      reached.odometry ? learned.corrected(inverse(*reached.odometry) * odometry) : Pose2{};
  reached.odometry = odometry;
  const double come = std::hypot(change.x, change.y);
  track->travelled.metres += come;
  track->travelled.all += come + std::abs(change.theta);
  const std::uint64_t seed = tools.config.seed;
  const MotionChange its = changeOf(*tools.motion, change, seed, stream(Purpose::kMotion));
  parts.polish.move(its);
  parts.biases.move(its);
  parts.separation.move(learned.expected(its));
  const double noise = learned.errors().noise;
  move([&](const MovableSamples& some, std::size_t first) {
    sampleMotion(*tools.motion, some, change, its.mean, noise, seed, stream(Purpose::kMotion),
                 first);
  });
}

/// Predicts the samples to the time when a reading was taken.
Predicted Mcl::Impl::predict(Timestamp stamp) {
  Predicted predicted{stamp};
  const std::optional<Timestamp> silent = isNear(stamp) ? silentSince(stamp) : std::nullopt;
  const std::optional<Pose2> now = parts.lateness.odometryAt(silent.value_or(stamp));
  if (!reached.odometry && reached.stamp && intake.isBridged(*reached.stamp - delay()))
    reached.odometry = parts.lateness.odometryAt(*reached.stamp);
  track->isBlind = !reached.odometry;
  if (track->isBlind) moveBlindly(stamp);
  if (now) moveBy(*now);
  if (silent) {
    if (!track->isBlind) moveBlindly(stamp);
    // Readings say from now on where it is, so what odometry will have added up counts no more.
    track->isBlind = true;
    reached.odometry.reset();
  } else if (now && track->trust.isLost()) {
    // Untrusted odometry that says that the robot is stationary counts as no odometry.
    track->isBlind = track->travelled.all < tuning::trust::kStationary;
    if (track->isBlind)
      moveBlindly(stamp);
    else
      predicted.drifted = spread(stamp);
  }
  if (predicted.drifted == 0) rideLifts(stamp);
  followIntervals(stamp);
  reached.stamp = stamp;
  return predicted;
}

/// Lets samples ride that stand in a lift, while nothing says that the robot moves.
void Mcl::Impl::rideLifts(Timestamp stamp) {
  if (rides.isEmpty() || track->waitsForStart || !reached.stamp) return;
  if (!track->isBlind && track->travelled.all > tuning::lifts::kStands) return;
  const SampleSet& samples = track->belief.samples();
  bool isAny = false;
  for (std::size_t i = 0; i < samples.size() && !isAny; ++i)
    isAny = rides.isInLift(static_cast<double>(samples.x[i]), static_cast<double>(samples.y[i]));
  if (!isAny) return;
  enlarge();  // for all of the stops
  const double seconds = std::max(0.0, toSeconds(stamp - *reached.stamp));
  const Random random = this->random(Purpose::kSpread).fork(kForkOfRides);
  bool isCarried = false;
  track->belief.move(0, [&](const MovableSamples& some, std::size_t first) {
    isCarried = rides.ride(some, seconds, random.fork(first)) || isCarried;
  });
  // What readings have said against other floors until now counts no more.
  if (isCarried) track->lookalikes.forget();
  track->present.reset();
}

/// The usual interval rises at once and falls slowly: what was usual a while ago is still usual.
void Mcl::Impl::followIntervals(Timestamp stamp) {
  if (reached.stamp)
    usualInterval =
        std::max(toSeconds(stamp - *reached.stamp), tuning::present::kUsualKept * usualInterval);
}

/// Moves the samples by process noise: without odometry, before its first reading, while it is
/// missing, or if it is not trusted and says that the robot is stationary.
void Mcl::Impl::moveBlindly(Timestamp stamp) {
  const std::optional<Timestamp> since = aloneSince(stamp);
  const double seconds = secondsAlone(stamp);
  if (!since || seconds == 0.0) return;
  // distance that the robot may have travelled [m]
  const double come = tools.config.driftMetres * std::sqrt(seconds);
  track->travelled.metres += come;
  track->travelled.all += come;
  parts.forgetPlace();
  if (!track->waitsForStart) enlarge();
  const Pose2 ahead = inverse(track->momentum.changeAt(*since)) * track->momentum.changeAt(stamp);
  move([&](const MovableSamples& some, std::size_t first) {
    drift(tools.config, some, ahead, seconds, stream(Purpose::kMotion), first);
  });
}

/// Moves half of the samples by process noise instead of odometry, while odometry is not trusted.
/// @returns first sample that was moved by process noise; 0: none
std::size_t Mcl::Impl::spread(Timestamp stamp) {
  const double seconds = secondsAlone(stamp);
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
