#include "Annealing.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "Resampling.hpp"
#include "SearchTuning.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {
namespace {

using namespace tuning::annealing;

// The Metropolis steps at each exponent: coarse, then fine.
const double kStepMetres[] = {kCoarseMetres, kFineMetres};
const double kStepRadians[] = {kCoarseRadians, kFineRadians};

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

/// Returns what temperFor() does, from a regular subset if there are very many weights.
double temperOf(const std::vector<float>& logWeights, double least) {
  const std::size_t stride = (logWeights.size() + kMostTempered - 1) / kMostTempered;
  if (stride <= 1) return temperFor(logWeights, least);
  std::vector<float> some;
  for (std::size_t i = 0; i < logWeights.size(); i += stride) some.push_back(logWeights[i]);
  return temperFor(some, least / static_cast<double>(stride));
}

}  // namespace

Annealing::Annealing(Weigh weigh, Within within)
    : weigh_(std::move(weigh)), within_(std::move(within)) {}

Annealing::Annealing(Weigh weigh, const PoseCovariance& covariance, std::size_t samples)
    : weigh_(std::move(weigh)), isOfBelief_(true) {
  // Silverman's rule for three dimensions: h = (4 / (5 n))^(1/7).
  const double h =
      std::pow(4.0 / (5.0 * static_cast<double>(std::max<std::size_t>(samples, 1))), 1.0 / 7.0);
  const Eigen::Map<const Eigen::Matrix3d> whole(covariance.data());
  // A wide belief is not Gaussian, but often bent (around a landmark, for instance), so its kernels
  // must be smaller than Silverman's rule says.
  const double shrunk =
      std::min({1.0, kCoarseMetres / (h * std::sqrt(std::max(whole(0, 0), whole(1, 1)))),
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
  Draw drawing(*this, std::move(from), n, random);
  while (drawing.work(std::numeric_limits<std::size_t>::max()) > 0) {
  }
  return drawing.take();
}

Annealing::Draw::Draw(Annealing annealing, SampleSet from, std::size_t n, const Random& random)
    : annealing_(std::move(annealing)),
      n_(n),
      random_(random),
      offsets_(random.fork(1)),
      climb_(random),
      weighing_(std::move(from)),
      isDone_(n == 0) {}

std::size_t Annealing::Draw::work(std::size_t most) {
  if (isDone_) return 0;
  const std::size_t first = fit_.size();
  const std::size_t count = std::min(weighing_.size() - first, most);
  const bool isWhole = count == weighing_.size();
  std::vector<float> some;  // a local copy: if a plugin throws, nothing has changed
  annealing_.weigh_(isWhole ? weighing_ : weighing_.part(first, count), some);
  if (isWhole)
    fit_ = std::move(some);
  else
    fit_.insert(fit_.end(), some.begin(), some.end());
  if (fit_.size() == weighing_.size()) endPass();
  return count;
}

/// Continues once all poses of a pass are weighed: the first pass weighs the initial samples, each
/// later one the proposals of a Metropolis step.
void Annealing::Draw::endPass() {
  if (rises_ == 0) {
    climbing_ = {std::move(weighing_), {}, std::move(fit_)};
    if (annealing_.isOfBelief_) climbing_.origins = climbing_.set;
    rise();
    return;
  }
  annealing_.accept(climbing_, weighing_, fit_, exponent_, climb_);
  if (++step_ == std::size(kStepMetres)) {
    rise();
    return;
  }
  weighing_ = annealing_.proposed(climbing_.set, step_, climb_);
  fit_.clear();
}

void Annealing::Draw::rise() {
  if (exponent_ >= 1.0 || rises_ == kMostRises) {
    finish();
    return;
  }
  const std::vector<float> rest = scaled(climbing_.fit, 1.0 - exponent_);
  const double share = temperOf(rest, kWorth * static_cast<double>(n_));
  const std::vector<float> risen = scaled(rest, share);
  logEvidence_ += logMean(risen);
  const auto indices = lowVariance(normalized(risen), n_, offsets_.uniform());
  exponent_ = share >= 1.0 ? 1.0 : exponent_ + share * (1.0 - exponent_);
  climbing_.set = ortung::taken(climbing_.set, indices);
  if (annealing_.isOfBelief_) climbing_.origins = ortung::taken(climbing_.origins, indices);
  climbing_.fit = taken(climbing_.fit, indices);
  climb_ = random_.fork(2 + static_cast<std::uint64_t>(rises_++));
  step_ = 0;
  weighing_ = annealing_.proposed(climbing_.set, step_, climb_);
  fit_.clear();
}

void Annealing::Draw::finish() {
  climbing_.set.logWeight = scaled(climbing_.fit, 1.0 - exponent_);
  logEvidence_ += logMean(climbing_.set.logWeight);
  isDone_ = true;
}

double Annealing::logPriorOf(const Climbing& some, std::size_t i, float x, float y,
                             float theta) const {
  if (!isOfBelief_) return 0.0;
  const Eigen::Vector3d off(
      static_cast<double>(x - some.origins.x[i]), static_cast<double>(y - some.origins.y[i]),
      wrapAngle(static_cast<double>(theta) - static_cast<double>(some.origins.theta[i])));
  return -0.5 * off.dot(Eigen::Map<const Eigen::Matrix3d>(precision_.data()) * off);
}

/// Returns the proposals of a Metropolis step for a set of samples.
SampleSet Annealing::proposed(const SampleSet& set, std::size_t step, Random& random) const {
  const double metres = std::min(kStepMetres[step], mostMetres_);
  const double radians = std::min(kStepRadians[step], mostRadians_);
  SampleSet proposed;
  proposed.resize(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    proposed.x[i] = set.x[i] + static_cast<float>(metres * random.gaussian());
    proposed.y[i] = set.y[i] + static_cast<float>(metres * random.gaussian());
    proposed.theta[i] = set.theta[i] + static_cast<float>(radians * random.gaussian());
  }
  return proposed;
}

/// The acceptance of Metropolis: the invariant distribution is p^exponent times the prior.
void Annealing::accept(Climbing& some, const SampleSet& proposed,
                       std::span<const float> proposedFit, double exponent, Random& random) const {
  SampleSet& set = some.set;
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

}  // namespace ortung
