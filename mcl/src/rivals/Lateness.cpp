#include "Lateness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "Annealing.hpp"
#include "CarriedOn.hpp"
#include "Kld.hpp"
#include "Resampling.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

constexpr std::size_t kSamples = 128;
constexpr std::uint64_t kFirstNumber = 1ULL << 28;  ///< of their noise, which no other samples have
constexpr double kEffective = 16.0;                 ///< samples: fewer climb

constexpr double kPiece = 1.0;          ///< of time between places that are compared, at least [s]
constexpr double kSurely = 10.0;        ///< times more probable: then another delay is in force
constexpr double kLeftOut = 0.005;      ///< probability of delays that may be left out
constexpr double kSamePlace = 0.5;      ///< [m]
constexpr double kFarthest = 50.0;      ///< within some seconds [m]: else odometry's counter jumped
constexpr double kNegligible = 1e-6;    ///< probability that is not looked at
constexpr double kEnoughForNone = 8.0;  ///< [nats] for a jump: to have no delay is the rule
constexpr double kMostSharp = 20.0;     ///< that one reading counts to tell jumps apart [nats]

// Where a delay may have begun.
constexpr double kPlacesApart = 0.3;  ///< so that it shows [m + rad]
constexpr double kIndependent = 0.2;  ///< way after which a reading counts whole [m + rad]
constexpr double kLongGap = 3.0;      ///< between readings, of what is usual
constexpr double kGapKept = 0.9;      ///< of what is usual, from reading to reading
constexpr double kGapMore = 1.5;      ///< the same, at most
constexpr double kDropped = -2.0;     ///< [nats]: it has not

/// Ways and turns alike.
double apart(const Pose2& a, const Pose2& b) {
  return distance(a, b) + std::abs(wrapAngle(a.theta - b.theta));
}

}  // namespace

Lateness::Odometry Lateness::odometryByDelay(Timestamp stamp) const {
  Odometry odometry;
  for (std::size_t i = 0; i < Delays::kCount; ++i) odometry[i] = odometryAt(stamp, i);
  return odometry;
}

/// Where the robot is by each delay if it is at @p inForce by the one in force.
std::array<Pose2, Delays::kCount> Lateness::placesAt(Timestamp stamp, const Pose2& inForce) const {
  std::array<Pose2, Delays::kCount> places;
  places.fill(inForce);
  const std::optional<Pose2> now = motion_.odometryAt(stamp);
  const std::optional<Pose2>& then = odometry_[inForce_];
  if (!now || !before_ || !then) return places;
  // From the place of the last reading on, the way is longer or shorter.
  for (std::size_t i = 0; i < Delays::kCount; ++i)
    if (i != inForce_ && odometry_[i] && probability(i) >= kNegligible) {
      const Pose2 place = inForce * inverse(*now) * *then * inverse(*odometry_[i]) * *now;
      if (distance(place, inForce) < kFarthest) places[i] = place;
    }
  return places;
}

bool Lateness::isSuspected(Timestamp stamp) const {
  // A delay of one step is hardly one.
  if (inForce_ > 1 || std::any_of(jumps_.begin(), jumps_.end(), [](const Jump& jump) {
        return jump.lead.nats() > kMostNatsOfAReading;
      }))
    return true;
  const auto places = placesAt(stamp, Pose2{});
  double elsewhere = 0.0;
  for (std::size_t i = 0; i < Delays::kCount; ++i)
    if (distance(places[i], Pose2{}) > kSamePlace) elsewhere += probability(i);
  return elsewhere > kLeftOut;
}

PoseEstimate Lateness::widened(const PoseEstimate& e, Timestamp stamp) const {
  const auto places = placesAt(stamp, e.pose);
  PoseEstimate wide = e;
  const auto offOf = [](const Pose2& a, const Pose2& b) {
    return std::array{a.x - b.x, a.y - b.y, wrapAngle(a.theta - b.theta)};
  };
  // While none is in force, stamps are taken at their word.
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
    // A delay is anywhere within its step.
    if (i > 0) add(0.25 * probability(i), offOf(places[i], places[i - 1]));
  }
  return wide;
}

