#include "ortung/study/Evaluation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "ortung/base/Statistics.hpp"
#include "ortung/study/Verdict.hpp"

namespace ortung {
namespace {

/// Quantile of chi-square with 3 degrees of freedom for 99.9 %.
constexpr double kNeesBound = 16.266;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double rootMeanSquare(const std::vector<double>& values) {
  if (values.empty()) return kNan;
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Returns e^T P^-1 e for the covariance P; NaN if P is not positive definite.
double squaredInSigmas(const Eigen::Vector3d& e, const PoseCovariance& p) {
  const Eigen::LDLT<Eigen::Matrix3d> decomposed(Eigen::Map<const Eigen::Matrix3d>(p.data()));
  if (decomposed.info() != Eigen::Success || !(decomposed.vectorD().minCoeff() > 0.0)) return kNan;
  return e.dot(decomposed.solve(e));
}

/// Computes the figures of the points from a time on.
void addErrors(const std::vector<EvaluationPoint>& points, Timestamp since, double lostMetres,
               EvaluationErrors& errors) {
  std::vector<double> position;
  std::vector<double> heading;
  std::vector<double> nees;
  double lost = 0.0;
  for (const EvaluationPoint& p : points) {
    if (p.stamp < since) continue;
    position.push_back(p.positionError);
    heading.push_back(p.headingError);
    lost += p.positionError > lostMetres ? 1.0 : 0.0;
    const double squared = squaredInSigmas({p.estimate.x - p.truth.x, p.estimate.y - p.truth.y,
                                            wrapAngle(p.estimate.theta - p.truth.theta)},
                                           p.covariance);
    if (std::isfinite(squared)) nees.push_back(squared);
  }
  if (position.empty()) return;
  errors.positionRmse = rootMeanSquare(position);
  errors.positionMedian = quantile(position, 0.5);
  errors.positionP95 = quantile(position, 0.95);
  errors.positionP99 = quantile(position, 0.99);
  errors.positionMax = *std::max_element(position.begin(), position.end());
  errors.headingRmse = rootMeanSquare(heading);
  errors.lostShare = lost / static_cast<double>(position.size());
  if (nees.empty()) return;
  errors.neesMean =
      std::accumulate(nees.begin(), nees.end(), 0.0) / static_cast<double>(nees.size());
  const auto above =
      std::count_if(nees.begin(), nees.end(), [](double n) { return n > kNeesBound; });
  errors.neesAboveShare = static_cast<double>(above) / static_cast<double>(nees.size());
}

/// Adds how protection levels hold.
void addProtection(const std::vector<EvaluationPoint>& points, EvaluationResult& result) {
  const auto isBeyond = [](const EvaluationPoint& p) {
    return p.positionError > p.protection.metres || p.headingError > p.protection.radians;
  };
  const auto beyondShare = [&](TrackStatus status) {
    double count = 0.0;
    double beyond = 0.0;
    for (const EvaluationPoint& p : points) {
      if (p.status != status) continue;
      count += 1.0;
      if (isBeyond(p)) beyond += 1.0;
    }
    return count > 0.0 ? beyond / count : kNan;
  };
  result.beyondProtectionShare = beyondShare(TrackStatus::kTracking);
  result.beyondProtectionUncertainShare = beyondShare(TrackStatus::kUncertain);
  std::vector<double> levels;
  std::vector<double> errors;
  for (const EvaluationPoint& p : points) {
    if (p.status != TrackStatus::kTracking) continue;
    levels.push_back(p.protection.metres);
    errors.push_back(p.positionError);
  }
  if (levels.empty()) return;
  result.protectionMedian = quantile(levels, 0.5);
  result.protectionRatio = result.protectionMedian / quantile(errors, 0.5);
}

}  // namespace

std::optional<Pose2> interpolate(const std::vector<std::pair<Timestamp, Pose2>>& truth,
                                 Timestamp stamp, double longestGap) {
  const auto after =
      std::lower_bound(truth.begin(), truth.end(), stamp,
                       [](const auto& entry, Timestamp t) { return entry.first < t; });
  if (after == truth.end()) return std::nullopt;
  if (after->first == stamp) return after->second;
  if (after == truth.begin()) return std::nullopt;
  const auto before = after - 1;
  const double gap = toSeconds(after->first - before->first);
  if (gap > longestGap) return std::nullopt;
  const double share = toSeconds(stamp - before->first) / gap;
  const Pose2& a = before->second;
  const Pose2& b = after->second;
  return Pose2{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
               wrapAngle(a.theta + share * wrapAngle(b.theta - a.theta))};
}

Evaluation::Evaluation(const Options& options) : options_(options) {
  if (!(options_.period >= 1e-3))
    throw std::invalid_argument("Evaluation::Options::period is " +
                                std::to_string(options_.period) + " s, must be at least 0.001");
}
Evaluation::~Evaluation() = default;

void Evaluation::addTruth(Timestamp stamp, const Pose2& pose) {
  if (!truth_.empty() && stamp < truth_.back().first)
    throw std::invalid_argument("ground truth: time runs backwards");
  truth_.emplace_back(stamp, pose);
}

void Evaluation::addStep(const EvaluationStep& step) {
  if (!steps_.empty() && step.estimate.stamp < steps_.back().estimate.stamp) {
    throw std::invalid_argument("estimates: time runs backwards");
  }
  steps_.push_back(step);
}

void Evaluation::addTime(Timestamp stamp) {
  if (!first_) first_ = stamp;
  last_ = std::max(last_, stamp);
}

void Evaluation::addMoment(const PoseEstimate& estimate) {
  if (!moments_.empty() && estimate.stamp < moments_.back().stamp) {
    throw std::invalid_argument("estimates: time runs backwards");
  }
  moments_.push_back(estimate);
}

std::vector<Timestamp> Evaluation::due(Timestamp stamp, bool hasTruth) {
  if (!firstDue_) firstDue_ = lastDue_ = stamp;
  if (stamp < lastDue_) throw std::invalid_argument("moments: time runs backwards");
  const Timestamp period = fromSeconds(options_.period);
  std::vector<Timestamp> times;
  // Times that were due at the beginning of a gap are compared; the truth within the gap is
  // unknown.
  const bool isGap = toSeconds(stamp - lastDue_) > options_.longestGap;
  const Timestamp end = isGap ? lastDue_ + 1 : stamp;
  for (; *firstDue_ + nextDue_ * period < end; ++nextDue_)
    times.push_back(*firstDue_ + nextDue_ * period);
  if (rareTruth_ && *rareTruth_ < stamp) {
    if (times.empty() || times.front() != *rareTruth_) times.insert(times.begin(), *rareTruth_);
    rareTruth_.reset();
  }
  if (isGap) nextDue_ = (stamp - *firstDue_ + period - 1) / period;
  const bool isRare =
      truth_.empty() || toSeconds(stamp - truth_.back().first) > options_.longestGap;
  if (hasTruth && isRare) rareTruth_ = stamp;
  lastDue_ = stamp;
  return times;
}

/// Returns the errors of estimates at whose times the truth is known.
std::vector<EvaluationPoint> Evaluation::compare(const std::vector<PoseEstimate>& estimates) const {
  std::vector<EvaluationPoint> points;
  for (const PoseEstimate& e : estimates) {
    const auto truth = interpolate(truth_, e.stamp, options_.longestGap);
    if (!truth) continue;
    const double turn = wrapAngle(e.pose.theta - truth->theta);
    const bool followsGap =
        !points.empty() && toSeconds(e.stamp - points.back().stamp) > options_.longestGap;
    points.push_back({e.stamp, *truth, e.pose, distance(e.pose, *truth), std::abs(turn), e.samples,
                      e.covariance, followsGap, e.quality, e.status, e.protection});
  }
  return points;
}

EvaluationResult Evaluation::result(const std::string& source) const {
  EvaluationResult r;
  r.source = source;
  r.period = options_.period;
  r.steps = steps_.size();
  r.duration = first_ ? toSeconds(last_ - *first_) : 0.0;
  std::vector<double> milliseconds;
  double spent = 0.0;  // [s]
  std::vector<PoseEstimate> corrections;
  for (const EvaluationStep& step : steps_) {
    milliseconds.push_back(step.updateMilliseconds);
    spent += step.spentMilliseconds / 1000.0;
    corrections.push_back(step.estimate);
    r.particlesMean +=
        static_cast<double>(step.estimate.samples) / static_cast<double>(steps_.size());
  }
  r.updateMsP50 = quantile(milliseconds, 0.5);
  r.updateMsP99 = quantile(milliseconds, 0.99);
  r.updateMsMax = quantile(milliseconds, 1.0);
  r.realtimeFactor = spent > 0.0 ? r.duration / spent : kNan;

  r.points = compare(moments_);
  const std::vector<EvaluationPoint> atCorrections = compare(corrections);
  r.overTime.compared = r.points.size();
  r.atCorrections.compared = atCorrections.size();
  if (r.points.empty()) return r;
  const auto shareOf = [&](auto holds) {
    return static_cast<double>(std::count_if(r.points.begin(), r.points.end(), holds)) /
           static_cast<double>(r.points.size());
  };
  r.trackingShare =
      shareOf([](const EvaluationPoint& p) { return p.status == TrackStatus::kTracking; });
  r.wrongWhileTrackingShare = shareOf([&](const EvaluationPoint& p) {
    return p.status == TrackStatus::kTracking && p.positionError > options_.lostMetres;
  });
  addProtection(r.points, r);
  const Timestamp begin = r.points.front().stamp;
  const Verdict converged =
      judge(r.points, begin, std::numeric_limits<Timestamp>::max(),
            {options_.convergedMetres, options_.convergedRadians, options_.convergedSeconds});
  if (converged.state != Verdict::State::kRight) return r;
  const Timestamp since = converged.stamp;
  r.convergedAfter = toSeconds(since - first_.value_or(begin));
  r.convergedDistance = converged.travelled;
  addErrors(r.points, since, options_.lostMetres, r.overTime);
  addErrors(atCorrections, since, options_.lostMetres, r.atCorrections);
  return r;
}

}  // namespace ortung
