#include "Recovery.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "Resampling.hpp"
#include "RivalsTuning.hpp"

namespace ortung {
namespace {

using namespace tuning::recovery;

/// Some samples, by their weights; the last one is nowhere: it gets a feature's floor.
SampleSet witnessesOf(const SampleSet& samples, std::span<const double> weights, Workers* workers) {
  SampleSet witnesses;
  witnesses.resize(kWitnesses + 1);
  const auto indices = lowVariance(weights, kWitnesses, 0.5, workers);
  for (std::size_t k = 0; k < kWitnesses; ++k) {
    witnesses.x[k] = samples.x[indices[k]];
    witnesses.y[k] = samples.y[indices[k]];
    witnesses.theta[k] = samples.theta[indices[k]];
  }
  witnesses.x.back() = witnesses.y.back() = std::numeric_limits<float>::quiet_NaN();
  witnesses.theta.back() = 0.0F;
  return witnesses;
}

}  // namespace

std::optional<double> fitOf(std::span<const Weigher* const> readings, const SampleSet& samples,
                            std::span<const double> weights, Workers* workers) {
  const SampleSet witnesses = witnessesOf(samples, weights, workers);
  double sum = 0.0;
  double voices = 0.0;
  std::vector<float> logs(witnesses.size());
  for (const Weigher* reading : readings) {
    std::fill(logs.begin(), logs.end(), 0.0F);
    reading->getProbability(witnesses.view(), logs);
    const auto floor = static_cast<double>(logs.back());
    if (!(floor < 0.0) || !std::isfinite(floor)) continue;
    const double mean =
        std::accumulate(logs.begin(), logs.end() - 1, 0.0) / static_cast<double>(kWitnesses);
    sum += std::isfinite(mean) ? std::clamp(1.0 - mean / floor, 0.0, 1.0) : 0.0;
    voices += 1.0;
  }
  if (voices == 0.0) return std::nullopt;
  return sum / voices;
}

Recovery::Recovery(const MclConfig& config)
    : rateFast_(config.recoverFast), rateSlow_(config.recoverSlow) {}

void Recovery::follow(double fit, bool stands) {
  stands_ = stands;
  if (!known_) fast_ = slow_ = fit;
  known_ = true;
  now_ = fit;
  fast_ += rateFast_ * (fit - fast_);
  // What is usual changes slowly, and a bad time is not soon taken for it.
  const double rate = fit < kFallenFit * slow_ ? kRateWhileFallen * rateSlow_ : rateSlow_;
  slow_ += rate * (fit - slow_);
}

bool Recovery::fitsBadly() const {
  return rateSlow_ > 0.0 && known_ && (now_ < kDoubtfulFit * slow_ || now_ < kPoorFit);
}

bool Recovery::isDoubtful() const {
  return fitsBadly() || (rateSlow_ > 0.0 && known_ && stands_ && unusual_ >= kUnusualReadings);
}

void Recovery::followBest(double fit) {
  if (!best_) best_ = lately_ = fit;
  last_ = fit;
  lately_ += rateFast_ * (fit - lately_);
  unusual_ = isUsual(fit) ? 0 : unusual_ + 1;
  // A crowd that stays with the robot must not become what is usual: then places would do that look
  // a little like it.
  *best_ += (fit < *best_ ? kRateWhileFallen : 1.0) * rateSlow_ * (fit - *best_);
}

bool Recovery::isUsual(double best) const {
  return best >= kUsualFit * best_.value_or(1.0) && best >= kPoorFit;
}

bool Recovery::callsForSearch() const {
  return rateSlow_ > 0.0 && known_ &&
         (fast_ < kFallenFit * slow_ || fast_ < kPoorFit || unusual_ >= kUnusualReadings);
}

bool Recovery::hasRecovered() const {
  return known_ && fast_ > kRecoveredFit * slow_ && fast_ > kPoorFit;
}

}  // namespace ortung
