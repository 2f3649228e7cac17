// Hypotheses around the estimate, and what both kinds have in common.
#include "Rivals.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "BeliefTuning.hpp"
#include "Centre.hpp"
#include "Drift.hpp"
#include "MotionTuning.hpp"
#include "RivalsTuning.hpp"

namespace ortung {

using namespace tuning;

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
    Takeover takeover{rival.samples(), around::kShareTaken,
                      trustsOdometry ? Odometry::kRight : Odometry::kWrong};
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
  const double seen = apart(rival.centre, centre.pose) - rival.open - centre.open;
  // By readings alone, a slow robot needs several of them to travel far enough, so the centre is
  // kept.
  if (moment.travelled < trust::kStationary && seen < trust::kIndependent) return 0.0;
  rival.centre = centre.pose;
  rival.open = centre.open;
  return std::max(moment.travelled, seen);
}

}  // namespace ortung
