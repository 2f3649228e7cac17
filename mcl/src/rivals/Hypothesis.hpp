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

/// What one moment's readings say, for whoever asks.
struct Evidence {
  Annealing::Weigh weigh;                       ///< ln p(readings | sample)
  std::function<double(const SampleSet&)> fit;  ///< how well samples explain them: as fitOf() says
};

/// One account of where the robot is, as weighted samples. The belief is one; others are followed
/// beside it: around the estimate and elsewhere while readings fit badly (Rivals), and one for each
/// delay that may have begun (Lateness). They differ in what moves them, and in how long they must
/// lead before they take over; readings weigh them all alike. Not thread-safe.
class ORTUNG_API Hypothesis {
 public:
  /// What a moment's readings say of each sample, before it is taken in.
  struct Said {
    std::vector<double> before;  ///< weights so far, sum 1
    std::vector<float> logs;     ///< ln p(readings | sample)
    double logEvidence = 0.0;    ///< ln p(readings | hypothesis)
    /// The same of a part of the samples alone.
    double logEvidenceOf(std::size_t first, std::size_t count) const;
  };
  /// How readings come in that are far sharper than the hypothesis: by degrees, while its samples
  /// climb.
  struct Climb {
    std::size_t from;        ///< samples that begin, drawn by their weights so far
    std::size_t to;          ///< samples that arrive
    Random offset;           ///< random numbers that draw those that begin
    Random random;           ///< random numbers of the climb
    bool isOfBelief = true;  ///< each stays within its own surroundings; else it may go anywhere
  };

  explicit Hypothesis(SampleSet samples = {}) : samples_(std::move(samples)) {}

  const SampleSet& samples() const { return samples_; }
  /// Other samples for the same hypothesis: its lead stays.
  void setSamples(SampleSet samples) { samples_ = std::move(samples); }
  /// Adds samples that have @p share of all weight from then on. @pre 0 < share < 1
  void add(const SampleSet& fresh, double share);
  /// Keeps the first @p n. @pre n <= size()
  void keepFirst(std::size_t n) { samples_.resize(n); }
  /// Weights matter up to a common factor only: makes the largest 1, so that numbers stay small.
  void scaleWeights();
  /// Weights, sum 1. @param workers borrowed, may be null, here and below
  std::vector<double> weights(Workers* workers = nullptr) const;

  /// Moves all samples (eq. 8). @param number of the noise of the first one
  /// @param moveSome as MotionModel::sampleMotion: some samples, and the number of their first
  template <class MoveSome>
  void move(std::size_t number, const MoveSome& moveSome, Workers* workers = nullptr);

  Said ask(const Evidence& evidence, Workers* workers = nullptr) const;
  /// Takes in what the readings have said (eq. 7). @param below effective samples: if fewer are
  /// left, none is at the top of the hill, and they climb @param climb how; asked only then
  /// @returns the weights, sum 1
  std::vector<double> takeIn(const Said& said, const Evidence& evidence, const MclConfig& config,
                             double below, const std::function<Climb()>& climb,
                             Workers* workers = nullptr);
  /// Both. @returns what was said
  Said weigh(const Evidence& evidence, const MclConfig& config, double below,
             const std::function<Climb()>& climb, Workers* workers = nullptr);

  /// Counts what readings say for it against the belief. They speak for it only where they fit as
  /// they use to; against it always.
  /// @param ratio of ln p(readings) here to that of the belief [nats]
  /// @param part of the way at which readings are independent @returns whether it counted
  bool count(double ratio, double part, bool isUsual);
  const Lead& lead() const { return lead_; }
  void forgetLead() { lead_ = {}; }
  /// Readings on end that did not fit as they use to.
  int unusual() const { return unusual_; }

 private:
  SampleSet climbed(const Said& said, const Evidence& evidence, const MclConfig& config,
                    Climb climb) const;

  SampleSet samples_;
  Lead lead_;
  int unusual_ = 0;
};

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
