// How readings weigh the samples: the filter's second half (eq. 7).
#include <algorithm>
#include <cmath>

#include "Annealing.hpp"
#include "Kld.hpp"
#include "MclImpl.hpp"
#include "Resampling.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

/// That a sample is weighed until readings that come in by degrees are in, about: a quarter of them
/// climbs eight times in two steps.
constexpr double kTimesWeighed = 5.0;
constexpr double kFewLeft = 25.0;  ///< effective samples: readings are far sharper than the belief

}  // namespace

/// Where a robot may be of which nothing is known.
void Mcl::Impl::waitAnywhere() {
  belief.setSamples(
      search.anywhere(config.maxSamples, Random(config.seed, stream(Purpose::kStart))));
  globalStart.prepare();
  estimate.status = TrackStatus::kLost;
  estimate.reason = TrackReason::kSearching;
  estimate.quality = 0.0;
}

/// The first moment's readings say where the robot was then. Those that come before that is known
/// are left: the newest of them count afterwards. @param news what was used is taken out
void Mcl::Impl::start(NewsByTime& news) {
  if (!globalStart.isBegun()) {
    if (news.empty()) return;
    const auto first = news.extract(news.begin());
    ++step;
    predictFor(first.key());
    intake.used(first.mapped(), first.key(), lastOdometry);
    globalStart.begin(
        {first.key(), lastOdometry, stream(Purpose::kStart), std::move(first.mapped())});
  }
  goOnStarting();
}

void Mcl::Impl::goOnStarting() {
  if (!globalStart.isBegun() || !globalStart.work(time.left())) return;
  const GlobalStart::Moment then = globalStart.moment();
  belief.setSamples(globalStart.take());
  waitsForStart = false;
  hasStarted = true;
  confirmation.begin();
  conclude(then.news, belief.weights(), then.stamp);
}

std::vector<const Weigher*> Mcl::Impl::readingsOf(const std::vector<News>& news) {
  std::vector<const Weigher*> readings;
  for (const News& one : news) readings.push_back(one.weigher.get());
  return readings;
}

Evidence Mcl::Impl::evidenceOf(const std::vector<News>& news) {
  return {[this, &news, each = nanosecondsOf(news)](const SampleSet& set, std::vector<float>& out) {
            time.spend(each * static_cast<double>(set.size()));
            weigh(news, set, &workers, out);
          },
          [&news](const SampleSet& set) {
            return fitOf(readingsOf(news), set, normalized(set.logWeight)).value_or(0.0);
          }};
}

/// @param before weights before the readings are weighed
void Mcl::Impl::followFit(const std::vector<News>& news, const std::vector<double>& before) {
  const auto fit = fitOf(readingsOf(news), belief.samples(), before, &workers);
  if (fit) recovery.follow(*fit, lastOdometry && way < kStands);
}

/// Lets another delay of the readings be in force, if it has explained them better.
/// @returns whether it is
bool Mcl::Impl::compareDelays(const std::vector<News>& news, const Lateness::Moment& moment) {
  auto change = lateness.follow(moment, recovery, evidenceOf(news));
  if (!change) return false;
  if (change->samples) {
    belief.setSamples(std::move(*change->samples));
    recovery.beginAnew();
  }
  lastOdometry = lateness.odometryAt(moment.stamp);
  trust.forget();
  rivals.forget();
  return true;
}

/// Lets other places have the belief, or a part of it, if they have explained readings better.
/// @returns whether they have
bool Mcl::Impl::compareWithRivals(const Evidence& evidence, const Rivals::Moment& moment) {
  auto takeover = rivals.follow(moment, recovery, evidence);
  if (!takeover) return false;
  if (takeover->share < 1.0) {
    belief.add(takeover->samples, takeover->share);
  } else {
    belief.setSamples(std::move(takeover->samples));
    recovery.beginAnew();
    confirmation.forget();  // it was compared on a way of its own
  }
  takeover->trustsOdometry ? trust.forget() : trust.lose();
  return true;
}

/// Weighs the samples by what the readings have said. @returns their weights
std::vector<double> Mcl::Impl::takeIn(const std::vector<News>& news, const Evidence& evidence,
                                      Hypothesis::Said said) {
  if (drifted > 0) return takeInUnsure(news, evidence, std::move(said));
  return belief.takeIn(
      said, evidence, config, config.resampleBelow > 0.0 ? kFewLeft : 0.0,
      [&] { return climbFor(news, said.before.size()); }, &workers);
}

