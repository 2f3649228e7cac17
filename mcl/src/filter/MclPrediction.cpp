// How the samples move: the filter's first half (eq. 8).
#include <algorithm>
#include <cmath>

#include "Drift.hpp"
#include "MclImpl.hpp"
#include "MotionPieces.hpp"
#include "Resampling.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

// The noise of rivals is not that of the belief's samples.
constexpr std::size_t kNumberOfRivals = 1U << 24;
constexpr double kIntervalKept = 0.9;

}  // namespace

/// Moves the samples, though there is nothing to weigh, once the robot has come some way.
void Mcl::Impl::followMotion(const Pose2& odometry) {
  if (!lastOdometry && !waitsForStart) lastOdometry = odometry;  // where the known start was
  if (!lastOdometry) return;
  if (!isPiece(inverse(*lastOdometry) * odometry)) return;
  ++step;
  predict(odometry);
}

template <class Move>
void Mcl::Impl::move(const Move& moveSome) {
  if (waitsForStart) return;
  belief.move(0, moveSome, &workers);
  std::size_t number = 0;
  for (Hypothesis* rival : rivals.hypotheses())
    if (rival != nullptr) rival->move(++number * kNumberOfRivals, moveSome, &workers);
  present.reset();
}

void Mcl::Impl::predict(const Pose2& odometry) {
  const Pose2 change = lastOdometry ? inverse(*lastOdometry) * odometry : Pose2{};
  lastOdometry = odometry;
  const double come = std::hypot(change.x, change.y);
  metres += come;
  way += come + std::abs(change.theta);
  polish.move(*motion, change, config.seed, stream(Purpose::kMotion));
  biases.move(*motion, change, config.seed, stream(Purpose::kMotion));
  move([&](const MovableSamples& some, std::size_t first) {
    motion->sampleMotion(some, change, config.seed, stream(Purpose::kMotion), first);
  });
}

/// Moves the samples to where the robot may be when a reading was taken.
void Mcl::Impl::predictFor(Timestamp stamp) {
  const std::optional<Pose2> now = lateness.odometryAt(stamp);
  drifted = 0;
  isBlind = !lastOdometry;
  if (isBlind) predictBlindly(stamp);
  if (now) predict(*now);
  if (now && trust.isLost()) {
    // Odometry that says that the robot stands, though the readings say that it does not, is none.
    isBlind = way < kStands;
    isBlind ? predictBlindly(stamp) : spread(stamp);
  }
  // Rises at once and falls slowly: what was usual a while ago is so still.
  if (lastTime)
    usualInterval = std::max(toSeconds(stamp - *lastTime), kIntervalKept * usualInterval);
  lastTime = stamp;
}

/// While there is no odometry, it is not trusted and stands, or for the time before its first
/// reading.
void Mcl::Impl::predictBlindly(Timestamp stamp) {
  const double seconds = secondsSinceWeighing(stamp);
  if (seconds == 0.0) return;
  const double come = config.driftMetres * std::sqrt(seconds);  // it may have
  metres += come;
  way += come;
  polish.forget();
  biases.forget();
  if (!waitsForStart) enlarge();
  const Pose2 ahead = momentum.changeAt(stamp);
  move([&](const MovableSamples& some, std::size_t first) {
    drift(config, some, ahead, seconds, stream(Purpose::kMotion), first);
  });
}

/// While odometry is not trusted: one half of the samples is moved by it nevertheless, the other
/// one goes anywhere near.
void Mcl::Impl::spread(Timestamp stamp) {
  const double seconds = secondsSinceWeighing(stamp);
  if (seconds == 0.0 || waitsForStart) return;
  Spread both = ortung::spread(config, belief.samples(), anchor, momentum.changeAt(stamp), seconds,
                               kSpreadSamples, stream(Purpose::kSpread));
  polish.forget();
  biases.forget();
  belief.setSamples(std::move(both.samples));
  drifted = both.drifted;
  present.reset();
}

/// Samples drawn evenly, so many that they can go where a robot may go of which nothing is known.
void Mcl::Impl::enlarge() {
  const std::size_t n = std::min(config.maxSamples, kSpreadSamples);
  if (belief.samples().size() >= n) return;
  Random random(config.seed, stream(Purpose::kResampling));
  belief.setSamples(taken(belief.samples(), lowVariance(belief.weights(), n, random.uniform())));
}

}  // namespace ortung
