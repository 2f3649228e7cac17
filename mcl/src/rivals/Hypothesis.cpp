#include "Hypothesis.hpp"

#include <algorithm>
#include <cmath>

#include "Kld.hpp"
#include "Resampling.hpp"

namespace ortung {

double Hypothesis::Said::logEvidenceOf(std::size_t first, std::size_t count) const {
  return logMeanOfPart(before, logs, first, count);
}

void Hypothesis::add(const SampleSet& fresh, double share) { ortung::add(samples_, fresh, share); }

void Hypothesis::scaleWeights() {
  const float largest = *std::max_element(samples_.logWeight.begin(), samples_.logWeight.end());
  if (!std::isfinite(largest)) return;
  for (float& w : samples_.logWeight) w -= largest;
}

std::vector<double> Hypothesis::weights(Workers* workers) const {
  return normalized(samples_.logWeight, workers);
}

Hypothesis::Said Hypothesis::ask(const Evidence& evidence, Workers* workers) const {
  std::vector<float> logs;
  evidence.weigh(samples_, logs);
  return said(std::move(logs), workers);
}

Hypothesis::Said Hypothesis::said(std::vector<float> logs, Workers* workers) const {
  Said said{weights(workers), std::move(logs), 0.0};
  said.logEvidence = logMean(said.before, said.logs, workers);
  return said;
}

std::vector<double> Hypothesis::takeIn(Said& said, const Evidence& evidence,
                                       const MclConfig& config, double below,
                                       const std::function<Climb()>& climb, Workers* workers) {
  for (std::size_t i = 0; i < said.logs.size(); ++i) samples_.logWeight[i] += said.logs[i];
  std::vector<double> after = weights(workers);
  if (!(effectiveSamples(after) < below)) return after;
  samples_ = climbed(said, evidence, config, climb());
  said.logs.clear();
  return weights(workers);
}

Hypothesis::Said Hypothesis::weigh(const Evidence& evidence, const MclConfig& config, double below,
                                   const std::function<Climb()>& climb, Workers* workers) {
  Said said = ask(evidence, workers);
  takeIn(said, evidence, config, below, climb, workers);
  return said;
}

SampleSet Hypothesis::climbed(const Said& said, const Evidence& evidence, const MclConfig& config,
                              Climb climb) const {
  const Annealing annealing =
      climb.isOfBelief
          ? Annealing(evidence.weigh, estimateOf(config, samples_.view(), said.before).covariance,
                      climb.from)
          : Annealing(evidence.weigh, nullptr);
  const auto drawn = lowVariance(said.before, climb.from, climb.offset.uniform());
  return annealing.draw(taken(samples_, drawn), climb.to, climb.random, climb.isOver).samples;
}

bool Hypothesis::count(double ratio, double part, bool isUsual) {
  unusual_ = isUsual ? 0 : unusual_ + 1;
  if (!(ratio < 0.0 || isUsual)) return false;
  lead_.count(ratio, part);
  return true;
}

}  // namespace ortung
