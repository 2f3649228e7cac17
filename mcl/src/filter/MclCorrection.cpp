// The second half of an update: weigh the samples (eq. 7), let the best hypothesis lead, estimate,
// resample.
#include <algorithm>
#include <cmath>
#include <utility>

#include "Annealing.hpp"
#include "BeliefTuning.hpp"
#include "FilterTuning.hpp"
#include "MclImpl.hpp"
#include "MotionTuning.hpp"
#include "Reach.hpp"
#include "Resampling.hpp"
#include "RivalsTuning.hpp"

namespace ortung {
namespace {

using namespace tuning::correction;

std::vector<const Weigher*> readingsOf(const std::vector<NewReading>& news) {
  std::vector<const Weigher*> readings;
  for (const NewReading& one : news) readings.push_back(one.weigher.get());
  return readings;
}

/// Returns whether the place is known well enough to say which beams meet what has changed. A fit
/// that is worse than usual does not matter: what has changed is the reason, or may be.
bool knowsPlace(const PoseEstimate& estimate) {
  return estimate.status == TrackStatus::kTracking ||
         (estimate.status == TrackStatus::kUncertain && estimate.reason == TrackReason::kPoorFit);
}

}  // namespace

/// Moves and corrects the belief for one time step. While the place is known, beams that meet what
/// has changed in the world say nothing about it.
void Mcl::Impl::correctAt(Timestamp stamp, const std::vector<NewReading>& news) {
  const UpdateTime::Measured moment(tools.time, Work::kMoment, sizeOfMoment(news));
  const std::uint32_t relocalizations = estimate.relocalizations;
  std::optional<std::vector<NewReading>> unchanged;
  if (track->isKnown()) {
    const Pose2 expected = presentAt(stamp).pose;
    steps.expect(expected);
    if (tools.config.watchesMap && map.isSure() && knowsPlace(estimate))
      unchanged =
          map.withoutChanged(news, delay() == 0 ? expected : presentAt(stamp - delay()).pose);
  }
  ++step;
  correct(unchanged ? *unchanged : news, predict(stamp));
  if (tools.config.watchesMap) watchMap(news, relocalizations);
}

/// Returns the nominal time of a time step's readings, without what can wait [ms].
double Mcl::Impl::sizeOfMoment(const std::vector<NewReading>& news) const {
  const double each = nanosecondsOf(news) + tuning::budget::kPoseNanoseconds;
  return 1e-6 * each * UpdateTime::sizeOf(track->belief.samples().size());
}

/// Looks where the readings that have weighed the belief contradict the map.
/// @param relocalizations number of them before the update
void Mcl::Impl::watchMap(const std::vector<NewReading>& news, std::uint32_t relocalizations) {
  if (relocalizations != estimate.relocalizations &&
      estimate.relocalization == Relocalization::kOtherPlace)
    map.forgetPass();
  const UpdateTime::Step begins(tools.time, Work::kMap, tools.time.timeOf(Work::kMap));
  if (!begins) return;
  const UpdateTime::Measured look(tools.time, Work::kMap, 1.0);
  PoseEstimate then = track->present.value_or(estimate);  // the pose when they were read
  then.status = estimate.status;
  map.follow(news, then);
}

/// Corrects the belief by one time step's readings (paper, section 5.2).
void Mcl::Impl::correct(const std::vector<NewReading>& news, Predicted predicted) {
  Weighed weighed = weigh(news, predicted);
  Led led = letBestLead(std::move(weighed));
  resample(estimateFrom(std::move(led)));
}

/// @param news borrowed
Moment Mcl::Impl::momentOf(const std::vector<NewReading>& news, Timestamp stamp) {
  const auto weighAll = [this, &news, each = nanosecondsOf(news)](const SampleSet& set,
                                                                  std::vector<float>& out) {
    tools.time.spend(each * static_cast<double>(set.size()));
    ortung::weigh(news, set, &tools.workers, out);
  };
  const auto fit = [&news](const SampleSet& set) {
    return fitOf(readingsOf(news), set, normalized(set.logWeight)).value_or(0.0);
  };
  return {stamp, &news, {weighAll, fit}};
}

/// Asks the readings about the belief. If the time is over before all samples are weighed, the
/// others are left out.
/// @param predicted follows the samples that are left out
Hypothesis::Said Mcl::Impl::ask(const Moment& moment, Predicted& predicted) {
  Hypothesis& belief = track->belief;
  if (!tools.time.isKept()) return belief.ask(moment.evidence, &tools.workers);
  const std::size_t had = belief.samples().size();
  const double each = nanosecondsOf(*moment.news);
  tools.time.follows(Work::kClusters, had);
  const double slice = 1e-6 * static_cast<double>(kTimedPoses * tools.config.threads) * each;
  std::vector<float> logs;
  const Parts spread = weighUntil(tools.time.endOfWeighing(slice), *moment.news, belief.samples(),
                                  tools.workers, tools.config.threads, logs);
  if (spread.weighed < spread.all) {
    const auto left = [&](std::size_t i) { return !spread.has(i); };
    const std::size_t drifted = predicted.drifted;
    for (std::size_t i = 0; i < drifted; ++i)
      if (left(i)) --predicted.drifted;
    belief.leaveOut(left, logs);
  }
  const std::size_t weighed = belief.samples().size();
  tools.time.spend(each * static_cast<double>(weighed));
  tools.time.follows(Work::kClusters, weighed);
  tools.limit.weighed(weighed, weighed == had);
  return belief.said(std::move(logs), &tools.workers);
}

/// Weighs the belief, and follows how well the readings fit it.
Weighed Mcl::Impl::weigh(const std::vector<NewReading>& news, Predicted predicted) {
  Moment moment = momentOf(news, predicted.stamp);
  Hypothesis::Said said = ask(moment, predicted);
  if (track->isBlind)
    track->recovery.followBlindly();
  else if (const auto fit = fitOfBelief(moment, said.before, said.logs))
    track->recovery.follow(*fit, track->travelled.all < tuning::trust::kStationary);
  std::optional<Rivals::Moment> compared = competition(moment, said);
  const double logEvidence = said.logEvidence;
  std::vector<double> weights =
      predicted.drifted > 0 ? takeInUnsure(moment, std::exchange(said, {}), predicted.drifted)
                            : takeIn(moment, said);
  const double fit = fitOfBelief(moment, weights, said.logs).value_or(0.0);
  track->recovery.followBest(fit,
                             std::min(1.0, track->travelled.all / tuning::common::kIndependent));
  if (compared) compared->fit = fit;
  track->confirmation.count(track->recovery.unusual() == 0, track->travelled.metres);
  tools.time.follows(Work::kClusters, weights.size());
  return {std::move(moment), std::move(weights), std::move(compared), logEvidence};
}

/// @param logs ln p of the belief's samples, as far as it is known
std::optional<double> Mcl::Impl::fitOfBelief(const Moment& moment,
                                             const std::vector<double>& weights,
                                             const std::vector<float>& logs) {
  return fitOf(readingsOf(*moment.news), track->belief.samples(), weights, &tools.workers, logs);
}

/// Returns what alternatives are compared with, if readings fit the belief badly or there are
/// alternatives already.
std::optional<Rivals::Moment> Mcl::Impl::competition(const Moment& moment,
                                                     const Hypothesis::Said& said) {
  if (!track->recovery.isDoubtful() && !track->recovery.callsForSearch() && track->rivals.isIdle())
    return std::nullopt;
  Rivals::Moment compared{
      moment.stamp,
      estimateOf(tools.config, track->belief.samples().view(), said.before).pose,
      said.logEvidence,
      0.0,
      track->travelled.all,
      stream(Purpose::kRivals),
      reached.odometry,
      {}};
  for (const NewReading& one : *moment.news) compared.readings.push_back(one.weigher);
  return compared;
}

/// Weighs the belief's samples. @returns their weights
std::vector<double> Mcl::Impl::takeIn(const Moment& moment, Hypothesis::Said& said) {
  return track->belief.takeIn(
      said, moment.evidence, tools.config, tools.config.resampleBelow > 0.0 ? kFewLeft : 0.0,
      [&] { return climbFor(*moment.news, said.before.size()); }, &tools.workers);
}

/// Weighs the samples while odometry is not trusted, and compares those that it moved with those
/// that process noise moved. The latter count only if the readings fit there as well as usual: in a
/// crowd nothing fits, and a place that fits a little less badly is no better.
/// @param drifted samples from this one on were moved by process noise
std::vector<double> Mcl::Impl::takeInUnsure(const Moment& moment, Hypothesis::Said said,
                                            std::size_t drifted) {
  Hypothesis& belief = track->belief;
  const double ratio = said.logEvidenceOf(drifted, belief.samples().size() - drifted) -
                       said.logEvidenceOf(0, drifted);
  track->trust.compare(-ratio, track->travelled.all);
  const SampleSet near = annealedOf(belief.samples().from(drifted), said, moment);
  belief.keepFirst(drifted);
  said.logs.resize(drifted);
  said.before = belief.weights();
  takeIn(moment, said);
  if (track->recovery.isUsual(moment.evidence.fit(near)))
    belief.add(near, 1.0 / (1.0 + std::exp(-ratio)));
  return belief.weights(&tools.workers);
}

/// Anneals the samples that process noise moved. Without time for that they are weighed.
/// @param samples the last ones of the belief
SampleSet Mcl::Impl::annealedOf(SampleSet samples, const Hypothesis::Said& said,
                                const Moment& moment) {
  const UpdateTime::Step begins(
      tools.time, Work::kUnsure,
      tools.time.timeOfPoses(static_cast<double>(samples.size()), nanosecondsOf(*moment.news)));
  if (!begins) {
    const std::size_t first = said.logs.size() - samples.size();
    for (std::size_t i = 0; i < samples.size(); ++i) samples.logWeight[i] += said.logs[first + i];
    return samples;
  }
  return Annealing(moment.evidence.weigh, nullptr)
      .draw(std::move(samples), tools.config.minSamples, random(Purpose::kSpread),
            tools.time.endOf(Work::kAnnealing))
      .samples;
}

/// Says how readings are annealed that are far sharper than the belief. Otherwise hardly any sample
/// would be left, and none of them at the peak of the likelihood.
/// @param had number of samples before they were weighed
Hypothesis::Climb Mcl::Impl::climbFor(const std::vector<NewReading>& news, std::size_t had) {
  const MclConfig& config = tools.config;
  // After a long distance without readings the samples may have to cover many places.
  const std::size_t wanted =
      std::max(had, kldSamples(config, PoseBins(config, track->belief.samples().view()).count()));
  const double affordable = 1e6 * tools.time.left() / (kTimesWeighed * nanosecondsOf(news));
  const std::size_t nominal =
      std::min(config.maxSamples,
               std::max(2 * config.minSamples,
                        std::min(wanted, static_cast<std::size_t>(std::min(affordable, 1e9)))));
  const std::size_t n =
      std::min(nominal, std::max(config.minSamples, tools.time.posesInTime(nanosecondsOf(news))));
  const Random climb = random(Purpose::kSpread);
  return {n,
          std::max(config.minSamples, n / 4),
          climb.fork(1),
          climb,
          !track->isBlind,
          tools.time.endOf(Work::kAnnealing)};
}

/// Lets the hypothesis of another place or delay replace the belief, or a part of it, if it has
/// explained readings far better.
Led Mcl::Impl::letBestLead(Weighed weighed) {
  if (letRivalLead(weighed)) weighed.weights = track->belief.weights(&tools.workers);
  Led led = ledBy(weighed.moment, std::move(weighed.weights));
  if (!letDelayLead(led, weighed)) return led;
  return ledBy(std::move(weighed.moment), track->belief.weights(&tools.workers));
}

Led Mcl::Impl::ledBy(Moment moment, std::vector<double> weights) {
  const SampleView samples = track->belief.samples().view();
  const UpdateTime::Measured clusters(tools.time, Work::kClusters,
                                      UpdateTime::sizeOf(samples.size()));
  PoseBins bins(tools.config, samples, &tools.workers);
  const PoseEstimate its = estimateOf(bins, samples, weights, &tools.workers);
  return {std::move(moment), std::move(weights), std::move(bins), its};
}

/// @returns whether another place has replaced the belief, or a part of it
bool Mcl::Impl::letRivalLead(const Weighed& weighed) {
  if (!weighed.compared) {
    track->rivals.forget();
    return false;
  }
  auto takeover = track->rivals.follow(*weighed.compared, track->recovery, weighed.moment.evidence);
  if (!takeover) return false;
  if (takeover->share < 1.0) {
    track->belief.add(takeover->samples, takeover->share);
  } else {
    track->belief.setSamples(std::move(takeover->samples));
    track->recovery.beginAnew();
    takeover->isConfirmed ? track->confirmation.forget() : track->confirmation.begin();
  }
  steps.because(Relocalization::kOtherPlace);
  if (takeover->odometry == Rivals::Odometry::kRight) track->trust.forget();
  if (takeover->odometry == Rivals::Odometry::kWrong) track->trust.lose();
  return true;
}

/// @returns whether another delay of the readings is in force now
bool Mcl::Impl::letDelayLead(const Led& led, const Weighed& weighed) {
  const Timestamp stamp = weighed.moment.stamp;
  const Lateness::Moment moment{
      stamp,        weighed.logEvidence,      weighed.compared || track->trust.isLost(),
      led.estimate, stream(Purpose::kRivals), tools.time.endOf(Work::kAnnealing)};
  const auto poses = static_cast<double>(parts.lateness.posesFor(moment));
  // If it leads, clusters follow once more.
  const UpdateTime::Step begins(tools.time, Work::kDelays,
                                tools.time.timeOf(Work::kDelays) +
                                    tools.time.timeOfPoses(poses, nanosecondsOf(*led.moment.news)));
  if (!begins) return false;
  const UpdateTime::Measured rest(tools.time, Work::kDelays, poses > 0.0 ? 0.0 : 1.0);
  auto change = parts.lateness.follow(moment, track->recovery, weighed.moment.evidence);
  if (!change) return false;
  if (change->samples) {
    track->belief.setSamples(std::move(*change->samples));
    track->recovery.beginAnew();
  }
  steps.because(Relocalization::kDelay);
  reached.odometry = parts.lateness.odometryAt(stamp);
  track->trust.forget();
  track->rivals.forget();
  return true;
}

/// Computes the estimate of the heaviest cluster, refines it, and judges how far it can be trusted.
Estimated Mcl::Impl::estimateFrom(Led led) {
  const Timestamp stamp = led.moment.stamp;
  const std::vector<NewReading>& news = *led.moment.news;
  const std::size_t samples = led.weights.size();
  tools.time.follows(Work::kLookalikes, samples);
  lookElsewhere(led);
  tools.time.follows(Work::kEstimate, samples);
  track->travelled = {};
  estimateRoughly(led);
  refine(news, samples);
  const UpdateTime::Measured closing(tools.time, Work::kClosing, UpdateTime::sizeOf(samples));
  parts.separation.follow(estimate);
  track->present = estimate;
  if (parts.lateness.seconds() > 0.0) estimate = atStamp(estimate, stamp);
  estimate = parts.lateness.widened(estimate, stamp);
  track->others = othersOf(led);
  judge(signsAt(stamp), estimate);
  steps.follow(estimate.pose, stamp);
  steps.apply(estimate);
  if (tools.config.learnsBiases) parts.biases.follow(news, estimate);
  return {std::move(led.weights), std::move(led.bins)};
}

/// Takes the estimate of the samples alone.
void Mcl::Impl::estimateRoughly(const Led& led) {
  const UpdateTime::Measured all(tools.time, Work::kEstimate,
                                 UpdateTime::sizeOf(led.weights.size()));
  const Timestamp stamp = led.moment.stamp;
  const Pose2 before = std::exchange(estimate, led.estimate).pose;
  followFloor(before);
  estimate.stamp = stamp;
  track->coarsest = coarsestOf(*led.moment.news);
  keepResolution(estimate);
  track->momentum.follow(estimate, stamp);
  parts.lateness.keep(track->belief.samples(), led.weights, estimate, stamp);
}

/// Refines the estimate as far as there is time. @param samples number of those of the belief
void Mcl::Impl::refine(const std::vector<NewReading>& news, std::size_t samples) {
  tools.time.follows(Work::kClosing, samples);
  const UpdateTime::Measured refining(tools.time, Work::kRefining, 1.0);
  parts.polish.follow(news, estimate, tools.time.endOf(Work::kPolishing));
}

/// The parts that follow the estimate by odometry forget where it was on another floor.
/// @param before the estimate's pose until now
void Mcl::Impl::followFloor(const Pose2& before) {
  const Building& building = tools.region.building;
  if (building.isEmpty() || building.floorAt(before.x) == building.floorAt(estimate.pose.x)) return;
  parts.forgetPlace();
  steps.because(Relocalization::kOtherPlace);
}

/// Follows other places at which readings fit as well. Readings may have to wait to be asked about
/// them; new ones are always noted, since samples may have left them soon.
void Mcl::Impl::lookElsewhere(const Led& led) {
  Lookalikes& lookalikes = track->lookalikes;
  const Lookalikes::Moment moment{led.estimate.pose,
                                  track->isBlind ? std::nullopt : reached.odometry,
                                  track->travelled.all, random(Purpose::kRivals).fork(7)};
  lookalikes.follow(moment);
  {
    const UpdateTime::Step begins(tools.time, Work::kLookalikes,
                                  tools.time.timeOfPoses(static_cast<double>(lookalikes.poses()),
                                                         nanosecondsOf(*led.moment.news)));
    if (begins) lookalikes.compare(moment, led.moment.evidence);
  }
  if (led.estimate.share >= 1.0 - tuning::lookalikes::kLeastShare) return;
  const UpdateTime::Measured finding(tools.time, Work::kLookalikes,
                                     UpdateTime::sizeOf(led.weights.size()));
  lookalikes.add(clustersOf(led.bins, track->belief.samples().view(), led.weights,
                            tuning::lookalikes::kLeastShare));
}

/// Returns how far the belief reaches at other places than the estimate's.
PoseDistance Mcl::Impl::othersOf(const Led& led) const {
  const bool isOnePlace = estimate.share >= tuning::confidence::kOfOnePlace;
  const double rest = isOnePlace ? kBeyondTracking : kBeyondUncertain;
  if (estimate.share >= 1.0 - rest) return {};
  return reachOf(track->belief.samples().view(), led.weights, estimate.pose, rest);
}

/// Resamples, with KLD-adaptive size, if the effective sample size is low.
void Mcl::Impl::resample(const Estimated& estimated) {
  Hypothesis& belief = track->belief;
  const std::size_t had = belief.samples().size();
  const UpdateTime::Measured resampling(tools.time, Work::kResampling, UpdateTime::sizeOf(had));
  tools.time.follows(Work::kEnd, 0);
  const std::vector<double>& weights = estimated.weights;
  if (effectiveSamples(weights) < tools.config.resampleBelow * static_cast<double>(had)) {
    const double offset = random(Purpose::kResampling).uniform();
    std::vector<std::uint32_t> drawn = lowVariance(weights, had, offset, &tools.workers);
    const std::size_t n =
        std::min({kldSamples(tools.config, estimated.bins.countOf(drawn, &tools.workers)),
                  tools.limit.most(), std::max(tools.time.mostSamples(), tools.config.minSamples)});
    if (n != drawn.size()) drawn = lowVariance(weights, n, offset, &tools.workers);
    belief.setSamples(taken(belief.samples(), drawn, &tools.workers));
  } else {
    belief.scaleWeights();
  }
  if (track->trust.isLost()) track->anchor = belief.samples();
}

}  // namespace ortung
