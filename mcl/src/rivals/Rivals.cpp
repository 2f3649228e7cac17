#include "Rivals.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "Drift.hpp"
#include "Kld.hpp"
#include "News.hpp"
#include "Resampling.hpp"

namespace ortung {
namespace {

// Around the estimate.
constexpr double kRing = 0.5;             ///< at first [m]
constexpr double kRingPerSecond = 1.5;    ///< [m/s]: as fast as wheels lie
constexpr double kLargestRing = 3.0;      ///< [m]
constexpr double kTurn = 0.35;            ///< to either side, at first [rad]
constexpr double kTurnPerSecond = 0.35;   ///< [rad/s]
constexpr double kLargestTurn = 1.6;      ///< [rad]
constexpr double kIndependentNear = 0.1;  ///< way after which a reading counts whole [m]
constexpr double kSamePlace = 0.3;        ///< from the belief: no rival [m]
constexpr double kSameTurn = 0.2;         ///< [rad]
constexpr double kShareTaken = 0.9;       ///< of the belief; the rest stays where it was
constexpr std::size_t kSamplesAround = 400;
constexpr std::size_t kSpreadAround = 1000;  ///< that follow odometry, and as many that drift
constexpr double kDroppedAround = -2.0;      ///< [nats]: then they are drawn anew
constexpr double kCandidatesAround = 10.0;   ///< for each of them

// Elsewhere.
constexpr double kIndependentFar = 0.3;  ///< [m]
constexpr double kWayElsewhere = 1.0;    ///< that readings are spread over, at least [m]
constexpr int kReadingsElsewhere = 5;    ///< at least
constexpr int kMostUnusual = 4;          ///< readings on end that fit badly: it was a chance hit
constexpr std::size_t kSamplesElsewhere = 1000;
constexpr double kCandidatesElsewhere = 4.0;   ///< for each of them, around what a search has found
constexpr double kEffectiveElsewhere = 100.0;  ///< samples
constexpr double kSearchNats = 12.0;           ///< places that fit so much worse are none
constexpr double kSearchRing = 0.25;           ///< around a place [m]
constexpr double kSearchTurn = 0.17;           ///< [rad]

/// Mean of samples, and by how much they are apart: metres and radians alike.
struct Centre {
  Pose2 pose;
  double open = 0.0;
};
Centre centreOf(const SampleSet& set) {
  const std::vector<double> weights = normalized(set.logWeight);
  double x = 0.0;
  double y = 0.0;
  double c = 0.0;
  double s = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    x += weights[i] * static_cast<double>(set.x[i]);
    y += weights[i] * static_cast<double>(set.y[i]);
    c += weights[i] * std::cos(static_cast<double>(set.theta[i]));
    s += weights[i] * std::sin(static_cast<double>(set.theta[i]));
  }
  Centre centre{{x, y, std::atan2(s, c)}, 0.0};
  double squares = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double dx = static_cast<double>(set.x[i]) - x;
    const double dy = static_cast<double>(set.y[i]) - y;
    const double turn = wrapAngle(static_cast<double>(set.theta[i]) - centre.pose.theta);
    squares += weights[i] * (dx * dx + dy * dy + turn * turn);
  }
  centre.open = std::sqrt(squares);
  return centre;
}

/// Whether a rival is where the belief is, so that it is none.
bool isSame(const Pose2& rival, const Pose2& belief) {
  return distance(rival, belief) < kSamePlace &&
         std::abs(wrapAngle(rival.theta - belief.theta)) < kSameTurn;
}

}  // namespace

void Rivals::forget() {
  doubtSince_.reset();
  around_.reset();
  searching_.reset();
  elsewhere_.reset();
}

double Rivals::lead() const {
  return std::max(
      {0.0, around_ ? around_->lead.nats() : 0.0, elsewhere_ ? elsewhere_->lead.nats() : 0.0});
}

std::array<SampleSet*, 2> Rivals::samples() {
  return {around_ ? &around_->samples : nullptr, elsewhere_ ? &elsewhere_->samples : nullptr};
}

