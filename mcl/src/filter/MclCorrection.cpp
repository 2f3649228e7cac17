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
  samples = search.anywhere(config.maxSamples, Random(config.seed, stream(Purpose::kStart)));
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
  samples = globalStart.take();
  waitsForStart = false;
  hasStarted = true;
  confirmation.begin();
  conclude(then.news, normalized(samples.logWeight), then.stamp);
}

std::vector<const Weigher*> Mcl::Impl::readingsOf(const std::vector<News>& news) {
  std::vector<const Weigher*> readings;
  for (const News& one : news) readings.push_back(one.weigher.get());
  return readings;
}

/// How well samples explain the readings.
double Mcl::Impl::fitNow(const std::vector<News>& news, const SampleSet& set) {
  return fitOf(readingsOf(news), set, normalized(set.logWeight)).value_or(0.0);
}

/// @param before weights before the readings are weighed
void Mcl::Impl::followFit(const std::vector<News>& news, const std::vector<double>& before) {
  const auto fit = fitOf(readingsOf(news), samples, before, &workers);
  if (fit) recovery.follow(*fit, lastOdometry && way < kStands);
}

/// Lets another delay of the readings be in force, if it has explained them better.
/// @returns whether it is
bool Mcl::Impl::compareDelays(const std::vector<News>& news, const Lateness::Moment& moment) {
  const auto fit = [&](const SampleSet& set) { return fitNow(news, set); };
  auto change = lateness.follow(moment, recovery, weigherOf(news), fit);
  if (!change) return false;
  if (change->samples) {
    samples = std::move(*change->samples);
    recovery.beginAnew();
  }
  lastOdometry = lateness.odometryAt(moment.stamp);
  trust.forget();
  rivals.forget();
  return true;
}

/// Lets other places have the belief, or a part of it, if they have explained readings better.
/// @returns whether they have
bool Mcl::Impl::compareWithRivals(const std::vector<News>& news, const Rivals::Moment& moment) {
  const auto fit = [&](const SampleSet& set) { return fitNow(news, set); };
  auto takeover = rivals.follow(moment, recovery, weigherOf(news), fit);
  if (!takeover) return false;
  if (takeover->share < 1.0) {
    add(samples, takeover->samples, takeover->share);
  } else {
    samples = std::move(takeover->samples);
    recovery.beginAnew();
    confirmation.forget();  // it was compared on a way of its own
  }
  takeover->trustsOdometry ? trust.forget() : trust.lose();
  return true;
}

/// Weighs the samples by what the readings say.
/// @param before weights before that @returns weights then
std::vector<double> Mcl::Impl::takeIn(const std::vector<News>& news,
                                      const std::vector<double>& before) {
  if (drifted > 0) return takeInUnsure(news, before);
  for (std::size_t i = 0; i < samples.size(); ++i) samples.logWeight[i] += logProbability[i];
  std::vector<double> weights = weightsNow();
  if (!(config.resampleBelow > 0.0 && effectiveSamples(weights) < kFewLeft)) return weights;
  sharpen(news, before);
  return weightsNow();
}

/// While odometry is not trusted: whether it leads to where the readings are, or drifting about
/// does as well. Samples that drifted count only if the readings fit there as they use to: in a
/// crowd nothing fits, and wherever one goes a little less unlike it is no better a place.
std::vector<double> Mcl::Impl::takeInUnsure(const std::vector<News>& news,
                                            const std::vector<double>& before) {
  const double ratio = logMeanOfPart(before, logProbability, drifted, samples.size() - drifted) -
                       logMeanOfPart(before, logProbability, 0, drifted);
  trust.compare(-ratio, way);
  const SampleSet near = Annealing(weigherOf(news), nullptr)
                             .draw(samples.from(drifted), config.minSamples,
                                   Random(config.seed, stream(Purpose::kSpread)))
                             .samples;
  samples.resize(std::exchange(drifted, 0));
  logProbability.resize(samples.size());
  takeIn(news, normalized(samples.logWeight));
  if (recovery.isUsual(fitNow(news, near))) add(samples, near, 1.0 / (1.0 + std::exp(-ratio)));
  return weightsNow();
}