void Lateness::hear(Timestamp odometry) {
  if (!odometrySince_ || odometry < *odometrySince_) odometrySince_ = odometry;
}

void Lateness::forget() {
  inForce_ = 0;
  delays_.forget();
  odometrySince_.reset();
  forgetBelief();
}

void Lateness::forgetBelief() {
  jumps_.clear();
  anchor_.reset();
  before_.reset();
  usualGap_ = 0.0;
}

std::optional<Pose2> Lateness::odometryAt(Timestamp stamp, std::size_t delay) const {
  return motion_.odometryAt(stamp - fromSeconds(Delays::secondsOf(delay)));
}

void Lateness::keep(const SampleSet& belief, std::span<const double> weights,
                    const PoseEstimate& estimate, Timestamp stamp) {
  // Rises soon, not at once: a silence is not usual. Falls slowly.
  const double gap = toSeconds(stamp - before_.value_or(stamp));
  usualGap_ = usualGap_ > 0.0 ? std::clamp(gap, kGapKept * usualGap_, kGapMore * usualGap_) : gap;
  before_ = stamp;
  odometry_ = odometryByDelay(stamp);
  if (anchor_ && stamp >= anchor_->stamp && toSeconds(stamp - anchor_->stamp) < kPiece) return;
  anchor_ = Anchor{stamp, estimate, taken(belief, lowVariance(weights, kSamples, 0.5)), odometry_};
}

/// With the same noise for each delay, so that only what odometry says makes a difference.
SampleSet Lateness::moved(const SampleSet& from, const Pose2& change, const Moment& moment) const {
  SampleSet set = from;
  motion_.sampleMotion({set.x, set.y, set.theta}, change, config_.seed, moment.stream,
                       kFirstNumber);
  return set;
}

std::optional<Lateness::Change> Lateness::follow(const Moment& moment, const Recovery& recovery,
                                                 const PoseSearch::Weigh& weigh, const Fit& fit) {
  if (!anchor_ || moment.stamp <= anchor_->stamp) return std::nullopt;
  const double gap = before_ ? toSeconds(moment.stamp - *before_) : 0.0;
  const bool isLonger = usualGap_ > 0.0 && gap > kLongGap * usualGap_;
  if (!isLonger) compare(moment);
  goOn(moment, recovery, weigh, fit);
  if (jumps_.empty() && (moment.isDoubtful || isLonger)) begin(moment, gap, weigh);
  return decide();
}

/// Which delay leads from the last place to this one.
void Lateness::compare(const Moment& moment) {
  const double seconds = toSeconds(moment.stamp - anchor_->stamp);
  // What odometry would have said before its first reading is not known.
  const Timestamp longest = fromSeconds(Delays::secondsOf(Delays::kCount - 1));
  if (seconds < kPiece || !odometrySince_ || anchor_->stamp - longest < *odometrySince_) return;
  Delays::Predicted predicted;
  for (std::size_t i = 0; i < Delays::kCount; ++i) {
    const std::optional<Pose2> now = odometryAt(moment.stamp, i);
    const std::optional<Pose2>& then = anchor_->odometry[i];
    if (!now || !then) return;
    const Pose2 change = inverse(*then) * *now;
    if (!(distance(change, Pose2{}) < kFarthest)) return;
    predicted[i] = carriedOn(anchor_->estimate, motion_, change, config_.seed, moment.stream);
  }
  delays_.follow(predicted, inForce_, moment.estimate, seconds);
}

