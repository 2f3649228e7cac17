#include "Annealing.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

/// Returns what finds the exponent that temperFor() does, from a regular subset if there are very
/// many weights.
Tempering temperingOf(const std::vector<float>& logWeights, double least) {
  const std::size_t stride = (logWeights.size() + kMostTempered - 1) / kMostTempered;
  if (stride <= 1) return {logWeights, least};
  std::vector<float> some;
  for (std::size_t i = 0; i < logWeights.size(); i += stride) some.push_back(logWeights[i]);
  return {std::move(some), least / static_cast<double>(stride)};
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

Annealing::Drawn Annealing::draw(SampleSet from, std::size_t n, const Random& random,
                                 const IsOver& isOver) const {
  Draw drawing(*this, std::move(from), n, random);
  drawing.finish(isOver);
  return drawing.take();
}

Annealing::Draw::Draw(Annealing annealing, SampleSet from, std::size_t n, const Random& random)
    : annealing_(std::move(annealing)),
      n_(n),
      random_(random),
      offsets_(random.fork(1)),
      climb_(random),
      stage_(n == 0 ? Stage::kDone : Stage::kWeigh),
      weighing_(std::move(from)) {}

std::size_t Annealing::Draw::work(std::size_t most) {
  switch (stage_) {
    case Stage::kPropose:
      propose(most);
      break;
    case Stage::kWeigh:
      return weigh(most);
    case Stage::kTemper:
      temper();
      break;
    case Stage::kRise:
      rise();
      break;
    case Stage::kAccept:
      accept(most);
      break;
    case Stage::kDone:
      break;
  }
  return 0;
}

/// The first pass weighs the initial samples, each later one the proposals of a Metropolis step.
std::size_t Annealing::Draw::weigh(std::size_t most) {
  const std::size_t first = fit_.size();
  const std::size_t count = std::min(weighing_.size() - first, most);
  const bool isWhole = count == weighing_.size();
  std::vector<float> some;  // a local copy: if a plugin throws, nothing has changed
  annealing_.weigh_(isWhole ? weighing_ : weighing_.part(first, count), some);
  if (isWhole)
    fit_ = std::move(some);
  else
    fit_.insert(fit_.end(), some.begin(), some.end());
  if (fit_.size() < weighing_.size()) return count;
  if (rises_ > 0) {
    stage_ = Stage::kAccept;
    next_ = 0;
    return count;
  }
  climbing_ = {std::move(weighing_), {}, std::move(fit_)};
  if (annealing_.isOfBelief_) climbing_.origins = climbing_.set;
  beginRise();
  return count;
}

void Annealing::Draw::beginStep() {
  stage_ = Stage::kPropose;
  next_ = 0;
  weighing_.resize(climbing_.set.size());
  std::fill(weighing_.logWeight.begin(), weighing_.logWeight.end(), 0.0F);
}

void Annealing::Draw::propose(std::size_t most) {
  const std::size_t count = std::min(weighing_.size() - next_, most);
  annealing_.propose(climbing_.set, step_, climb_, next_, count, weighing_);
  next_ += count;
  if (next_ < weighing_.size()) return;
  stage_ = Stage::kWeigh;
  fit_.clear();
}

void Annealing::Draw::accept(std::size_t most) {
  const std::size_t count = std::min(weighing_.size() - next_, most);
  annealing_.accept(climbing_, weighing_, fit_, exponent_, climb_, next_, count);
  next_ += count;
  if (next_ < weighing_.size()) return;
  if (++step_ == std::size(kStepMetres))
    beginRise();
  else
    beginStep();
}

void Annealing::Draw::finish(const IsOver& isOver) {
  while (!isDone()) {
    if (isNow(isOver)) hasten();
    work(isOver ? kTimedPoses : std::numeric_limits<std::size_t>::max());
  }
}

/// Leaves out what is left of the annealing: what the exponents lack of 1 stays in the samples'
/// weights. Only the initial samples must still be weighed.
void Annealing::Draw::hasten() {
  isHastened_ = true;
  if (rises_ > 0 && !isDone()) end();
}

void Annealing::Draw::beginRise() {
  if (exponent_ >= 1.0 || rises_ == kMostRises) {
    end();
    return;
  }
  stage_ = Stage::kTemper;
  tempering_ =
      temperingOf(scaled(climbing_.fit, 1.0 - exponent_), kWorth * static_cast<double>(n_));
}

void Annealing::Draw::temper() {
  if (tempering_->narrow()) stage_ = Stage::kRise;
}

void Annealing::Draw::rise() {
  const double share = tempering_->exponent();
  tempering_.reset();
  const std::vector<float> rest = scaled(climbing_.fit, 1.0 - exponent_);
  const std::vector<float> risen = scaled(rest, share);
  logEvidence_ += logMean(risen);
  const auto indices = lowVariance(normalized(risen), n_, offsets_.uniform());
  exponent_ = share >= 1.0 ? 1.0 : exponent_ + share * (1.0 - exponent_);
  climbing_.set = ortung::taken(climbing_.set, indices);
  if (annealing_.isOfBelief_) climbing_.origins = ortung::taken(climbing_.origins, indices);
  climbing_.fit = taken(climbing_.fit, indices);
  climb_ = random_.fork(2 + static_cast<std::uint64_t>(rises_++));
  step_ = 0;
  if (isHastened_)
    end();
  else
    beginStep();
}

void Annealing::Draw::end() {
  climbing_.set.logWeight = scaled(climbing_.fit, 1.0 - exponent_);
  logEvidence_ += logMean(climbing_.set.logWeight);
  stage_ = Stage::kDone;
}

double Annealing::logPriorOf(const Climbing& some, std::size_t i, float x, float y,
                             float theta) const {
  if (!isOfBelief_) return 0.0;
  const Eigen::Vector3d off(
      static_cast<double>(x - some.origins.x[i]), static_cast<double>(y - some.origins.y[i]),
      wrapAngle(static_cast<double>(theta) - static_cast<double>(some.origins.theta[i])));
  return -0.5 * off.dot(Eigen::Map<const Eigen::Matrix3d>(precision_.data()) * off);
}

/// Makes some of the proposals of a Metropolis step.
void Annealing::propose(const SampleSet& set, std::size_t step, Random& random, std::size_t first,
                        std::size_t count, SampleSet& proposed) const {
  const double metres = std::min(kStepMetres[step], mostMetres_);
  const double radians = std::min(kStepRadians[step], mostRadians_);
  for (std::size_t i = first; i < first + count; ++i) {
    proposed.x[i] = set.x[i] + static_cast<float>(metres * random.gaussian());
    proposed.y[i] = set.y[i] + static_cast<float>(metres * random.gaussian());
    proposed.theta[i] = set.theta[i] + static_cast<float>(radians * random.gaussian());
  }
}

/// The acceptance of Metropolis: the invariant distribution is p^exponent times the prior.
void Annealing::accept(Climbing& some, const SampleSet& proposed,
                       std::span<const float> proposedFit, double exponent, Random& random,
                       std::size_t first, std::size_t count) const {
  SampleSet& set = some.set;
  for (std::size_t i = first; i < first + count; ++i) {
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
