#include "OdometryModels.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "BeliefTuning.hpp"
#include "MotionTuning.hpp"

namespace ortung {
namespace {

using namespace tuning::odometry;

using Errors = OdometryModels::Errors;
using ErrorMatrix = OdometryModels::ErrorMatrix;
using Effect = OdometryModels::Effect;

constexpr std::size_t kOfModel = 2;  // the factor 1

double factor(std::size_t k) {
  return std::ldexp(1.0, static_cast<int>(kOfModel) - static_cast<int>(k));
}

double square(double v) { return v * v; }

/// Returns the log of what is believed before anything is known.
double prior(std::size_t k) { return k == kOfModel ? 0.0 : -kCaution; }

/// Returns the variances of what is not known of a robot.
Errors variances() {
  return {kScale * kScale, kScale * kScale, kVeer * kVeer, kAhead * kAhead, kTurned * kTurned};
}

}  // namespace

OdometryModels::OdometryModels() : covariance_(variances().asDiagonal()) {
  for (std::size_t k = 0; k < kCount; ++k) {
    models_[k].covariance = covariance_;
    models_[k].log = prior(k);
  }
}

/// How well a model explains where a pose is.
struct OdometryModels::Likely {
  Eigen::Vector3d innovation;
  Effect mixed;  ///< effect of the errors, times their covariance
  Eigen::LDLT<Eigen::Matrix3d> all;
  double squares;  ///< squared Mahalanobis distance
  double log() const { return -0.5 * (squares + all.vectorD().array().log().sum()); }
};

OdometryModels::Likely OdometryModels::likely(const Model& model, double factor, const Seen& seen) {
  Likely its{
      seen.off - seen.effect * (model.errors - seen.used), seen.effect * model.covariance, {}, 0.0};
  its.all.compute(factor * seen.motion + seen.rest + its.mixed * seen.effect.transpose());
  its.squares = its.innovation.dot(its.all.solve(its.innovation));
  return its;
}

void OdometryModels::followNoise(const Seen& step) {
  std::array<double, kCount> logs{};
  for (std::size_t k = 0; k < kCount; ++k) logs[k] = likely(models_[k], factor(k), step).log();
  if (!std::ranges::all_of(logs, [](double log) { return std::isfinite(log); })) return;
  for (std::size_t k = 0; k < kCount; ++k)
    models_[k].log = kKept * models_[k].log + (1.0 - kKept) * prior(k) +
                     std::clamp(logs[k] - logs[kOfModel], -kMostNats, kMostNats);
  mix();
}

void OdometryModels::followErrors(const Seen& way) {
  std::array<Model, kCount> after = models_;
  // What the model's noise does not explain counts the less the farther off it is.
  const double far = likely(models_[kOfModel], 1.0, way).squares / square(tuning::common::kOutlier);
  const double times = std::max(1.0, square(far));
  for (std::size_t k = 0; k < kCount; ++k) {
    Model& model = after[k];
    const Likely its = likely(model, factor(k), way);
    if (!std::isfinite(its.log())) return;
    const Eigen::Matrix<double, 5, 3> gain = its.all.solve(its.mixed).transpose() / times;
    const Errors most{kMostScale, kMostScale, kMostVeer, kMostAhead, kMostTurned};
    model.errors = (model.errors + gain * its.innovation).cwiseMin(most).cwiseMax(-most);
    const ErrorMatrix covariance = model.covariance - gain * its.mixed;
    model.covariance = 0.5 * (covariance + covariance.transpose());
  }
  models_ = after;
  isLearned_ = true;
  mix();
}

void OdometryModels::drift(double way, double turn) {
  const double scale = kScaleDrift * kScaleDrift;
  const Errors drifted{way * scale, std::abs(turn) * scale, way * kVeerDrift * kVeerDrift, 0.0,
                       0.0};
  const auto widen = [&](ErrorMatrix& covariance) {
    const Errors known = covariance.diagonal();
    covariance.diagonal() = (known + drifted).cwiseMin(known.cwiseMax(variances()));
  };
  for (Model& model : models_) widen(model.covariance);
  widen(covariance_);
}

/// Computes mean and covariance over all models.
void OdometryModels::mix() {
  const auto greatest = std::ranges::max_element(models_, {}, &Model::log);
  const double most = greatest->log;
  double sum = 0.0;
  noise_ = 0.0;
  errors_.setZero();
  for (std::size_t k = 0; k < kCount; ++k) {
    models_[k].log -= most;
    const double weight = std::exp(models_[k].log);
    sum += weight;
    noise_ += weight * factor(k);
    errors_ += weight * models_[k].errors;
  }
  noise_ /= sum;
  errors_ /= sum;
  covariance_.setZero();
  for (const Model& model : models_) {
    const Errors apart = model.errors - errors_;
    covariance_ +=
        std::exp(model.log) / sum * (model.covariance + ErrorMatrix(apart * apart.transpose()));
  }
}

}  // namespace ortung
