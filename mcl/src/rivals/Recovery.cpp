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

/// Draws some samples by their weights.
std::vector<std::uint32_t> witnessesOf(std::span<const double> weights, Workers* workers) {
  return lowVariance(weights, kWitnesses, 0.5, workers);
}

/// Makes the last pose one outside of the map (NaN), whose likelihood is the floor of the sensor
/// model.
void endOutside(SampleSet& poses) {
  poses.x.back() = poses.y.back() = std::numeric_limits<float>::quiet_NaN();
  poses.theta.back() = 0.0F;
}

/// Returns whether a reading can distinguish poses. @param floor ln p outside of the map
bool isVoice(double floor) { return floor < 0.0 && std::isfinite(floor); }

/// Returns how well a reading is explained. @param mean mean of its ln p
double explained(double mean, double floor) {
  return std::isfinite(mean) ? std::clamp(1.0 - mean / floor, 0.0, 1.0) : 0.0;
}

double meanOf(double sum) { return sum / static_cast<double>(kWitnesses); }

/// Returns the fit of a reading whose likelihoods are known, but for that outside of the map.
std::optional<double> fitOfKnown(const Weigher& reading, std::span<const float> known,
                                 std::span<const double> weights, Workers* workers) {
  SampleSet outside;
  outside.resize(1);
  endOutside(outside);
  reading.getProbability(outside.view(), outside.logWeight);
  const auto floor = static_cast<double>(outside.logWeight.back());
  if (!isVoice(floor)) return std::nullopt;
  double sum = 0.0;
  for (const std::uint32_t i : witnessesOf(weights, workers)) sum += static_cast<double>(known[i]);
  return explained(meanOf(sum), floor);
}

}  // namespace

std::optional<double> fitOf(std::span<const Weigher* const> readings, const SampleSet& samples,
                            std::span<const double> weights, Workers* workers,
                            std::span<const float> known) {
  if (readings.size() == 1 && known.size() == samples.size())
    return fitOfKnown(*readings.front(), known, weights, workers);
  SampleSet witnesses = taken(samples, witnessesOf(weights, workers));
  witnesses.resize(kWitnesses + 1);
  endOutside(witnesses);
  double sum = 0.0;
  double voices = 0.0;
  std::vector<float> logs(witnesses.size());
  for (const Weigher* reading : readings) {
    std::fill(logs.begin(), logs.end(), 0.0F);
    reading->getProbability(witnesses.view(), logs);
    const auto floor = static_cast<double>(logs.back());
    if (!isVoice(floor)) continue;
    sum += explained(meanOf(std::accumulate(logs.begin(), logs.end() - 1, 0.0)), floor);
    voices += 1.0;
  }
  if (voices == 0.0) return std::nullopt;
  return sum / voices;
}

std::vector<double> fitsAt(std::span<const Weigher* const> readings, std::span<const Pose2> poses) {
  const std::size_t n = poses.size();
  SampleSet set;
  set.resize(n + 1);
  for (std::size_t i = 0; i < n; ++i) {
    set.x[i] = static_cast<float>(poses[i].x);
    set.y[i] = static_cast<float>(poses[i].y);
    set.theta[i] = static_cast<float>(poses[i].theta);
  }
  endOutside(set);
  std::vector<double> fits(n, 0.0);
  double voices = 0.0;
  for (const Weigher* reading : readings) {
    std::fill(set.logWeight.begin(), set.logWeight.end(), 0.0F);
    reading->getProbability(set.view(), set.logWeight);
    const auto floor = static_cast<double>(set.logWeight.back());
    if (!isVoice(floor)) continue;
    for (std::size_t i = 0; i < n; ++i)
      fits[i] += explained(static_cast<double>(set.logWeight[i]), floor);
    voices += 1.0;
  }
  for (double& fit : fits) fit = voices > 0.0 ? fit / voices : 0.0;
  return fits;
}

Recovery::Recovery(const MclConfig& config)
    : rateFast_(config.recoverFast), rateSlow_(config.recoverSlow) {}

void Recovery::follow(double fit, bool stands) {
  stands_ = stands;
  isBlind_ = false;
  if (!known_) fast_ = slow_ = fit;
  known_ = true;
  now_ = fit;
  fast_ += rateFast_ * (fit - fast_);
  // The long-term average changes slowly, and even more slowly while the fit is low.
  const double rate = fit < kFallenFit * slow_ ? kRateWhileFallen * rateSlow_ : rateSlow_;
  slow_ += rate * (fit - slow_);
}

bool Recovery::fitsBadly() const {
  return rateSlow_ > 0.0 && known_ && (now_ < kDoubtfulFit * slow_ || now_ < kPoorFit);
}

bool Recovery::isDoubtful() const {
  if (isBlind_) return callsForSearch();
  return fitsBadly() || (rateSlow_ > 0.0 && known_ && stands_ && unusual_ >= kUnusualReadings);
}

void Recovery::followBest(double fit, double part) {
  if (!best_) best_ = lately_ = fit;
  lately_ += rateFast_ * (fit - lately_);
  unusual_ = isUsual(fit) || isOfScatter(fit) ? 0 : unusual_ + 1;
  // Two on end are no scatter: something has changed.
  if (unusual_ < 2)
    scatter_ += rateSlow_ * (std::min(std::abs(fit - *best_), kMostScatter) - scatter_);
  // The fit in a crowd that stays around the robot must not become usual, since then places that
  // fit only a little would be accepted.
  *best_ += (fit < *best_ ? part * kRateWhileFallen : 1.0) * rateSlow_ * (fit - *best_);
}

bool Recovery::isUsual(double best) const {
  return best >= kUsualFit * best_.value_or(1.0) && best >= kPoorFit;
}

/// Where readings scatter, a worse one where the robot is known to be is no evidence. Where it was
/// not known to be, it would be none for that place, either.
bool Recovery::isOfScatter(double best) const {
  return best >= std::max(kPoorFit, kFallenFit * *best_) && best >= *best_ - kScatters * scatter_;
}

bool Recovery::callsForSearch() const {
  if (isBlind_) return rateSlow_ > 0.0 && unusual_ > 0;
  return rateSlow_ > 0.0 && known_ &&
         (fast_ < kFallenFit * slow_ || fast_ < kPoorFit || unusual_ >= kUnusualReadings);
}

bool Recovery::hasRecovered() const {
  if (isBlind_) return unusual_ == 0;
  return known_ && fast_ > kRecoveredFit * slow_ && fast_ > kPoorFit;
}

}  // namespace ortung
