// Hypotheses around the estimate, and what both kinds have in common.
#include "Rivals.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "BeliefTuning.hpp"
#include "Centre.hpp"
#include "Drift.hpp"
#include "MotionTuning.hpp"
#include "NominalTime.hpp"
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

namespace {

/// Candidates of a drawing around the estimate.
const double kDrawn = around::kCandidates * static_cast<double>(around::kSamples);
/// Samples that follow odometry or spread: they are weighed, and once more when they are annealed.
const double kWeighed = 4.0 * static_cast<double>(around::kSpread);

double nanosecondsOf(const Rivals::Moment& moment) {
  double sum = 0.0;
  for (const auto& reading : moment.readings) sum += nominalNanoseconds(*reading);
  return sum;
}

}  // namespace

double Rivals::timeOf(double poses, const Moment& moment) const {
  return time_.timeOfPoses(poses, nanosecondsOf(moment));
}

double Rivals::shareInTime(double poses, double least, const Moment& moment) const {
  const auto inTime = static_cast<double>(time_.posesInTime(nanosecondsOf(moment)));
  return std::clamp(inTime / poses, least, 1.0);
}

void Rivals::searchOn() {
  if (!isSearching()) return;
  const UpdateTime::Step begins(time_, Work::kSearching, time_.timeOf(Work::kSearching));
  if (begins) searching_->job.work(time_.left(), time_.endOf(Work::kSearching));
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
  const double candidates = around::kCandidates * shareInTime(kDrawn, around::kLeastShare, moment);
  SampleSet drawn =
      search_
          .draw(around::kSamples, candidates, evidence.weigh,
                Random(config_.seed, moment.stream).fork(0), ring, time_.endOf(Work::kAnnealing))
          .samples;
  const Centre centre = centreOf(drawn);
  around_ = Around{Hypothesis(drawn), std::move(drawn), centre.pose, centre.open, moment.stamp};
  around_->trust.lose();
}

/// Where there is no time, the readings say nothing for the hypotheses, nor against them; here and
/// for those elsewhere.
std::optional<Rivals::Takeover> Rivals::lookAround(const Moment& moment, const Recovery& recovery,
                                                   const Evidence& evidence) {
  if (!recovery.isDoubtful() && (!around_ || around_->hypothesis.lead().nats() <= 0.0)) {
    doubtSince_.reset();
    around_.reset();
    return std::nullopt;
  }
  // The minimum is for clocks that were set back meanwhile.
  doubtSince_ = std::min(doubtSince_.value_or(moment.stamp), moment.stamp);
  const double poses = around::kLeastShare * (around_ ? kWeighed : kDrawn);
  if (around_) around_->waited += moment.travelled;
  const UpdateTime::Step begins(time_, Work::kAround, timeOf(poses, moment));
  if (!begins) return std::nullopt;
  if (!around_) {
    drawAround(moment, evidence);
    return std::nullopt;
  }
  Hypothesis& rival = around_->hypothesis;
  const double ratio = weighAround(moment, evidence);
  const double part = travelledAround() / trust::kIndependent;
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
  if (rival.lead().nats() < hypothesis::kDropped || rival.unusual() >= elsewhere::kMostUnusual) {
    if (time_.isTimeFor(timeOf(around::kLeastShare * kDrawn, moment)))
      drawAround(moment, evidence);
    else
      around_.reset();
  }
  return std::nullopt;
}

/// Half of the samples follow odometry and half spread by process noise; then both are annealed.
/// @returns what the readings say for them against the belief [nats]
double Rivals::weighAround(const Moment& moment, const Evidence& evidence) {
  Around& rival = *around_;
  const double seconds = driftSeconds(rival.stamp, moment.stamp);
  const auto n = static_cast<std::size_t>(shareInTime(kWeighed, around::kLeastShare, moment) *
                                          static_cast<double>(around::kSpread));
  Spread both =
      spread(config_, rival.hypothesis.samples(), rival.anchor, {}, seconds, n, moment.stream);
  const std::size_t all = both.samples.size();
  rival.hypothesis.setSamples(std::move(both.samples));
  const Hypothesis::Said said = rival.hypothesis.ask(evidence);
  rival.trust.compare(
      said.logEvidenceOf(0, both.drifted) - said.logEvidenceOf(both.drifted, all - both.drifted),
      rival.waited);
  rival.anchor =
      Annealing(evidence.weigh, nullptr)
          .draw(rival.hypothesis.samples(), around::kSamples,
                Random(config_.seed, moment.stream).fork(1), time_.endOf(Work::kAnnealing))
          .samples;
  rival.hypothesis.setSamples(rival.anchor);
  rival.stamp = moment.stamp;
  return said.logEvidenceOf(0, all) - moment.logEvidence;
}

/// Returns the distance travelled: by odometry, or by the readings beyond their uncertainty.
double Rivals::travelledAround() {
  Around& rival = *around_;
  const double waited = std::exchange(rival.waited, 0.0);
  const Centre centre = centreOf(rival.anchor);
  const double seen = apart(rival.centre, centre.pose) - rival.open - centre.open;
  // By readings alone, a slow robot needs several of them to travel far enough, so the centre is
  // kept.
  if (waited < trust::kStationary && seen < trust::kIndependent) return 0.0;
  rival.centre = centre.pose;
  rival.open = centre.open;
  return std::max(waited, seen);
}

}  // namespace ortung