void Rivals::searchOn() {
  if (searching_) searching_->job.work(time_.left());
}

std::optional<Rivals::Takeover> Rivals::follow(const Moment& moment, const Recovery& recovery,
                                               const PoseSearch::Weigh& weigh, const Fit& fit) {
  if (auto around = lookAround(moment, recovery, weigh, fit)) return around;
  return lookElsewhere(moment, recovery, weigh, fit);
}

/// The reading that they are drawn from has chosen them, so it does not count for them.
void Rivals::drawAround(const Moment& moment, const PoseSearch::Weigh& weigh) {
  const double seconds = toSeconds(moment.stamp - *doubtSince_);
  const PoseSearch::Ring ring{moment.predicted,
                              std::min(kRing + kRingPerSecond * seconds, kLargestRing),
                              std::min(kTurn + kTurnPerSecond * seconds, kLargestTurn)};
  SampleSet drawn = search_
                        .draw(kSamplesAround, kCandidatesAround, weigh,
                              Random(config_.seed, moment.stream).fork(0), ring)
                        .samples;
  const Centre centre = centreOf(drawn);
  around_ = Around{drawn, drawn, centre.pose, centre.open, moment.stamp};
  around_->trust.lose();
}

std::optional<Rivals::Takeover> Rivals::lookAround(const Moment& moment, const Recovery& recovery,
                                                   const PoseSearch::Weigh& weigh, const Fit& fit) {
  if (!recovery.isDoubtful() && (!around_ || around_->lead.nats() <= 0.0)) {
    doubtSince_.reset();
    around_.reset();
    return std::nullopt;
  }
  // Since now, too, if the clock was set back meanwhile.
  doubtSince_ = std::min(doubtSince_.value_or(moment.stamp), moment.stamp);
  if (!around_) {
    drawAround(moment, weigh);
    return std::nullopt;
  }
  Around& rival = *around_;
  const double seconds = driftSeconds(rival.stamp, moment.stamp);
  Spread both =
      spread(config_, rival.samples, rival.anchor, {}, seconds, kSpreadAround, moment.stream);
  std::vector<float> logs;
  weigh(both.samples, logs);
  const std::vector<double> before = normalized(both.samples.logWeight);
  const double ratio = logMeanOfPart(before, logs, 0, logs.size()) - moment.logEvidence;
  const double trust = logMeanOfPart(before, logs, 0, both.drifted) -
                       logMeanOfPart(before, logs, both.drifted, logs.size() - both.drifted);
  rival.trust.compare(trust, moment.way);
  rival.samples = Annealing(weigh, nullptr)
                      .draw(std::move(both.samples), kSamplesAround,
                            Random(config_.seed, moment.stream).fork(1))
                      .samples;
  rival.anchor = rival.samples;
  rival.stamp = moment.stamp;
  // The way is what odometry says of it, or the readings beyond what they leave open.
  const Centre centre = centreOf(rival.samples);
  const double seen = distance(rival.centre, centre.pose) +
                      std::abs(wrapAngle(centre.pose.theta - rival.centre.theta)) - rival.open -
                      centre.open;
  // By the readings alone, a slow robot comes far enough in some of them.
  const bool stands = moment.way < kStands;
  const double part = stands && seen < kIndependentNear ? 0.0 : std::max(moment.way, seen);
  if (!stands || part > 0.0) {
    rival.centre = centre.pose;
    rival.open = centre.open;
  }
  const bool isUsual = recovery.isUsual(fit(rival.samples));
  rival.unusual = isUsual ? 0 : rival.unusual + 1;
  if (ratio < 0.0 || isUsual) rival.lead.count(ratio, part / kIndependentNear);
  if (rival.lead.isEnough()) {
    Takeover takeover{std::move(rival.samples), kShareTaken, !rival.trust.isLost()};
    around_.reset();
    return takeover;
  }
  if (isSame(centre.pose, moment.predicted) && !rival.trust.isLost()) rival.lead = {};
  if (rival.lead.nats() < kDroppedAround || rival.unusual >= kMostUnusual)
    drawAround(moment, weigh);
  return std::nullopt;
}