/// @param bins of the samples
void Mcl::Impl::resample(const std::vector<double>& weights, const PoseBins& bins) {
  Random random(config.seed, stream(Purpose::kResampling));
  const double offset = random.uniform();
  std::vector<std::uint32_t> drawn = lowVariance(weights, samples.size(), offset, &workers);
  const std::size_t n = kldSamples(config, bins.countOf(drawn));
  if (n != drawn.size()) drawn = lowVariance(weights, n, offset, &workers);
  samples = taken(samples, drawn, &workers);
}

/// Where readings are far sharper than the belief, hardly any sample is left, and none of them at
/// the top of the hill: then the readings come in by degrees.
/// @param before weights before the readings were weighed
void Mcl::Impl::sharpen(const std::vector<News>& news, const std::vector<double>& before) {
  const Random random(config.seed, stream(Purpose::kSpread));
  Random offset = random.fork(1);
  // After a way on which nothing was seen, they are to be found in many places.
  const std::size_t wanted =
      std::max(before.size(), kldSamples(config, PoseBins(config, samples.view()).count()));
  const double affordable = 1e6 * time.left() / (kTimesWeighed * nanosecondsOf(news));
  const std::size_t n =
      std::min(config.maxSamples,
               std::max(2 * config.minSamples,
                        std::min(wanted, static_cast<std::size_t>(std::min(affordable, 1e9)))));
  const Annealing annealing =
      isBlind
          ? Annealing(weigherOf(news), nullptr)
          : Annealing(weigherOf(news), estimateOf(config, samples.view(), before).covariance, n);
  samples = annealing
                .draw(taken(samples, lowVariance(before, n, offset.uniform())),
                      std::max(config.minSamples, n / 4), random)
                .samples;
}

void Mcl::Impl::correct(const std::vector<News>& news, Timestamp stamp) {
  const std::vector<double> before = weightsNow();
  followFit(news, before);
  const bool isCompared = recovery.isDoubtful() || recovery.callsForSearch() || !rivals.isIdle();
  Rivals::Moment moment{stamp, {}, 0.0, way, stream(Purpose::kRivals), lastOdometry, {}};
  if (isCompared) {
    moment.predicted = estimateOf(config, samples.view(), before).pose;
    for (const News& one : news) moment.readings.push_back(one.weigher);
  }
  weigherOf(news)(samples, logProbability);
  moment.logEvidence = logMean(before, logProbability, &workers);
  std::vector<double> weights = takeIn(news, before);
  recovery.followBest(fitOf(readingsOf(news), samples, weights, &workers).value_or(0.0));
  confirmation.count(recovery.unusual() == 0, metres);
  if (!isCompared) {
    rivals.forget();
  } else if (compareWithRivals(news, moment)) {
    weights = weightsNow();
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
    weights = weightsNow();
    estimate = estimateBy(weights, bins);
  }
  estimate.stamp = stamp;
  coarsest = coarsestOf(news);
  keepResolution(estimate);
  momentum.follow(estimate, stamp);
  lateness.keep(samples, weights, estimate, stamp);
  polish.follow(news, estimate);
  present = estimate;
  if (lateness.seconds() > 0.0) estimate = atStamp(estimate, stamp);
  estimate = lateness.widened(estimate, stamp);
  judge(signsAt(stamp), estimate);
  if (config.learnsBiases) biases.follow(news, estimate);
  if (effectiveSamples(weights) < config.resampleBelow * static_cast<double>(samples.size())) {
    resample(weights, *bins);
  } else {
    // Keeps the numbers small: weights matter up to a common factor only.
    const float largest = *std::max_element(samples.logWeight.begin(), samples.logWeight.end());
    if (std::isfinite(largest)) {
      for (float& w : samples.logWeight) w -= largest;
    }
  }
  if (trust.isLost()) anchor = samples;
}

}  // namespace ortung
