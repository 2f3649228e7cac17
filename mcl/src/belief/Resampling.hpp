#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/mcl/SampleSet.hpp"

// Weights of samples, and drawing by them with low variance: when an update resamples, and wherever
// a set grows, shrinks or climbs (annealing, hypotheses, delays, samples that drift).
namespace ortung {

class Workers;  // those who take some: borrowed, and the result does not depend on them

/// Weights of @p logWeights, scaled to sum 1. All-equal weights where none is finite (all lost).
ORTUNG_API std::vector<double> normalized(std::span<const float> logWeights,
                                          Workers* workers = nullptr);

/// ln of the mean of e^v: of all alike, or by weights that sum to 1.
ORTUNG_API double logMean(std::span<const float> values);
ORTUNG_API double logMean(std::span<const double> weights, std::span<const float> values,
                          Workers* workers = nullptr);
/// The same over a part of them, whose weights count as they compare with each other.
ORTUNG_API double logMeanOfPart(std::span<const double> weights, std::span<const float> values,
                                std::size_t first, std::size_t count);

/// 1 / sum w^2 of normalized weights: how many equal samples they are worth.
ORTUNG_API double effectiveSamples(std::span<const double> weights);

/// Low-variance resampling (Thrun, Burgard, Fox, table 4.4): @p n indices, each i about
/// n * weights[i] times. @param offset in [0, 1) @pre the weights sum to 1
ORTUNG_API std::vector<std::uint32_t> lowVariance(std::span<const double> weights, std::size_t n,
                                                  double offset, Workers* workers = nullptr);

/// The samples at these indices, all of the same weight.
SampleSet taken(const SampleSet& from, std::span<const std::uint32_t> indices,
                Workers* workers = nullptr);

/// Adds samples that have @p share of all weight from then on. @pre 0 < share < 1
ORTUNG_API void add(SampleSet& set, const SampleSet& fresh, double share);

/// Exponent b in (0, 1] for which the weights w^b are worth at least @p least samples:
/// candidates are drawn by w^b and keep w^(1-b), so that a sharp reading does not leave only one.
ORTUNG_API double temperFor(std::span<const float> logWeights, double least);

}  // namespace ortung
