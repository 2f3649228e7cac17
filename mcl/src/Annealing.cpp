#include "Annealing.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "Resampling.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {
namespace {

constexpr double kWorth = 0.5;  ///< share of the set that each rise of b leaves effective
constexpr int kMostRises = 12;  ///< of b, even if 1 is not reached
constexpr double kStepMetres[] = {0.15, 0.05};  ///< sigma of a Metropolis step, coarse and fine [m]
constexpr double kStepRadians[] = {0.08, 0.02};  ///< [rad]
// Sigmas of a sample's surroundings, at least: motion models promise more than wheels keep.
constexpr double kLeastMetres = 0.06;   ///< [m]
constexpr double kMostMetres = 0.15;    ///< at most [m]
constexpr double kMostRadians = 0.1;    ///< [rad]
constexpr double kLeastRadians = 0.03;  ///< [rad]

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

Annealing::Annealing(Weigh weigh, Within within)
    : weigh_(std::move(weigh)), within_(std::move(within)) {}

Annealing::Annealing(Weigh weigh, const std::array<double, 9>& covariance, std::size_t samples)
    : weigh_(std::move(weigh)), isOfBelief_(true) {
  // Silverman's rule for three dimensions: h = (4 / (5 n))^(1/7).
  const double h =
      std::pow(4.0 / (5.0 * static_cast<double>(std::max<std::size_t>(samples, 1))), 1.0 / 7.0);
  const Eigen::Map<const Eigen::Matrix3d> whole(covariance.data());
  // A wide belief is no Gaussian, but bent around what was seen: its parts are smaller than it.
  const double shrunk =
      std::min({1.0, kMostMetres / (h * std::sqrt(std::max(whole(0, 0), whole(1, 1)))),
                kMostRadians / (h * std::sqrt(whole(2, 2)))});
  const Eigen::Matrix3d surroundings =
      h * h * shrunk * shrunk * whole + Eigen::Vector3d(kLeastMetres * kLeastMetres,
                                                        kLeastMetres * kLeastMetres,
                                                        kLeastRadians * kLeastRadians)
                                            .asDiagonal()
                                            .toDenseMatrix();
  Eigen::Map<Eigen::Matrix3d>(precision_.data()) = surroundings.inverse();
  mostMetres_ = std::sqrt(std::max(surroundings(0, 0), surroundings(1, 1)));
  mostRadians_ = std::sqrt(surroundings(2, 2));
}

Annealing::Drawn Annealing::draw(SampleSet from, std::size_t n, const Random& random) const {
  double logEvidence = 0.0;
  Climbing some{std::move(from), {}, {}};
  weigh_(some.set, some.fit);
  if (isOfBelief_) some.origins = some.set;
  Random offsets = random.fork(1);
  double exponent = 0.0;
  for (int rise = 0; exponent < 1.0 && rise < kMostRises; ++rise) {
    const std::vector<float> rest = scaled(some.fit, 1.0 - exponent);
    const double share = temperFor(rest, kWorth * static_cast<double>(n));
    const std::vector<float> risen = scaled(rest, share);
    logEvidence += logMean(risen);
    const auto indices = lowVariance(normalized(risen), n, offsets.uniform());
    exponent = share >= 1.0 ? 1.0 : exponent + share * (1.0 - exponent);
    some.set = ortung::taken(some.set, indices);
    if (isOfBelief_) some.origins = ortung::taken(some.origins, indices);
    some.fit = taken(some.fit, indices);
    climb(some, exponent, random.fork(2 + static_cast<std::uint64_t>(rise)));
  }
  some.set.logWeight = scaled(some.fit, 1.0 - exponent);
  logEvidence += logMean(some.set.logWeight);
  return {std::move(some.set), logEvidence};
}

double Annealing::logPriorOf(const Climbing& some, std::size_t i, float x, float y,
                             float theta) const {
  if (!isOfBelief_) return 0.0;
  const Eigen::Vector3d off(
      static_cast<double>(x - some.origins.x[i]), static_cast<double>(y - some.origins.y[i]),
      wrapAngle(static_cast<double>(theta) - static_cast<double>(some.origins.theta[i])));
  return -0.5 * off.dot(Eigen::Map<const Eigen::Matrix3d>(precision_.data()) * off);
}

/// Metropolis steps whose invariant distribution is p^exponent times what is known before.
void Annealing::climb(Climbing& some, double exponent, Random random) const {
  SampleSet& set = some.set;
  SampleSet proposed;
  proposed.resize(set.size());
  std::vector<float> proposedFit;
  for (std::size_t k = 0; k < std::size(kStepMetres); ++k) {
    const double metres = std::min(kStepMetres[k], mostMetres_);
    const double radians = std::min(kStepRadians[k], mostRadians_);
    for (std::size_t i = 0; i < set.size(); ++i) {
      proposed.x[i] = set.x[i] + static_cast<float>(metres * random.gaussian());
      proposed.y[i] = set.y[i] + static_cast<float>(metres * random.gaussian());
      proposed.theta[i] = set.theta[i] + static_cast<float>(radians * random.gaussian());
    }
    weigh_(proposed, proposedFit);
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double gain = exponent * static_cast<double>(proposedFit[i] - some.fit[i]) +
                          logPriorOf(some, i, proposed.x[i], proposed.y[i], proposed.theta[i]) -
                          logPriorOf(some, i, set.x[i], set.y[i], set.theta[i]);
      const bool accepted = random.uniform() < std::exp(std::min(0.0, gain));
      if (!accepted || (within_ && !within_(proposed.x[i], proposed.y[i], proposed.theta[i])))
        continue;
      set.x[i] = proposed.x[i];
      set.y[i] = proposed.y[i];
      set.theta[i] = proposed.theta[i];
      some.fit[i] = proposedFit[i];
    }
  }
}

}  // namespace ortung
