#include "Lateness.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "Annealing.hpp"
#include "Kld.hpp"
#include "Resampling.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

constexpr std::size_t kSamples = 128;
constexpr std::uint64_t kFirstNumber = 1ULL << 28;  ///< of their noise, which no other samples have
constexpr double kEffective = 16.0;                 ///< samples: fewer climb

// What odometry tells between two readings.
constexpr double kPiece = 1.0;        ///< of time between them, at least [s]
constexpr double kApart = 0.05;       ///< motions that differ by less say nothing [m + rad]
constexpr double kIndependent = 0.2;  ///< difference at which a reading counts whole [m + rad]
constexpr double kNearer = 0.4;       ///< of the difference: then another delay is looked at
constexpr double kExplained = 0.7;    ///< of the difference: what may be left of it
constexpr double kToll = 1.0;  ///< [nats] of each reading: motions that are both wrong differ, too
constexpr double kMostOfEvent = 8.0;  ///< [nats] in kEvent
constexpr double kEvent = 3.0;        ///< [s]
constexpr double kSuspect = 12.0;     ///< [nats]
constexpr double kEnough = 20.0;      ///< [nats] for a delay
// To tell apart what is far ahead, readings count more: as good as the best is what is behind by
constexpr double kMostSharp = 20.0;    ///< that one reading counts then [nats]
constexpr double kNearlyEnough = 4.0;  ///< [nats] of those
constexpr double kNearlySharp = 10.0;  ///< and of these

// While a delay is in force.
constexpr std::size_t kFewSteps = 2;    ///< a delay so near ...
constexpr double kEnoughNear = 12.0;    ///< ... needs no more [nats]
constexpr double kEnoughForNone = 8.0;  ///< [nats]: to have none is the rule
constexpr double kLeastIfLate = -12.0;  ///< [nats]: what is long past does not count against it
constexpr double kLeastSharp = -100.0;  ///< the same

// Where a delay may have begun.
constexpr double kPlacesApart = 0.3;  ///< so that it shows [m + rad]
constexpr double kLongGap = 3.0;      ///< between readings, of what is usual
constexpr double kGapKept = 0.9;      ///< of what is usual, from reading to reading
constexpr double kGapMore = 1.5;      ///< the same, at most
constexpr double kDropped = -2.0;     ///< [nats]: it has not

/// Ways and turns alike.
double apart(const Pose2& a, const Pose2& b) {
  return distance(a, b) + std::abs(wrapAngle(a.theta - b.theta));
}

/// Where a motion is on the way from one to another: 0 at the one, 1 at the other.
double share(const Pose2& from, const Pose2& to, const Pose2& motion) {
  const auto minus = [](const Pose2& a, const Pose2& b) {
    return std::array{a.x - b.x, a.y - b.y, wrapAngle(a.theta - b.theta)};
  };
  const auto dot = [](const auto& a, const auto& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const auto way = minus(to, from);
  return dot(minus(motion, from), way) / dot(way, way);
}

}  // namespace

bool Lateness::isSuspected() const {
  return inForce_ > 0 || lead() >= kSuspect ||
         std::any_of(jumps_.begin(), jumps_.end(),
                     [](const Jump& jump) { return jump.lead.nats() > kMostNatsOfAReading; });
}

double Lateness::lead() const {
  double lead = 0.0;
  for (const Case& one : cases_) lead = std::max(lead, one.nats);
  for (const Jump& jump : jumps_) lead = std::max(lead, jump.lead.nats());
  return lead;
}

bool Lateness::isOpen() const { return inForce_ > 0 || lead() > 0.0; }

void Lateness::forget() {
  inForce_ = 0;
  forgetBelief();
}

void Lateness::forgetBelief() {
  cases_ = {};
  jumps_.clear();
  anchor_.reset();
  before_.reset();
  usualGap_ = 0.0;
}

std::optional<Pose2> Lateness::odometryAt(Timestamp stamp, std::size_t delay) const {
  return motion_.odometryAt(stamp - fromSeconds(secondsOf(delay)));
}

void Lateness::keep(const SampleSet& belief, std::span<const double> weights, const Pose2& pose,
                    Timestamp stamp) {
  // Rises soon, not at once: a silence is not usual. Falls slowly.
  const double gap = toSeconds(stamp - before_.value_or(stamp));
  usualGap_ = usualGap_ > 0.0 ? std::clamp(gap, kGapKept * usualGap_, kGapMore * usualGap_) : gap;
  before_ = stamp;
  if (anchor_ && stamp >= anchor_->stamp && toSeconds(stamp - anchor_->stamp) < kPiece) return;
  anchor_.reset();
  std::array<Pose2, kDelays> odometry;
  for (std::size_t i = 0; i < kDelays; ++i) {
    const std::optional<Pose2> then = odometryAt(stamp, i);
    if (!then) return;
    odometry[i] = *then;
  }
  anchor_ =
      Anchor{stamp, pose, taken(belief, lowVariance(weights, kSamples, 0.5)), odometry, false};
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
  anchor_->isDoubtful |= moment.isDoubtful;
  if (!isLonger) compare(moment, recovery, weigh, fit);
  goOn(moment, recovery, weigh, fit);
  if (jumps_.empty() && (moment.isDoubtful || isLonger)) begin(moment, gap, weigh);
  return decide();
}

