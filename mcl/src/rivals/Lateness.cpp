#include "Lateness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "BeliefTuning.hpp"
#include "CarriedOn.hpp"
#include "Centre.hpp"
#include "Kld.hpp"
#include "Resampling.hpp"
#include "RivalsTuning.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

using namespace tuning::lateness;
using tuning::common::kLongGap, tuning::common::kPlaceMetres;

/// Number of their first random number; no other samples use these numbers.
constexpr std::uint64_t kFirstNumber = 1ULL << 28;

}  // namespace

Lateness::Odometry Lateness::odometryByDelay(Timestamp stamp) const {
  Odometry odometry;
  for (std::size_t i = 0; i < Delays::kCount; ++i) odometry[i] = odometryAt(stamp, i);
  return odometry;
}

/// Returns the pose by each delay if it is @p inForce by the delay in force.
std::array<Pose2, Delays::kCount> Lateness::placesAt(Timestamp stamp, const Pose2& inForce) const {
  std::array<Pose2, Delays::kCount> places;
  places.fill(inForce);
  const std::optional<Pose2> now = motion_.odometryAt(stamp);
  const std::optional<Pose2>& then = belief_.odometry[inForce_];
  if (!now || !belief_.before || !then) return places;
  // With another delay the displacement since the last reading is longer or shorter.
  const Pose2 before = inForce * inverse(*now) * *then;
  for (std::size_t i = 0; i < Delays::kCount; ++i)
    if (i != inForce_ && belief_.odometry[i] && probability(i) >= kNegligible) {
      const Pose2 place = before * inverse(*belief_.odometry[i]) * *now;
      if (distance(place, inForce) < kFarthest) places[i] = place;
    }
  return places;
}

Lateness::Suspicion Lateness::suspicion(Timestamp stamp) const {
  // A delay of one step is too small to be reported.
  if (inForce_ > 1 || std::ranges::any_of(belief_.jumps, [](const Jump& jump) {
        return jump.hypothesis.lead().nats() > tuning::lead::kMostNatsOfAReading;
      }))
    return Suspicion::kTold;
  const auto places = placesAt(stamp, Pose2{});
  double elsewhere = 0.0;
  for (std::size_t i = 0; i < Delays::kCount; ++i)
    if (distance(places[i], Pose2{}) > kPlaceMetres) elsewhere += probability(i);
  if (elsewhere > kTold * tuning::delays::kLate) return Suspicion::kTold;
  return elsewhere > kLeftOut ? Suspicion::kPossible : Suspicion::kNone;
}

PoseEstimate Lateness::widened(const PoseEstimate& e, Timestamp stamp) const {
  const auto places = placesAt(stamp, e.pose);
  PoseEstimate wide = e;
  const auto offOf = [](const Pose2& a, const Pose2& b) {
    return std::array{a.x - b.x, a.y - b.y, wrapAngle(a.theta - b.theta)};
  };
  // While no delay is in force, the stamps are taken as they are, and the pose is not shifted.
  for (std::size_t i = 0; i < Delays::kCount && inForce_ > 0; ++i) {
    const auto off = offOf(places[i], e.pose);
    wide.pose.x += probability(i) * off[0];
    wide.pose.y += probability(i) * off[1];
    wide.pose.theta += probability(i) * off[2];
  }
  wide.pose.theta = wrapAngle(wide.pose.theta);
  const auto add = [&wide](double share, const std::array<double, 3>& off) {
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column)
        wide.covariance[3 * row + column] += share * off[row] * off[column];
  };
  for (std::size_t i = 0; i < Delays::kCount; ++i) {
    add(probability(i), offOf(places[i], wide.pose));
    // The delay may be anywhere within its step.
    if (i > 0) add(0.25 * probability(i), offOf(places[i], places[i - 1]));
  }
  return wide;
}

void Lateness::hear(Timestamp odometry) {
  if (!odometrySince_ || odometry < *odometrySince_) odometrySince_ = odometry;
}

void Lateness::forgetAll() {
  inForce_ = 0;
  delays_.forget();
  odometrySince_.reset();
  forget();
}

void Lateness::forget() { belief_ = {}; }

