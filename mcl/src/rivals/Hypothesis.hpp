#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "Annealing.hpp"
#include "Lead.hpp"
#include "Parallel.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {

class Workers;

/// The likelihood of one time step's readings, for any hypothesis.
struct Evidence {
  Annealing::Weigh weigh;  ///< ln p(readings | sample)
  /// How well samples explain the readings, as fitOf() returns.
  std::function<double(const SampleSet&)> fit;
};

/// One hypothesis of where the robot is, as weighted samples. The belief is one; alternatives are
/// tracked beside it: around the estimate and elsewhere while readings fit badly (Rivals), and one
/// for each delay that may have begun (Lateness). They differ in how they are moved, and in how
/// long they must lead before they take over; readings weigh all of them in the same way. Not
/// thread-safe.
class ORTUNG_API Hypothesis {
 public:
  /// Likelihoods of one time step's readings, before the samples are weighed by them.
  struct Said {
    std::vector<double> before;  ///< weights so far, sum 1
    std::vector<float> logs;     ///< ln p(readings | sample); none once others are the samples
    double logEvidence = 0.0;    ///< ln p(readings | hypothesis)
    /// Returns ln p(readings) for a part of the samples alone.
    double logEvidenceOf(std::size_t first, std::size_t count) const;
  };
  /// How readings that are far sharper than the hypothesis are annealed: they weigh gradually more,
  /// while the samples climb by Metropolis steps.
  struct Climb {
    std::size_t from;  ///< initial number of samples, drawn by their weights so far
    std::size_t to;    ///< final number of samples
    Random offset;     ///< random numbers by which the initial samples are drawn
    Random random;     ///< random numbers of the Metropolis steps
    /// Whether the belief is the prior of the steps; otherwise it is uniform.
    bool isOfBelief = true;
    IsOver isOver = {};  ///< hastens the annealing
  };

  explicit Hypothesis(SampleSet samples = {}, Lead lead = Lead())
      : samples_(std::move(samples)), lead_(lead) {}

  const SampleSet& samples() const { return samples_; }
  /// Replaces the samples of the same hypothesis: its lead stays.
  void setSamples(SampleSet samples) { samples_ = std::move(samples); }
  /// Adds samples, which then have @p share of the total weight. @pre 0 < share < 1
  void add(const SampleSet& fresh, double share);
  /// Keeps the first @p n samples. @pre n <= size()
  void keepFirst(std::size_t n) { samples_.resize(n); }
  /// Leaves out samples. @param isLeftOut says which ones by their number
  /// @param logs a value for each sample, which are left out, too
  template <class IsLeftOut>
  void leaveOut(const IsLeftOut& isLeftOut, std::vector<float>& logs);
  /// Scales the weights so that the largest is 1, to keep the numbers small; only their ratios
  /// matter.
  void scaleWeights();
  /// Returns the weights, with sum 1. @param workers borrowed, may be null, here and below
  std::vector<double> weights(Workers* workers = nullptr) const;

  /// Moves all samples (eq. 8).
  /// @param number number of the first sample's random numbers in their stream
  /// @param moveSome moves some samples, as MotionModel::sampleMotion: (samples, number of their
  ///   first)
  template <class MoveSome>
  void move(std::size_t number, const MoveSome& moveSome, Workers* workers = nullptr);

  Said ask(const Evidence& evidence, Workers* workers = nullptr) const;
  /// Returns what ask() does, from likelihoods that are known already.
  Said said(std::vector<float> logs, Workers* workers = nullptr) const;
  /// Weighs the samples by the readings (eq. 7).
  /// @param below effective sample size: if fewer are left, hardly any sample is near the peak of
  ///   the likelihood, and the readings are annealed
  /// @param climb returns how to anneal; called only then
  /// @returns the weights, sum 1
  std::vector<double> takeIn(Said& said, const Evidence& evidence, const MclConfig& config,
                             double below, const std::function<Climb()>& climb,
                             Workers* workers = nullptr);
  /// Calls ask() and takeIn(). @returns the likelihoods of ask()
  Said weigh(const Evidence& evidence, const MclConfig& config, double below,
             const std::function<Climb()>& climb, Workers* workers = nullptr);

  /// Counts the evidence of readings for the hypothesis against the belief. They count in its
  /// favour only if they fit as well as usual, and always against it.
  /// @param ratio ln p(readings | hypothesis) - ln p(readings | belief) [nats]
  /// @param part distance travelled as a share of that after which readings are independent
  /// @param isUsual whether the readings fit as well as usual
  /// @returns whether they counted
  bool count(double ratio, double part, bool isUsual);
  const Lead& lead() const { return lead_; }
  void forgetLead() { lead_.forget(); }
  /// Returns the number of readings in a row that fitted worse than usual.
  int unusual() const { return unusual_; }

 private:
  SampleSet climbed(const Said& said, const Evidence& evidence, const MclConfig& config,
                    Climb climb) const;

  SampleSet samples_;
  Lead lead_;
  int unusual_ = 0;
};

template <class IsLeftOut>
void Hypothesis::leaveOut(const IsLeftOut& isLeftOut, std::vector<float>& logs) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (isLeftOut(i)) continue;
    samples_.x[kept] = samples_.x[i];
    samples_.y[kept] = samples_.y[i];
    samples_.theta[kept] = samples_.theta[i];
    samples_.logWeight[kept] = samples_.logWeight[i];
    logs[kept++] = logs[i];
  }
  samples_.resize(kept);
  logs.resize(kept);
}

template <class MoveSome>
void Hypothesis::move(std::size_t number, const MoveSome& moveSome, Workers* workers) {
  forEachChunk(samples_.size(), workers, [&](std::size_t first, std::size_t count) {
    moveSome(MovableSamples{std::span(samples_.x).subspan(first, count),
                            std::span(samples_.y).subspan(first, count),
                            std::span(samples_.theta).subspan(first, count)},
             number + first);
  });
}

}  // namespace ortung
