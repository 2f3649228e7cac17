#include "Biases.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "BeliefTuning.hpp"
#include "CarriedOn.hpp"
#include "PoseMatrix.hpp"
#include "RefineTuning.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {
namespace {

using namespace tuning::biases;
using tuning::common::kIndependent, tuning::common::kOutlier;

}  // namespace

void Biases::forget() {
  for (Device& device : devices_) device = {std::move(device.name)};
  mean_ = Eigen::VectorXd::Zero(kPose);
  covariance_ = Eigen::MatrixXd::Zero(kPose, kPose);
  forgetPlace();
}

void Biases::forgetPlace() {
  isRunning_ = false;
  travelled_ = 0.0;
  waits_ = 0;
  for (auto& [data, feature] : features_) feature.learnedAt = -1.0;
}

void Biases::move(const MotionChange& change) {
  if (!isRunning_) return;
  PoseEstimate before;
  before.pose = pose_;
  inPlace(before.covariance) = covariance_.topLeftCorner<3, 3>();
  const PoseEstimate after = carriedOn(before, change);
  const Eigen::Matrix3d forward = derivativeOfMoved(pose_, after.pose);
  const Eigen::Index rest = covariance_.cols() - kPose;
  covariance_.topRightCorner(kPose, rest) = forward * covariance_.topRightCorner(kPose, rest);
  covariance_.bottomLeftCorner(rest, kPose) = covariance_.topRightCorner(kPose, rest).transpose();
  covariance_.topLeftCorner<3, 3>() = matrixOf(after.covariance);
  travelled_ += std::hypot(change.mean.x, change.mean.y) + std::abs(change.mean.theta);
  pose_ = after.pose;
}

Biases::Feature& Biases::featureOf(const NewReading& news) {
  const auto [at, isNew] = features_.try_emplace(news.feature);
  if (isNew) {
    const SensorId& id = news.feature->id();
    const std::string name = id.model + "/" + id.type;
    const auto same = std::find_if(devices_.begin(), devices_.end(),
                                   [&](const Device& device) { return device.name == name; });
    at->second.device = static_cast<std::size_t>(same - devices_.begin());
    if (same == devices_.end()) devices_.push_back({name});
  }
  return at->second;
}

void Biases::correct(ReadingsByTime& newsByTime) {
  for (auto& [stamp, news] : newsByTime) {
    for (NewReading& one : news) {
      const auto* reading = dynamic_cast<const Correctable*>(one.weigher.get());
      if (!reading) continue;
      const DeviceBias bias = biasOf(featureOf(one).device);
      if (bias == DeviceBias()) continue;
      std::shared_ptr<const Weigher> corrected = reading->corrected(bias);
      one.asRead = std::exchange(one.weigher, std::move(corrected));
    }
  }
}

void Biases::follow(const std::vector<NewReading>& news, const PoseEstimate& estimate) {
  std::vector<ReadingResidual> residuals;
  for (const NewReading& one : news) {
    const Weigher* weigher = (one.asRead ? one.asRead : one.weigher).get();
    const auto* reading = dynamic_cast<const Correctable*>(weigher);
    const auto found = features_.find(one.feature);
    if (!reading || found == features_.end()) continue;
    Feature& feature = found->second;
    if (isRunning_ && feature.learnedAt >= 0.0 && travelled_ - feature.learnedAt < kIndependent)
      continue;
    residuals.clear();
    const Pose2 at = isRunning_ ? pose_ : estimate.pose;
    reading->residualsAt(at, residuals);
    if (residuals.empty()) continue;
    if (!isRunning_) {
      if (estimate.status != TrackStatus::kTracking) {
        waits_ += static_cast<int>(residuals.size());
        // With what is known of the devices readings fit nowhere.
        if (waits_ > kTrusted) forget();
        return;
      }
      begin(estimate, residuals);
    }
    feature.learnedAt = travelled_;
    open(feature.device, residuals);
    for (const ReadingResidual& residual : residuals) {
      const bool fits = learn(feature.device, residual, at);
      fits_ += fits ? 1 : 0;
      misfit_ += kRate * ((fits ? 0.0 : 1.0) - misfit_);
    }
  }
  if (!isRunning_) return;
  if (misfit_ > kMisfits) {
    fits_ < kTrusted ? forget() : forgetPlace();
    return;
  }
  decide();
}

