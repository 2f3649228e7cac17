#include "Rivals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "BeliefTuning.hpp"
#include "Drift.hpp"
#include "Kld.hpp"
#include "MotionTuning.hpp"
#include "NewReadings.hpp"
#include "Resampling.hpp"
#include "RivalsTuning.hpp"
#include "SearchTuning.hpp"

namespace ortung {
namespace {

using namespace tuning;

/// Mean of samples, and their standard deviation in metres and radians together.
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

/// Returns how well readings fit at a place.
double fitAt(const Pose2& place, const std::vector<const Weigher*>& readings) {
  SampleSet one;
  one.resize(1);
  one.x[0] = static_cast<float>(place.x);
  one.y[0] = static_cast<float>(place.y);
  one.theta[0] = static_cast<float>(place.theta);
  return fitOf(readings, one, std::array{1.0}).value_or(0.0);
}

/// What a search has found.
struct Found {
  int alike = 0;          ///< number of places that explain the readings about as well as the best
  bool isUsual = false;   ///< whether the best one fits as well as usual, and well in itself
  bool isBetter = false;  ///< whether the belief explains them less well
};
Found foundBy(std::span<const FieldSearch::Place> places, const Rivals::Moment& moment,
              const Recovery& recovery) {
  std::vector<const Weigher*> readings;
  for (const auto& reading : moment.readings) readings.push_back(reading.get());
  std::vector<double> fits;
  for (const FieldSearch::Place& place : places) fits.push_back(fitAt(place.pose, readings));
  if (fits.empty()) return {};
  const double enough = elsewhere::kAsWell * fits.front();
  return {static_cast<int>(std::ranges::count_if(fits, [&](double fit) { return fit >= enough; })),
          fits.front() >= elsewhere::kWell && recovery.isUsual(fits.front()), moment.fit < enough};
}

/// Returns whether a hypothesis is at the same place as the belief, so that it is no alternative.
bool isSame(const Pose2& rival, const Pose2& belief) {
  return distance(rival, belief) < hypothesis::kSamePlace &&
         std::abs(wrapAngle(rival.theta - belief.theta)) < hypothesis::kSameTurn;
}

}  // namespace

bool Rivals::Elsewhere::isConfirmed() const {
  return travelled >= hypothesis::kDistance && readings >= elsewhere::kReadings;
}

void Rivals::forget() {
  doubtSince_.reset();
  around_.reset();
  searching_.reset();
  elsewhere_.reset();
  sightings_.forget();
  inVain_ = 0;
}

double Rivals::lead() const {
  return std::max({0.0, around_ ? around_->hypothesis.lead().nats() : 0.0,
                   elsewhere_ ? elsewhere_->hypothesis.lead().nats() : 0.0});
}

std::array<Hypothesis*, 2> Rivals::hypotheses() {
  return {around_ ? &around_->hypothesis : nullptr, elsewhere_ ? &elsewhere_->hypothesis : nullptr};
}

void Rivals::searchOn() {
  if (searching_) searching_->job.work(time_.left());
}

std::optional<Rivals::Takeover> Rivals::follow(const Moment& moment, const Recovery& recovery,
                                               const Evidence& evidence) {
  if (auto around = lookAround(moment, recovery, evidence)) return around;
  return lookElsewhere(moment, recovery, evidence);
}

/// Draws a hypothesis around the estimate. The readings by which it is drawn do not count as
/// evidence for it.
void Rivals::drawAround(const Moment& moment, const Evidence& evidence) {
  const double seconds = toSeconds(moment.stamp - *doubtSince_);
  const PoseSearch::Ring ring{
      moment.predicted,
      std::min(common::kPlaceMetres + around::kRingPerSecond * seconds, around::kLargestRing),
      std::min(common::kPlaceRadians + around::kTurnPerSecond * seconds, around::kLargestTurn)};
  SampleSet drawn = search_
                        .draw(around::kSamples, around::kCandidates, evidence.weigh,
                              Random(config_.seed, moment.stream).fork(0), ring)
                        .samples;
  const Centre centre = centreOf(drawn);
  around_ = Around{Hypothesis(drawn), std::move(drawn), centre.pose, centre.open, moment.stamp};
  around_->trust.lose();
}

std::optional<Rivals::Takeover> Rivals::lookAround(const Moment& moment, const Recovery& recovery,
                                                   const Evidence& evidence) {
  if (!recovery.isDoubtful() && (!around_ || around_->hypothesis.lead().nats() <= 0.0)) {
    doubtSince_.reset();
    around_.reset();
    return std::nullopt;
  }
  // The minimum is for clocks that were set back meanwhile.
  doubtSince_ = std::min(doubtSince_.value_or(moment.stamp), moment.stamp);
  if (!around_) {
    drawAround(moment, evidence);
    return std::nullopt;
  }
  Hypothesis& rival = around_->hypothesis;
  const double ratio = weighAround(moment, evidence);
  const double part = travelledAround(moment) / trust::kIndependent;
  rival.count(ratio, part, recovery.isUsual(evidence.fit(rival.samples())));
  const bool trustsOdometry = !around_->trust.isLost();
  if (rival.lead().isEnough()) {
    Takeover takeover{rival.samples(), around::kShareTaken, trustsOdometry};
    around_.reset();
    return takeover;
  }
  if (isSame(centreOf(rival.samples()).pose, moment.predicted) && trustsOdometry)
    rival.forgetLead();
  if (rival.lead().nats() < hypothesis::kDropped || rival.unusual() >= elsewhere::kMostUnusual)
    drawAround(moment, evidence);
  return std::nullopt;
}

/// Half of the samples follow odometry and half spread by process noise; then both are annealed.
/// @returns what the readings say for them against the belief [nats]
double Rivals::weighAround(const Moment& moment, const Evidence& evidence) {
  Around& rival = *around_;
  const double seconds = driftSeconds(rival.stamp, moment.stamp);
  Spread both = spread(config_, rival.hypothesis.samples(), rival.anchor, {}, seconds,
                       around::kSpread, moment.stream);
  const std::size_t all = both.samples.size();
  rival.hypothesis.setSamples(std::move(both.samples));
  const Hypothesis::Said said = rival.hypothesis.ask(evidence);
  rival.trust.compare(
      said.logEvidenceOf(0, both.drifted) - said.logEvidenceOf(both.drifted, all - both.drifted),
      moment.travelled);
  rival.anchor = Annealing(evidence.weigh, nullptr)
                     .draw(rival.hypothesis.samples(), around::kSamples,
                           Random(config_.seed, moment.stream).fork(1))
                     .samples;
  rival.hypothesis.setSamples(rival.anchor);
  rival.stamp = moment.stamp;
  return said.logEvidenceOf(0, all) - moment.logEvidence;
}

/// Returns the distance travelled: by odometry, or by the readings beyond their uncertainty.
double Rivals::travelledAround(const Moment& moment) {
  Around& rival = *around_;
  const Centre centre = centreOf(rival.anchor);
  const double seen = distance(rival.centre, centre.pose) +
                      std::abs(wrapAngle(centre.pose.theta - rival.centre.theta)) - rival.open -
                      centre.open;
  // By readings alone, a slow robot needs several of them to travel far enough, so the centre is
  // kept.
  if (moment.travelled < trust::kStationary && seen < trust::kIndependent) return 0.0;
  rival.centre = centre.pose;
  rival.open = centre.open;
  return std::max(moment.travelled, seen);
}

std::optional<Rivals::Takeover> Rivals::lookElsewhere(const Moment& moment,
                                                      const Recovery& recovery,
                                                      const Evidence& evidence) {
  // What was found since the last readings is weighed by these already.
  if (searching_ && searching_->job.isDone()) drawElsewhere(moment, recovery);
  std::optional<Takeover> takeover;
  if (elsewhere_) takeover = followElsewhere(moment, recovery, evidence);
  travelledSinceSearch_ += moment.travelled;
  if (!takeover && mayFindBetter()) {
    search(moment, recovery);
    if (elsewhere_) takeover = takeOver(moment);
  }
  return takeover;
}

std::optional<Rivals::Takeover> Rivals::followElsewhere(const Moment& moment,
                                                        const Recovery& recovery,
                                                        const Evidence& evidence) {
  Hypothesis& rival = elsewhere_->hypothesis;
  elsewhere_->before = rival.lead();
  const double ratio = weighElsewhere(moment, evidence);
  const double fit = evidence.fit(rival.samples());
  const double most = fit < elsewhere::kWell ? lead::kMostNatsOfAReading : std::abs(ratio);
  rival.count(std::clamp(ratio, -most, most), moment.travelled / common::kIndependent,
              recovery.isUsual(fit));
  elsewhere_->travelled += moment.travelled;
  ++elsewhere_->readings;
  if (auto takeover = takeOver(moment)) return takeover;
  if (rival.lead().isHopeless() || rival.unusual() >= elsewhere::kMostUnusual ||
      (recovery.hasRecovered() && rival.lead().nats() <= 0.0) ||
      isSame(centreOf(rival.samples()).pose, moment.predicted))
    elsewhere_.reset();
  return std::nullopt;
}

/// Lets the place elsewhere take over if it leads by enough, and is distinct or confirmed.
std::optional<Rivals::Takeover> Rivals::takeOver(const Moment& moment) {
  const Hypothesis& rival = elsewhere_->hypothesis;
  const bool isConfirmed = elsewhere_->isConfirmed();
  if (!rival.lead().isEnough() || !(elsewhere_->isDistinct || isConfirmed)) return std::nullopt;
  // A place that is near was probably reached by motion that odometry did not count.
  const bool isNear =
      distance(centreOf(rival.samples()).pose, moment.predicted) < around::kLargestRing;
  Takeover takeover{rival.samples(), 1.0, !isNear, isConfirmed};
  forget();
  return takeover;
}

/// @returns what the readings say for it against the belief [nats]
double Rivals::weighElsewhere(const Moment& moment, const Evidence& evidence) {
  Hypothesis& rival = elsewhere_->hypothesis;
  const Random random = Random(config_.seed, moment.stream).fork(2);
  const auto climb = [&] {
    return Hypothesis::Climb{rival.samples().size(), elsewhere::kSamples, random.fork(0),
                             random.fork(1)};
  };
  return rival.weigh(evidence, config_, elsewhere::kEffective, climb).logEvidence -
         moment.logEvidence;
}

/// Returns whether a search may find a better place than the one that is followed: not from where
/// the last one was made, and not while readings fit at a distinct place.
bool Rivals::mayFindBetter() const {
  if (!elsewhere_ || searching_) return true;
  const Hypothesis& rival = elsewhere_->hypothesis;
  const bool fits = rival.lead().nats() > 0.0 && rival.unusual() == 0;
  return travelledSinceSearch_ >= trust::kIndependent && !(elsewhere_->isDistinct && fits);
}

/// Begins a search of the field, if the fit of the readings calls for it, and continues it.
void Rivals::search(const Moment& moment, const Recovery& recovery) {
  if (!searching_ && (recovery.callsForSearch() || recovery.unusual() > 0)) {
    FieldSearch::Settings settings;
    settings.workers = &workers_;
    searching_.emplace(Searching{FieldSearch(region_, settings), moment,
                                 elsewhere_ ? elsewhere_->before : Lead()});
    travelledSinceSearch_ = 0.0;
    searching_->job.begin(moment.readings);
  }
  if (!searching_) return;
  searchOn();
  if (searching_->job.isDone()) drawElsewhere(moment, recovery);
}

/// Judges what a search has found.
Rivals::Finding Rivals::judge(const Searching& done, const Recovery& recovery) {
  const std::span<const FieldSearch::Place> places = done.job.places();
  if (places.empty()) return Finding();
  const Found found = foundBy(places, done.moment, recovery);
  if (!found.isUsual) ++inVain_;
  const double most =
      found.isUsual ? mostNatsFor(found.alike * (1 + inVain_)) : lead::kMostNatsOfAReading;
  const double ratio = places.front().logProbability - done.moment.logEvidence;
  if (!found.isBetter) sightings_.forget();
  const double seen = found.alike == 1 && found.isBetter
                          ? sightings_.see(places.front().pose, ratio, done.moment.odometry)
                          : 0.0;
  const bool isSeenAgain = seen >= lead::kEnoughNats;
  Finding finding{Lead(most), isSeenAgain || 2.0 * most >= lead::kEnoughNats};
  if (finding.isDistinct) finding.lead.count(ratio, 1.0);
  if (isSeenAgain) finding.lead.atLeast(seen);
  return finding;
}

/// Draws a hypothesis around the places found. The readings of the search count as evidence for it
/// only if hardly any other place explains them, or another search has found it before: otherwise
/// they have merely selected it. One that is followed is replaced only by such a place. In a crowd
/// readings fit nowhere, one after the other, so that each further search is one more chance to
/// find a wrong place.
void Rivals::drawElsewhere(const Moment& moment, const Recovery& recovery) {
  const Searching done = std::move(*searching_);
  searching_.reset();
  Finding finding = judge(done, recovery);
  const std::span<const FieldSearch::Place> places = done.job.places();
  std::vector<PoseSearch::Ring> rings;
  for (const FieldSearch::Place& place : places) {
    if (place.logProbability > places.front().logProbability + lead::kHopelessNats)
      rings.push_back({place.pose, common::kPlaceRadius, places::kTurn});
  }
  if (rings.empty() || (!finding.isDistinct && (elsewhere_ || !recovery.callsForSearch()))) return;
  Hypothesis drawn(drawnFrom(rings, done.moment));
  carryOn(drawn, done.moment, moment);
  const Pose2 there = centreOf(drawn.samples()).pose;
  if (isSame(there, moment.predicted)) return;
  // The search's readings counted for the one that is followed, too, and count once.
  if (elsewhere_ && isSame(centreOf(elsewhere_->hypothesis.samples()).pose, there))
    finding.lead.add(done.before);
  elsewhere_.emplace(Elsewhere{Hypothesis(drawn.samples(), finding.lead), finding.isDistinct});
}

SampleSet Rivals::drawnFrom(const std::vector<PoseSearch::Ring>& rings, const Moment& then) const {
  std::vector<NewReading> news;
  for (const auto& reading : then.readings) news.push_back({nullptr, 0, reading});
  const auto weigh = [&](const SampleSet& set, std::vector<float>& out) {
    ortung::weigh(news, set, &workers_, out);
  };
  return search_
      .drawFrom(rings, elsewhere::kSamples, static_cast<double>(field::kCandidates), weigh,
                Random(config_.seed, then.stream).fork(2))
      .samples;
}

/// Moves a hypothesis from the time of the search's readings to the present one.
void Rivals::carryOn(Hypothesis& drawn, const Moment& then, const Moment& now) const {
  drawn.move(0, [&](const MovableSamples& some, std::size_t first) {
    if (then.odometry && now.odometry)
      motion_.sampleMotion(some, inverse(*then.odometry) * *now.odometry, config_.seed, now.stream,
                           first);
    else
      drift(config_, some, {}, driftSeconds(then.stamp, now.stamp), now.stream, first);
  });
}

}  // namespace ortung