/// Which delay leads from the last reading to this one.
void Lateness::compare(const Moment& moment, const Recovery& recovery,
                       const PoseSearch::Weigh& weigh, const Fit& fit) {
  if (toSeconds(moment.stamp - anchor_->stamp) < kPiece) return;
  std::array<Pose2, kDelays> motions;
  for (std::size_t i = 0; i < kDelays; ++i) {
    const std::optional<Pose2> now = odometryAt(moment.stamp, i);
    if (!now) return;
    motions[i] = inverse(anchor_->odometry[i]) * *now;
  }
  const auto isApart = [&](const Pose2& m) { return apart(m, motions[inForce_]) >= kIndependent; };
  if (std::none_of(motions.begin(), motions.end(), isApart)) return;
  const Pose2 seen = inverse(anchor_->pose) * moment.pose;
  const auto isNearer = [&](const Pose2& m) {
    return isApart(m) && share(motions[inForce_], m, seen) > kNearer;
  };
  if (!anchor_->isDoubtful && !isOpen() && std::none_of(motions.begin(), motions.end(), isNearer))
    return;
  std::vector<float> logs;
  std::optional<double> ofPresent;
  for (std::size_t i = 0; i < kDelays; ++i) {
    const double difference = apart(motions[i], motions[inForce_]);
    if (i == inForce_ || difference < kApart) continue;
    if (!ofPresent) {
      weigh(moved(anchor_->samples, motions[inForce_], moment), logs);
      ofPresent = logMean(logs);
    }
    SampleSet set = moved(anchor_->samples, motions[i], moment);
    weigh(set, logs);
    const double ratio = logMean(logs) - *ofPresent;
    set.logWeight = logs;
    if (ratio > 0.0 &&
        (apart(seen, motions[i]) > kExplained * difference || !recovery.isUsual(fit(set))))
      continue;
    if (toSeconds(moment.stamp - eventSince_) > kEvent || moment.stamp < eventSince_) {
      eventSince_ = moment.stamp;
      for (Case& one : cases_) one.ofEvent = 0.0;
    }
    count(i, ratio - kToll, std::min(1.0, difference / kIndependent));
  }
}

void Lateness::count(std::size_t delay, double ratio, double part) {
  Case& one = cases_[delay];
  const double before = one.ofEvent;
  one.ofEvent =
      std::clamp(before + part * std::clamp(ratio, -kMostNatsOfAReading, kMostNatsOfAReading),
                 -kMostOfEvent, kMostOfEvent);
  one.nats += one.ofEvent - before;
  one.sharp += part * std::clamp(ratio, -kMostSharp, kMostSharp);
  one.nats = std::max(one.nats, inForce_ == 0 ? 0.0 : kLeastIfLate);
  one.sharp = std::max(one.sharp, inForce_ == 0 ? 0.0 : kLeastSharp);
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
  const Pose2& then = anchor_->odometry[inForce_];
  for (std::size_t i = 0; i < kDelays; ++i) {
    const double grown = secondsOf(i) - secondsOf(inForce_);
    // After a longer silence odometry alone is to blame.
    if (i == inForce_ || grown > gap || gap - std::max(0.0, grown) > kLongGap * usualGap_) continue;
    const std::optional<Pose2> now = odometryAt(moment.stamp, i);
    if (!now) continue;
    const Pose2 change = inverse(then) * *now;
    if (apart(change, inverse(then) * *present) < kPlacesApart) continue;
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
    Change found{jump->samples};
    change(jump->delay);
    return found;
  }
  // To have no delay is the rule.
  if (cases_[0].nats >= kEnoughForNone && cases_[0].sharp >= kEnoughForNone && inForce_ != 0) {
    change(0);
    return Change{};
  }
  const Case* best = nullptr;
  for (std::size_t i = 0; i < kDelays; ++i) {
    const Case& one = cases_[i];
    const bool isNear = i + kFewSteps >= inForce_ && i <= inForce_ + kFewSteps;
    const bool isEnough =
        one.nats >= (inForce_ > 0 && isNear ? kEnoughNear : kEnough) && one.sharp >= one.nats;
    if (isEnough && (best == nullptr || one.sharp > best->sharp)) best = &one;
  }
  if (best == nullptr) return std::nullopt;
  // A larger delay is found wrong later than a smaller one, so of those that do as well the
  // smallest.
  const auto winner = std::find_if(cases_.begin(), cases_.end(),
                                   [&](const Case& one) {
                                     return one.nats >= best->nats - kNearlyEnough &&
                                            one.sharp >= best->sharp - kNearlySharp;
                                   }) -
                      cases_.begin();
  change(static_cast<std::size_t>(winner));
  return Change{};
}

void Lateness::change(std::size_t delay) {
  cases_[inForce_] = {};
  const Case present = cases_[delay];
  for (Case& one : cases_)
    one = {one.nats - present.nats, one.ofEvent - present.ofEvent, one.sharp - present.sharp};
  inForce_ = delay;
  for (Case& one : cases_) {
    one.nats = std::max(one.nats, inForce_ == 0 ? 0.0 : kLeastIfLate);
    one.sharp = std::max(one.sharp, inForce_ == 0 ? 0.0 : kLeastSharp);
  }
  jumps_.clear();
  anchor_.reset();
}

}  // namespace ortung