/// While odometry is not trusted: whether it leads to where the readings are, or drifting about
/// does as well. Samples that drifted count only if the readings fit there as they use to: in a
/// crowd nothing fits, and wherever one goes a little less unlike it is no better a place.
std::vector<double> Mcl::Impl::takeInUnsure(const std::vector<News>& news, const Evidence& evidence,
                                            Hypothesis::Said said) {
  const double ratio = said.logEvidenceOf(drifted, belief.samples().size() - drifted) -
                       said.logEvidenceOf(0, drifted);
  trust.compare(-ratio, way);
  const SampleSet near = Annealing(evidence.weigh, nullptr)
                             .draw(belief.samples().from(drifted), config.minSamples,
                                   Random(config.seed, stream(Purpose::kSpread)))
                             .samples;
  belief.keepFirst(drifted);
  said.logs.resize(std::exchange(drifted, 0));
  said.before = belief.weights();
  takeIn(news, evidence, std::move(said));
  if (recovery.isUsual(evidence.fit(near))) belief.add(near, 1.0 / (1.0 + std::exp(-ratio)));
  return belief.weights(&workers);
}

/// @param bins of the samples
void Mcl::Impl::resample(const std::vector<double>& weights, const PoseBins& bins) {
  Random random(config.seed, stream(Purpose::kResampling));
  const double offset = random.uniform();
  std::vector<std::uint32_t> drawn =
      lowVariance(weights, belief.samples().size(), offset, &workers);
  const std::size_t n = kldSamples(config, bins.countOf(drawn));
  if (n != drawn.size()) drawn = lowVariance(weights, n, offset, &workers);
  belief.setSamples(taken(belief.samples(), drawn, &workers));
}

/// Where readings are far sharper than the belief, hardly any sample is left, and none of them at
/// the top of the hill: then the readings come in by degrees.
/// @param had samples before the readings were weighed
Hypothesis::Climb Mcl::Impl::climbFor(const std::vector<News>& news, std::size_t had) {
  const Random random(config.seed, stream(Purpose::kSpread));
  // After a way on which nothing was seen, they are to be found in many places.
  const std::size_t wanted =
      std::max(had, kldSamples(config, PoseBins(config, belief.samples().view()).count()));
  const double affordable = 1e6 * time.left() / (kTimesWeighed * nanosecondsOf(news));
  const std::size_t n =
      std::min(config.maxSamples,
               std::max(2 * config.minSamples,
                        std::min(wanted, static_cast<std::size_t>(std::min(affordable, 1e9)))));
  return {n, std::max(config.minSamples, n / 4), random.fork(1), random, !isBlind};
}

void Mcl::Impl::correct(const std::vector<News>& news, Timestamp stamp) {
  const Evidence evidence = evidenceOf(news);
  Hypothesis::Said said = belief.ask(evidence, &workers);
  followFit(news, said.before);
  const bool isCompared = recovery.isDoubtful() || recovery.callsForSearch() || !rivals.isIdle();
  Rivals::Moment moment{stamp,        {}, said.logEvidence, way, stream(Purpose::kRivals),
                        lastOdometry, {}};
  if (isCompared) {
    moment.predicted = estimateOf(config, belief.samples().view(), said.before).pose;
    for (const News& one : news) moment.readings.push_back(one.weigher);
  }
  std::vector<double> weights = takeIn(news, evidence, std::move(said));
  recovery.followBest(fitOf(readingsOf(news), belief.samples(), weights, &workers).value_or(0.0));
  confirmation.count(recovery.unusual() == 0, metres);
  if (!isCompared) {
    rivals.forget();
  } else if (compareWithRivals(evidence, moment)) {
    weights = belief.weights(&workers);
  }
  conclude(
      news, std::move(weights), stamp,
      Lateness::Moment{
          stamp, moment.logEvidence, isCompared || trust.isLost(), {}, stream(Purpose::kRivals)});
}

/// Estimates from the belief as it was weighed, and resamples it.
/// @param weighed nothing: the readings have made the belief
void Mcl::Impl::conclude(const std::vector<News>& news, std::vector<double> weights,
                         Timestamp stamp, std::optional<Lateness::Moment> weighed) {
  way = metres = 0.0;
  std::optional<PoseBins> bins;
  estimate = estimateBy(weights, bins);
  if (weighed) weighed->estimate = estimate;
  if (weighed && compareDelays(news, *weighed)) {
    weights = belief.weights(&workers);
    estimate = estimateBy(weights, bins);
  }
  estimate.stamp = stamp;
  coarsest = coarsestOf(news);
  keepResolution(estimate);
  momentum.follow(estimate, stamp);
  lateness.keep(belief.samples(), weights, estimate, stamp);
  polish.follow(news, estimate);
  present = estimate;
  if (lateness.seconds() > 0.0) estimate = atStamp(estimate, stamp);
  estimate = lateness.widened(estimate, stamp);
  judge(signsAt(stamp), estimate);
  if (config.learnsBiases) biases.follow(news, estimate);
  if (effectiveSamples(weights) <
      config.resampleBelow * static_cast<double>(belief.samples().size())) {
    resample(weights, *bins);
  } else {
    belief.scaleWeights();
  }
  if (trust.isLost()) anchor = belief.samples();
}

}  // namespace ortung
