#include "Rivals.hpp"

#include <algorithm>
#include <cmath>

#include "Resampling.hpp"

namespace ortung {
namespace {

constexpr double kMostNats = 4.0;     ///< that one reading counts
constexpr double kEnoughNats = 24.0;  ///< for a place to be left
constexpr double kHopelessNats = -12.0;

// Around the estimate.
constexpr double kRing = 0.5;             ///< at first [m]
constexpr double kRingPerSecond = 0.5;    ///< [m/s]: as fast as wheels lie
constexpr double kLargestRing = 3.0;      ///< [m]
constexpr double kTurn = 0.35;            ///< to either side, at first [rad]
constexpr double kTurnPerSecond = 0.35;   ///< [rad/s]
constexpr double kLargestTurn = 1.6;      ///< [rad]
constexpr double kIndependentNear = 0.1;  ///< way after which a reading counts whole [m]
constexpr double kShareTaken = 0.9;       ///< of the belief; the rest stays where it was
constexpr std::size_t kSamplesAround = 400;
constexpr double kCandidatesAround = 10.0;  ///< for each of them

// Elsewhere.
constexpr double kIndependentFar = 0.3;  ///< [m]
constexpr double kWayElsewhere = 2.0;    ///< that readings are spread over, at least [m]
constexpr int kReadingsElsewhere = 8;    ///< at least
constexpr int kPatience = 20;            ///< readings; who is behind then was a chance hit
constexpr std::size_t kSamplesElsewhere = 1000;
constexpr double kCandidatesElsewhere = 50.0;

}  // namespace

void Lead::count(double ratio, double part) {
  nats_ += std::min(1.0, part) * std::clamp(ratio, -kMostNats, kMostNats);
}

void Lead::atLeast(double nats) { nats_ = std::max(nats, nats_); }

bool Lead::isEnough() const { return nats_ >= kEnoughNats; }

bool Lead::isHopeless() const { return nats_ <= kHopelessNats; }

void Rivals::forget() {
  doubtSince_.reset();
  around_ = {};
  elsewhere_.reset();
}

std::optional<Rivals::Takeover> Rivals::follow(const Moment& moment, const Recovery& recovery,
                                               const PoseSearch::Weigh& weigh,
                                               const Random& random) {
  if (auto around = lookAround(moment, recovery, weigh, random.fork(0))) return around;
  return lookElsewhere(moment, recovery, weigh, random.fork(1));
}

std::optional<Rivals::Takeover> Rivals::lookAround(const Moment& moment, const Recovery& recovery,
                                                   const PoseSearch::Weigh& weigh,
                                                   const Random& random) {
  if (!recovery.isDoubtful()) {
    doubtSince_.reset();
    around_ = {};
    return std::nullopt;
  }
  if (!doubtSince_) doubtSince_ = moment.stamp;
  const double seconds = toSeconds(moment.stamp - *doubtSince_);
  const PoseSearch::Ring ring{moment.predicted,
                              std::min(kRing + kRingPerSecond * seconds, kLargestRing),
                              std::min(kTurn + kTurnPerSecond * seconds, kLargestTurn)};
  PoseSearch::Drawn drawn = search_.draw(kSamplesAround, kCandidatesAround, weigh, random, ring);
  around_.count(drawn.logEvidence - moment.logEvidence, moment.way / kIndependentNear);
  around_.atLeast(0.0);
  if (!around_.isEnough()) return std::nullopt;
  around_ = {};
  return Takeover{std::move(drawn.samples), kShareTaken};
}

std::optional<Rivals::Takeover> Rivals::lookElsewhere(const Moment& moment,
                                                      const Recovery& recovery,
                                                      const PoseSearch::Weigh& weigh,
                                                      const Random& random) {
  if (!elsewhere_) {
    // The reading that they are drawn from has chosen them, so it does not count for them.
    if (recovery.callsForSearch())
      elsewhere_.emplace(
          search_.draw(kSamplesElsewhere, kCandidatesElsewhere, weigh, random).samples);
    return std::nullopt;
  }
  Elsewhere& rival = *elsewhere_;
  std::vector<float> logs;
  weigh(rival.samples, logs);
  const double evidence = logMean(normalized(rival.samples.logWeight), logs);
  rival.lead.count(evidence - moment.logEvidence, moment.way / kIndependentFar);
  rival.way += moment.way;
  ++rival.readings;
  for (std::size_t i = 0; i < logs.size(); ++i) rival.samples.logWeight[i] += logs[i];
  if (rival.lead.isEnough() && rival.way >= kWayElsewhere && rival.readings >= kReadingsElsewhere) {
    Takeover takeover{std::move(rival.samples), 1.0};
    forget();
    return takeover;
  }
  if (rival.lead.isHopeless() || (rival.readings > kPatience && rival.lead.nats() < 0.0) ||
      recovery.hasRecovered()) {
    elsewhere_.reset();
    return std::nullopt;
  }
  const std::vector<double> weights = normalized(rival.samples.logWeight);
  if (effectiveSamples(weights) < 0.5 * static_cast<double>(weights.size())) {
    Random offset = random;
    rival.samples = taken(rival.samples, lowVariance(weights, weights.size(), offset.uniform()));
  }
  return std::nullopt;
}

}  // namespace ortung
