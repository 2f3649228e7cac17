#include "PoseSearch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Resampling.hpp"

namespace ortung {
namespace {

constexpr double kWorth = 0.5;  ///< share of the set that each rise of b leaves effective
constexpr int kMostRises = 12;  ///< of b, even if 1 is not reached
constexpr double kStepMetres[] = {0.15, 0.05};  ///< sigma of a Metropolis step, coarse and fine [m]
constexpr double kStepRadians[] = {0.08, 0.02};  ///< [rad]

std::vector<float> taken(const std::vector<float>& from,
                         const std::vector<std::uint32_t>& indices) {
  std::vector<float> values(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) values[i] = from[indices[i]];
  return values;
}

std::vector<float> scaled(const std::vector<float>& values, double factor) {
  std::vector<float> products(values.size());
  std::transform(values.begin(), values.end(), products.begin(),
                 [factor](float v) { return static_cast<float>(factor) * v; });
  return products;
}

}  // namespace

PoseSearch::PoseSearch(const FieldRegion& region) : region_(region) {
  for (std::size_t cell = 0; cell < region.standable.size(); ++cell) {
    if (region.standable[cell] != 0) standable_.push_back(static_cast<std::uint32_t>(cell));
  }
}

SampleSet PoseSearch::anywhere(std::size_t n, Random random) const {
  SampleSet set;
  set.resize(n);
  const double half = 0.5 * region_.grid.cell;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t cell = standable_[random.below(standable_.size())];
    set.x[i] = static_cast<float>(region_.grid.centreX(cell) + random.uniform(-half, half));
    set.y[i] = static_cast<float>(region_.grid.centreY(cell) + random.uniform(-half, half));
    set.theta[i] = static_cast<float>(random.uniform(-std::numbers::pi, std::numbers::pi));
    set.logWeight[i] = 0.0F;
  }
  return set;
}

SampleSet PoseSearch::around(const Ring& ring, std::size_t n, Random random) {
  SampleSet set;
  set.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double distance = ring.radius * std::sqrt(random.uniform());
    const double direction = random.uniform(-std::numbers::pi, std::numbers::pi);
    set.x[i] = static_cast<float>(ring.pose.x + distance * std::cos(direction));
    set.y[i] = static_cast<float>(ring.pose.y + distance * std::sin(direction));
    set.theta[i] = static_cast<float>(ring.pose.theta + random.uniform(-ring.turn, ring.turn));
    set.logWeight[i] = 0.0F;
  }
  return set;
}

PoseSearch::Within PoseSearch::within(std::span<const Ring> rings) {
  return [rings](float x, float y, float theta) {
    return std::any_of(rings.begin(), rings.end(), [&](const Ring& ring) {
      return std::hypot(x - ring.pose.x, y - ring.pose.y) <= ring.radius &&
             std::abs(wrapAngle(theta - ring.pose.theta)) <= ring.turn;
    });
  };
}

PoseSearch::Drawn PoseSearch::draw(std::size_t n, double candidates, const Weigh& weigh,
                                   const Random& random, const std::optional<Ring>& ring) const {
  const auto tried = static_cast<std::size_t>(candidates * static_cast<double>(n));
  if (ring)
    return anneal(around(*ring, tried, random.fork(0)), n, weigh, random, within({&*ring, 1}));
  return anneal(anywhere(tried, random.fork(0)), n, weigh, random, [&](float x, float y, float) {
    const std::ptrdiff_t cell = region_.grid.cellAt(x, y);
    return cell >= 0 && region_.standable[static_cast<std::size_t>(cell)] != 0;
  });
}

PoseSearch::Drawn PoseSearch::drawFrom(std::span<const Ring> rings, std::size_t n,
                                       double candidates, const Weigh& weigh,
                                       const Random& random) const {
  const auto tried = static_cast<std::size_t>(candidates * static_cast<double>(n));
  const std::size_t each = (tried + rings.size() - 1) / rings.size();
  SampleSet set;
  double volume = 0.0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    // Streams beyond those of the annealing.
    const SampleSet some = around(rings[i], each, random.fork(1000 + i));
    set.x.insert(set.x.end(), some.x.begin(), some.x.end());
    set.y.insert(set.y.end(), some.y.begin(), some.y.end());
    set.theta.insert(set.theta.end(), some.theta.begin(), some.theta.end());
    volume += std::numbers::pi * rings[i].radius * rings[i].radius * 2.0 * rings[i].turn;
  }
  set.logWeight.assign(set.x.size(), 0.0F);
  Drawn drawn = anneal(std::move(set), n, weigh, random, within(rings));
  const double floor = static_cast<double>(cells()) * region_.grid.cell * region_.grid.cell;
  drawn.logEvidence += std::log(volume / (floor * 2.0 * std::numbers::pi));
  return drawn;
}

PoseSearch::Drawn PoseSearch::drawNear(SampleSet from, std::size_t n, const Weigh& weigh,
                                       const Random& random) {
  return anneal(std::move(from), n, weigh, random, [](float, float, float) { return true; });
}

/// @param set of equal weights, from which the annealing begins
PoseSearch::Drawn PoseSearch::anneal(SampleSet set, std::size_t n, const Weigh& weigh,
                                     const Random& random, const Within& within) {
  double logEvidence = 0.0;
  std::vector<float> fit;
  weigh(set, fit);
  Random offsets = random.fork(1);
  double exponent = 0.0;
  for (int rise = 0; exponent < 1.0 && rise < kMostRises; ++rise) {
    const std::vector<float> rest = scaled(fit, 1.0 - exponent);
    const double share = temperFor(rest, kWorth * static_cast<double>(n));
    const std::vector<float> risen = scaled(rest, share);
    logEvidence += logMean(risen);
    const auto indices = lowVariance(normalized(risen), n, offsets.uniform());
    exponent = share >= 1.0 ? 1.0 : exponent + share * (1.0 - exponent);
    set = taken(set, indices);
    fit = taken(fit, indices);
    climb(set, fit, exponent, weigh, random.fork(2 + static_cast<std::uint64_t>(rise)), within);
  }
  set.logWeight = scaled(fit, 1.0 - exponent);
  logEvidence += logMean(set.logWeight);
  return {std::move(set), logEvidence};
}

/// Metropolis steps whose invariant distribution is p^exponent over the poses to draw from.
void PoseSearch::climb(SampleSet& set, std::vector<float>& fit, double exponent, const Weigh& weigh,
                       Random random, const Within& within) {
  SampleSet proposed;
  proposed.resize(set.size());
  std::vector<float> proposedFit;
  for (std::size_t k = 0; k < std::size(kStepMetres); ++k) {
    for (std::size_t i = 0; i < set.size(); ++i) {
      proposed.x[i] = set.x[i] + static_cast<float>(kStepMetres[k] * random.gaussian());
      proposed.y[i] = set.y[i] + static_cast<float>(kStepMetres[k] * random.gaussian());
      proposed.theta[i] = set.theta[i] + static_cast<float>(kStepRadians[k] * random.gaussian());
    }
    weigh(proposed, proposedFit);
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double chance = std::exp(std::min(0.0, exponent * (proposedFit[i] - fit[i])));
      const bool accepted = random.uniform() < chance;
      if (!accepted || !within(proposed.x[i], proposed.y[i], proposed.theta[i])) continue;
      set.x[i] = proposed.x[i];
      set.y[i] = proposed.y[i];
      set.theta[i] = proposed.theta[i];
      fit[i] = proposedFit[i];
    }
  }
}

}  // namespace ortung
