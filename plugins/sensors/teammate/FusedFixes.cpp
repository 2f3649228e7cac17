#include "FusedFixes.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>

#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Vector3 = Eigen::Vector3d;

constexpr double kAgree = 11.34;  ///< chi-squared of three degrees of freedom, 99 %

struct Belief {
  Pose2 pose;
  Matrix3 covariance;
  double area() const { return covariance.topLeftCorner<2, 2>().determinant(); }
};

/// Returns the difference from one pose to another, with that of the headings in [-pi, pi).
Vector3 difference(const Pose2& from, const Pose2& to) {
  return {to.x - from.x, to.y - from.y, wrapAngle(to.theta - from.theta)};
}

/// Returns a fix as a belief; impossible correlations are set to 0.
Belief beliefOf(const PoseFixData::Fix& fix, const PoseFixData::Config& added) {
  Belief belief{fix.pose, Eigen::Map<const Matrix3>(fix.covariance.data())};
  const double position = added.addedSigma * added.addedSigma;
  const double heading = added.addedHeadingSigma * added.addedHeadingSigma;
  belief.covariance.diagonal() += Vector3(position, position, heading);
  if (!(belief.area() > 0.0) || !(belief.covariance.determinant() > 0.0))
    belief.covariance = Matrix3(belief.covariance.diagonal().asDiagonal());
  return belief;
}

/// Fuses another belief (Kalman update) unless they contradict each other.
bool join(Belief& belief, const Belief& other) {
  const Vector3 apart = difference(belief.pose, other.pose);
  const Matrix3 inverse = (belief.covariance + other.covariance).inverse();
  if (apart.dot(inverse * apart) > kAgree) return false;
  const Matrix3 gain = belief.covariance * inverse;
  const Vector3 step = gain * apart;
  belief.pose = {belief.pose.x + step[0], belief.pose.y + step[1],
                 wrapAngle(belief.pose.theta + step[2])};
  const Matrix3 left = belief.covariance - gain * belief.covariance;
  belief.covariance = 0.5 * (left + left.transpose());
  return true;
}

}  // namespace

std::vector<PoseFixData::Fix> fused(std::span<const PoseFixData::Fix> fixes,
                                    const PoseFixData::Config& added) {
  std::vector<Belief> beliefs;
  for (const PoseFixData::Fix& fix : fixes) beliefs.push_back(beliefOf(fix, added));
  const auto isSurer = [](const Belief& a, const Belief& b) { return a.area() < b.area(); };
  std::stable_sort(beliefs.begin(), beliefs.end(), isSurer);
  std::vector<Belief> joined;
  for (const Belief& belief : beliefs)
    if (std::none_of(joined.begin(), joined.end(), [&](Belief& one) { return join(one, belief); }))
      joined.push_back(belief);
  std::stable_sort(joined.begin(), joined.end(), isSurer);
  std::vector<PoseFixData::Fix> out;
  for (const Belief& belief : joined) {
    if (out.size() == PoseFixData::kMostFixes) break;
    out.push_back({belief.pose, {}});
    Eigen::Map<Matrix3>(out.back().covariance.data()) = belief.covariance;
  }
  return out;
}

}  // namespace ortung