/// The reading that was searched for has chosen its places, so it does not count for them.
void Rivals::goOnSearching(const Moment& moment) {
  searchOn();
  const FieldSearch& job = searching_->job;
  if (!job.isDone()) return;
  const Moment then = std::move(searching_->moment);
  std::vector<PoseSearch::Ring> rings;
  for (const FieldSearch::Place& place : job.places()) {
    if (place.logProbability > job.places().front().logProbability - kSearchNats)
      rings.push_back({place.pose, kSearchRing, kSearchTurn});
  }
  searching_.reset();
  if (rings.empty()) return;
  std::vector<News> news;
  for (const auto& reading : then.readings) news.push_back({nullptr, 0, reading});
  const auto weigh = [&](const SampleSet& set, std::vector<float>& out) {
    ortung::weigh(news, set, &workers_, out);
  };
  SampleSet found = search_
                        .drawFrom(rings, kSamplesElsewhere, kCandidatesElsewhere, weigh,
                                  Random(config_.seed, then.stream).fork(2))
                        .samples;
  if (then.odometry && moment.odometry) {
    motion_.sampleMotion({found.x, found.y, found.theta},
                         inverse(*then.odometry) * *moment.odometry, config_.seed, moment.stream,
                         0);
  } else {
    drift(config_, {found.x, found.y, found.theta}, {}, driftSeconds(then.stamp, moment.stamp),
          moment.stream, 0);
  }
  elsewhere_.emplace(std::move(found));
}

std::optional<Rivals::Takeover> Rivals::lookElsewhere(const Moment& moment,
                                                      const Recovery& recovery,
                                                      const PoseSearch::Weigh& weigh,
                                                      const Fit& fit) {
  const Random random = Random(config_.seed, moment.stream).fork(2);
  if (!elsewhere_) {
    if (!searching_ && recovery.callsForSearch()) {
      FieldSearch::Settings settings;
      settings.workers = &workers_;
      searching_.emplace(Searching{FieldSearch(region_, settings), moment});
      searching_->job.begin(moment.readings);
    }
    if (searching_) goOnSearching(moment);
    return std::nullopt;
  }
  Elsewhere& rival = *elsewhere_;
  std::vector<float> logs;
  weigh(rival.samples, logs);
  const std::vector<double> before = normalized(rival.samples.logWeight);
  const double ratio = logMean(before, logs) - moment.logEvidence;
  for (std::size_t i = 0; i < logs.size(); ++i) rival.samples.logWeight[i] += logs[i];
  const std::vector<double> weights = normalized(rival.samples.logWeight);
  if (effectiveSamples(weights) < kEffectiveElsewhere) {
    // Where nobody is left at the top of the hill, they climb.
    Random offset = random.fork(0);
    rival.samples =
        Annealing(weigh, estimateOf(config_, rival.samples.view(), before).covariance, logs.size())
            .draw(taken(rival.samples, lowVariance(before, logs.size(), offset.uniform())),
                  kSamplesElsewhere, random.fork(1))
            .samples;
  }
  const bool isUsual = recovery.isUsual(fit(rival.samples));
  rival.unusual = isUsual ? 0 : rival.unusual + 1;
  if (ratio < 0.0 || isUsual) rival.lead.count(ratio, moment.way / kIndependentFar);
  rival.way += moment.way;
  ++rival.readings;
  if (rival.lead.isEnough() && rival.way >= kWayElsewhere && rival.readings >= kReadingsElsewhere) {
    Takeover takeover{std::move(rival.samples), 1.0, true};
    forget();
    return takeover;
  }
  if (rival.lead.isHopeless() || rival.unusual >= kMostUnusual ||
      (recovery.hasRecovered() && rival.lead.nats() <= 0.0) ||
      isSame(centreOf(rival.samples).pose, moment.predicted)) {
    elsewhere_.reset();
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace ortung