std::optional<Pose2> Lateness::odometryAt(Timestamp stamp, std::size_t delay) const {
  return motion_.odometryAt(stamp - fromSeconds(Delays::secondsOf(delay)));
}

void Lateness::keep(const SampleSet& belief, std::span<const double> weights,
                    const PoseEstimate& estimate, Timestamp stamp) {
  // The usual gap rises quickly, but not at once, since one long silence is not usual; it falls
  // slowly.
  const double gap = toSeconds(stamp - belief_.before.value_or(stamp));
  belief_.usualGap = belief_.usualGap > 0.0 ? std::clamp(gap, kUsualKept * belief_.usualGap,
                                                         kGapMore * belief_.usualGap)
                                            : gap;
  belief_.before = stamp;
  belief_.odometry = odometryByDelay(stamp);
  if (belief_.anchor && stamp >= belief_.anchor->stamp &&
      toSeconds(stamp - belief_.anchor->stamp) < kPiece)
    return;
  belief_.anchor =
      Anchor{stamp, estimate, taken(belief, lowVariance(weights, kSamples, 0.5)), belief_.odometry};
}

/// All delays have the same noise, so that they differ only by odometry.
void Lateness::move(Hypothesis& hypothesis, const Pose2& change, const Moment& moment) const {
  hypothesis.move(kFirstNumber, [&](const MovableSamples& some, std::size_t first) {
    motion_.sampleMotion(some, change, config_.seed, moment.stream, first);
  });
}

/// Returns the time since the last readings [s].
double Lateness::gapTo(Timestamp stamp) const {
  return belief_.before ? toSeconds(stamp - *belief_.before) : 0.0;
}

bool Lateness::isLongGap(double gap) const {
  return belief_.usualGap > 0.0 && gap > kLongGap * belief_.usualGap;
}

// Samples are weighed, and once more when they are annealed.
std::size_t Lateness::posesFor(const Moment& moment) const {
  if (!belief_.jumps.empty()) return 2 * kSamples * belief_.jumps.size();
  const double gap = gapTo(moment.stamp);
  if (!moment.isDoubtful && !isLongGap(gap)) return 0;
  std::size_t delays = 0;
  for (std::size_t i = 0; i < Delays::kCount; ++i)
    if (mayBegin(i, gap)) ++delays;
  return 2 * kSamples * delays;
}

std::optional<Lateness::Change> Lateness::follow(const Moment& moment, const Recovery& recovery,
                                                 const Evidence& evidence) {
  if (!belief_.anchor || moment.stamp <= belief_.anchor->stamp) return std::nullopt;
  const double gap = gapTo(moment.stamp);
  const bool isLonger = isLongGap(gap);
  if (!isLonger) compare(moment);
  goOn(moment, recovery, evidence);
  if (belief_.jumps.empty() && (moment.isDoubtful || isLonger)) begin(moment, gap, evidence);
  return decide();
}

/// Updates the probabilities by which delay explains the motion from the last estimate to this one.
void Lateness::compare(const Moment& moment) {
  const double seconds = toSeconds(moment.stamp - belief_.anchor->stamp);
  // Odometry before its first reading is not known.
  const Timestamp longest = fromSeconds(Delays::secondsOf(Delays::kCount - 1));
  if (seconds < kPiece || !odometrySince_ || belief_.anchor->stamp - longest < *odometrySince_)
    return;
  Delays::Predicted predicted;
  for (std::size_t i = 0; i < Delays::kCount; ++i) {
    const std::optional<Pose2> now = odometryAt(moment.stamp, i);
    const std::optional<Pose2>& then = belief_.anchor->odometry[i];
    if (!now || !then) return;
    const Pose2 change = inverse(*then) * *now;
    if (!(distance(change, Pose2{}) < kFarthest)) return;
    predicted[i] =
        carriedOn(belief_.anchor->estimate, motion_, change, config_.seed, moment.stream);
  }
  delays_.follow(predicted, inForce_, moment.estimate, seconds);
}

/// Weighs a hypothesis that was already moved to these readings.
/// @returns the log-likelihood ratio of the readings against the belief [nats]
double Lateness::weigh(Jump& jump, const Moment& moment, const Evidence& evidence) const {
  const auto climb = [&] {
    Random random = Random(config_.seed, moment.stream).fork(3 + jump.delay);
    return Hypothesis::Climb{kSamples, kSamples, random, random.fork(1), true, moment.isOver};
  };
  return jump.hypothesis.weigh(evidence, config_, kEffective, climb).logEvidence -
         moment.logEvidence;
}