/// Starts the filter from the samples' estimate. Its covariance is widened, since unknown biases
/// may have shifted the samples.
void Biases::begin(const PoseEstimate& estimate, const std::vector<ReadingResidual>& residuals) {
  isRunning_ = true;
  misfit_ = 0.0;
  fits_ = 0;
  pose_ = estimate.pose;
  double metres = 0.1;
  double radians = 0.05;
  for (const ReadingResidual& r : residuals) {
    if (r.isAngle)
      radians = std::max(radians, 2.0 * r.sigma);
    else
      metres = std::max(metres, r.sigma + kScale * r.expected);
  }
  Eigen::Matrix3d pose = matrixOf(estimate.covariance);
  pose.diagonal() += Eigen::Vector3d(metres * metres, metres * metres, radians * radians);
  covariance_.topRows<kPose>().setZero();
  covariance_.leftCols<kPose>().setZero();
  covariance_.topLeftCorner<kPose, kPose>() = pose;
}

void Biases::open(std::size_t device, const std::vector<ReadingResidual>& residuals) {
  const Eigen::Index needed = placeOf(devices_.size());
  const Eigen::Index there = mean_.size();
  if (needed > there) {
    mean_.conservativeResize(needed);
    covariance_.conservativeResize(needed, needed);
    mean_.tail(needed - there).setZero();
    covariance_.rightCols(needed - there).setZero();
    covariance_.bottomRows(needed - there).setZero();
  }
  Device& d = devices_[device];
  const Eigen::Index at = placeOf(device);
  for (const ReadingResidual& r : residuals) {
    if (r.isAngle && !std::exchange(d.hasBearings, true)) {
      covariance_(at + 2, at + 2) = r.sigma * r.sigma;
    } else if (!r.isAngle && !std::exchange(d.hasDistances, true)) {
      covariance_(at, at) = r.sigma * r.sigma;
      covariance_(at + 1, at + 1) = kScale * kScale;
    }
  }
}

/// Updates the filter by one residual.
/// @param at pose for which the residual was computed
/// @returns whether it is an inlier
bool Biases::learn(std::size_t device, const ReadingResidual& r, const Pose2& at) {
  const Eigen::Index n = mean_.size();
  Eigen::VectorXd by = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < kPose; ++k) by[k] = r.byPose[static_cast<std::size_t>(k)];
  if (!by.allFinite()) return true;
  const Eigen::Index place = placeOf(device);
  if (r.isAngle) {
    by[place + 2] = 1.0;
  } else {
    by[place] = 1.0;
    by[place + 1] = r.expected;
  }
  const Eigen::Vector3d moved = difference(pose_, at);
  double off = r.value - by.head<3>().dot(moved) - by.tail(n - kPose).dot(mean_.tail(n - kPose));
  if (r.isAngle) off = wrapAngle(off);
  const Eigen::VectorXd cross = covariance_ * by;
  const double known = by.dot(cross);
  const double variance = known + r.sigma * r.sigma;
  if (!(off * off < kOutlier * kOutlier * variance)) return false;
  const double inlier = (1.0 - r.outliers) * std::exp(-0.5 * off * off / variance);
  const double noise = r.sigma * r.sigma * (inlier + r.outliers) / inlier;
  const Eigen::VectorXd gain = cross / (known + noise);
  const Eigen::VectorXd change = gain * off;
  mean_.tail(n - kPose) += change.tail(n - kPose);
  pose_ = {pose_.x + change[0], pose_.y + change[1], wrapAngle(pose_.theta + change[2])};
  ++devices_[device].values;
  covariance_ -= gain * cross.transpose();
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
  return true;
}

void Biases::decide() {
  for (std::size_t d = 0; d < devices_.size(); ++d) {
    Device& device = devices_[d];
    const Eigen::Index at = placeOf(d);
    const auto isOther = [&](bool isKnown, double square) {
      const double errors = isKnown ? kStillErrors : kOutlier;
      if (device.values < kFewest) return false;
      return square > errors * errors;
    };
    // Offset and scale are tested together, since their errors are correlated.
    if (device.hasDistances) {
      const Eigen::Vector2d both = mean_.segment<2>(at);
      const Eigen::Matrix2d spread = covariance_.block<2, 2>(at, at);
      device.knowsDistances =
          isOther(device.knowsDistances, 0.75 * both.dot(spread.ldlt().solve(both)));
    }
    if (device.hasBearings)
      device.knowsBearings = isOther(device.knowsBearings,
                                     mean_[at + 2] * mean_[at + 2] / covariance_(at + 2, at + 2));
  }
}

DeviceBias Biases::biasOf(std::size_t device) const {
  DeviceBias bias;
  const Eigen::Index at = placeOf(device);
  if (devices_[device].knowsDistances) {
    bias.metres = mean_[at];
    bias.perMetre = mean_[at + 1];
  }
  if (devices_[device].knowsBearings) bias.radians = mean_[at + 2];
  return bias;
}

std::map<std::string, DeviceBias> Biases::known() const {
  std::map<std::string, DeviceBias> all;
  for (std::size_t d = 0; d < devices_.size(); ++d)
    if (const DeviceBias bias = biasOf(d); !(bias == DeviceBias())) all[devices_[d].name] = bias;
  return all;
}

}  // namespace ortung