/// Weighs samples that were moved to this reading. @returns whether they stay
bool Lateness::weighJump(Jump& jump, const Moment& moment, const PoseSearch::Weigh& weigh,
                         double part, const Recovery* recovery, const Fit* fit) const {
  std::vector<float> logs;
  weigh(jump.samples, logs);
  const std::vector<double> before = normalized(jump.samples.logWeight);
  const double ratio = logMean(before, logs) - moment.logEvidence;
  SampleSet weighed = jump.samples;
  for (std::size_t i = 0; i < logs.size(); ++i) weighed.logWeight[i] += logs[i];
  if (effectiveSamples(normalized(weighed.logWeight)) < kEffective) {
    const PoseEstimate whole = estimateOf(config_, jump.samples.view(), before);
    Random random = Random(config_.seed, moment.stream).fork(3 + jump.delay);
    weighed = Annealing(weigh, whole.covariance, kSamples)
                  .draw(taken(jump.samples, lowVariance(before, kSamples, random.uniform())),
                        kSamples, random.fork(1))
                  .samples;
  }
  jump.samples = std::move(weighed);
  if (ratio < 0.0 || recovery == nullptr || recovery->isUsual((*fit)(jump.samples))) {
    jump.lead.count(ratio, part);
    jump.sharp += part * std::clamp(ratio, -kMostSharp, kMostSharp);
  }
  return jump.lead.nats() > kDropped;
}

/// Where the robot is if another delay has begun since the last reading.
void Lateness::begin(const Moment& moment, double gap, const PoseSearch::Weigh& weigh) {
  const std::optional<Pose2> present = odometryAt(moment.stamp, inForce_);
  if (!present) return;
  const std::optional<Pose2>& then = anchor_->odometry[inForce_];
  if (!then) return;
  for (std::size_t i = 0; i < Delays::kCount; ++i) {
    const double grown = Delays::secondsOf(i) - Delays::secondsOf(inForce_);
    // After a longer silence odometry alone is to blame.
    if (i == inForce_ || grown > gap || gap - std::max(0.0, grown) > kLongGap * usualGap_) continue;
    const std::optional<Pose2> now = odometryAt(moment.stamp, i);
    if (!now) continue;
    const Pose2 change = inverse(*then) * *now;
    if (apart(change, inverse(*then) * *present) < kPlacesApart) continue;
    Jump jump{i, moved(anchor_->samples, change, moment), *now};
    if (weighJump(jump, moment, weigh, 1.0, nullptr, nullptr) && jump.lead.nats() > 0.0)
      jumps_.push_back(std::move(jump));
  }
}

void Lateness::goOn(const Moment& moment, const Recovery& recovery, const PoseSearch::Weigh& weigh,
                    const Fit& fit) {
  std::erase_if(jumps_, [&](Jump& jump) {
    const std::optional<Pose2> now = odometryAt(moment.stamp, jump.delay);
    if (!now) return true;
    const Pose2 change = inverse(jump.odometry) * *now;
    jump.odometry = *now;
    jump.samples = moved(jump.samples, change, moment);
    const double part = apart(change, Pose2{}) / kIndependent;
    return !weighJump(jump, moment, weigh, part, &recovery, &fit);
  });
}

std::optional<Lateness::Change> Lateness::decide() {
  const Jump* jump = nullptr;
  for (const Jump& one : jumps_) {
    const bool isEnough = one.delay == 0 ? one.lead.nats() >= kEnoughForNone : one.lead.isEnough();
    if (isEnough && (jump == nullptr || one.sharp > jump->sharp)) jump = &one;
  }
  if (jump != nullptr) {
    std::array<double, Delays::kCount> nats;
    nats.fill(-std::numeric_limits<double>::infinity());
    for (const Jump& one : jumps_) nats[one.delay] = one.lead.nats();
    delays_.change(nats);
    inForce_ = jump->delay;
    Change found{jump->samples};
    jumps_.clear();
    anchor_.reset();
    return found;
  }
  const std::size_t best = delays_.mostProbable();
  if (probability(best) < kSurely * probability(inForce_)) return std::nullopt;
  inForce_ = best;
  jumps_.clear();
  return Change{};
}

}  // namespace ortung
