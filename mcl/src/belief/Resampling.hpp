#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/mcl/SampleSet.hpp"

// Normalizing the weights of samples, and low-variance resampling by them. It is used when an
// update resamples, and wherever a set grows, shrinks or is annealed (hypotheses, delays, process
// noise).
namespace ortung {

class Workers;  // below: borrowed, may be null; no result depends on them

/// Returns the weights of @p logWeights, scaled to sum 1. They are all equal if none is finite.
ORTUNG_API std::vector<double> normalized(std::span<const float> logWeights,
                                          Workers* workers = nullptr);

/// Returns ln of the mean of e^v, unweighted or with weights that sum to 1.
ORTUNG_API double logMean(std::span<const float> values);
ORTUNG_API double logMean(std::span<const double> weights, std::span<const float> values,
                          Workers* workers = nullptr);
/// Returns the same over a part of them, whose weights are normalized within that part.
ORTUNG_API double logMeanOfPart(std::span<const double> weights, std::span<const float> values,
                                std::size_t first, std::size_t count);

/// Returns the effective sample size, 1 / sum w^2 of normalized weights.
ORTUNG_API double effectiveSamples(std::span<const double> weights);

/// Low-variance resampling (Thrun, Burgard, Fox, table 4.4): returns @p n indices, of which about
/// n * weights[i] are i.
/// @param offset random number in [0, 1)
/// @pre the weights sum to 1
ORTUNG_API std::vector<std::uint32_t> lowVariance(std::span<const double> weights, std::size_t n,
                                                  double offset, Workers* workers = nullptr);

/// Returns the samples at these indices, all with the same weight.
SampleSet taken(const SampleSet& from, std::span<const std::uint32_t> indices,
                Workers* workers = nullptr);

/// Adds samples, which then have @p share of the total weight. @pre 0 < share < 1
ORTUNG_API void add(SampleSet& set, const SampleSet& fresh, double share);

/// Returns the exponent b in (0, 1] for which the weights w^b have an effective sample size of at
/// least @p least. Candidates are drawn by w^b and keep w^(1-b), so that a sharp reading does not
/// leave only one of them.
ORTUNG_API double temperFor(std::span<const float> logWeights, double least);

/// The same in several calls: by bisection, each step of which looks at all weights.
class Tempering {
 public:
  Tempering(std::vector<float> logWeights, double least)
      : logs_(std::move(logWeights)), scaled_(logs_.size()), least_(least) {}
  /// Takes a step. @returns whether that was the last one
  ORTUNG_API bool narrow();
  /// @pre narrow() has returned true
  ORTUNG_API double exponent() const;

 private:
  double worthOf(double exponent);

  std::vector<float> logs_;
  std::vector<float> scaled_;
  double least_;
  double low_ = 0.0;
  double high_ = 1.0;
  int steps_ = 0;
};

}  // namespace ortung