void Lateness::count(Jump& jump, double ratio, double part, bool isUsual) {
  if (jump.hypothesis.count(ratio, part, isUsual))
    jump.sharp += part * std::clamp(ratio, -kMostSharp, kMostSharp);
}

/// Creates the hypotheses that another delay has begun since the last reading.
void Lateness::begin(const Moment& moment, double gap, const Evidence& evidence) {
  const std::optional<Pose2> present = odometryAt(moment.stamp, inForce_);
  const std::optional<Pose2>& then = belief_.anchor->odometry[inForce_];
  if (!present || !then) return;
  for (std::size_t i = 0; i < Delays::kCount; ++i) {
    const std::optional<Pose2> now = odometryAt(moment.stamp, i);
    if (!mayBegin(i, gap) || !now) continue;
    const Pose2 change = inverse(*then) * *now;
    if (apart(change, inverse(*then) * *present) < kPlacesApart) continue;
    Jump jump{i, Hypothesis(belief_.anchor->samples), *now};
    move(jump.hypothesis, change, moment);
    // Whether readings fit as well as usual is checked only from the next reading on.
    count(jump, weigh(jump, moment, evidence), 1.0, true);
    if (jump.hypothesis.lead().nats() > 0.0) belief_.jumps.push_back(std::move(jump));
  }
}

/// Returns whether a delay may begin. A delay that grows leaves a gap of its growth; after a longer
/// silence the errors of odometry explain the misfit.
bool Lateness::mayBegin(std::size_t delay, double gap) const {
  const double grown = Delays::secondsOf(delay) - Delays::secondsOf(inForce_);
  return delay != inForce_ && grown <= gap &&
         gap - std::max(0.0, grown) <= kLongGap * belief_.usualGap;
}

void Lateness::goOn(const Moment& moment, const Recovery& recovery, const Evidence& evidence) {
  std::erase_if(belief_.jumps, [&](Jump& jump) {
    const std::optional<Pose2> now = odometryAt(moment.stamp, jump.delay);
    if (!now) return true;
    const Pose2 change = inverse(jump.odometry) * *now;
    jump.odometry = *now;
    move(jump.hypothesis, change, moment);
    const double ratio = weigh(jump, moment, evidence);
    count(jump, ratio, apart(change, Pose2{}) / kIndependent,
          recovery.isUsual(evidence.fit(jump.hypothesis.samples())));
    return jump.hypothesis.lead().nats() <= tuning::hypothesis::kDropped;
  });
}

/// Returns, of those that lead by enough, the one with the greatest `sharp`; null: there is none.
const Lateness::Jump* Lateness::leading() const {
  const Jump* leading = nullptr;
  for (const Jump& one : belief_.jumps) {
    const Lead& lead = one.hypothesis.lead();
    const bool isEnough =
        one.delay == 0 ? lead.nats() >= tuning::lead::kEnoughForRule : lead.isEnough();
    if (isEnough && (leading == nullptr || one.sharp > leading->sharp)) leading = &one;
  }
  return leading;
}

/// Puts the delay of a hypothesis in force, and returns its samples.
Lateness::Change Lateness::jumpTo(const Jump& jump) {
  std::array<double, Delays::kCount> nats;
  nats.fill(-std::numeric_limits<double>::infinity());
  for (const Jump& one : belief_.jumps) nats[one.delay] = one.hypothesis.lead().nats();
  delays_.change(nats);
  inForce_ = jump.delay;
  Change change{jump.hypothesis.samples()};
  belief_.jumps.clear();
  belief_.anchor.reset();
  return change;
}

std::optional<Lateness::Change> Lateness::decide() {
  if (const Jump* jump = leading()) return jumpTo(*jump);
  const std::size_t best = delays_.mostProbable();
  if (probability(best) < kStrongEvidence * probability(inForce_)) return std::nullopt;
  inForce_ = best;
  belief_.jumps.clear();
  return Change{};
}

}  // namespace ortung
