#include "CarriedOn.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "MotionTuning.hpp"

namespace ortung {
namespace {

using namespace tuning::carried;

/// Adds noise that is given in the robot's frame, rotated by the heading @p theta into the field
/// frame.
void add(const PoseCovariance& noise, double theta, PoseCovariance& covariance) {
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  const std::array<std::array<double, 3>, 3> turn = {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          covariance[3 * row + column] += turn[row][i] * noise[3 * i + k] * turn[column][k];
}

}  // namespace

MotionChange changeOf(const MotionModel& motion, const Pose2& odometryChange, std::size_t samples,
                      std::uint64_t seed, std::uint64_t stream) {
  std::array<std::vector<float>, 3> drawn;
  for (std::vector<float>& axis : drawn) axis.assign(samples, 0.0F);
  motion.sampleMotion({drawn[0], drawn[1], drawn[2]}, odometryChange, seed, stream, 0);
  const auto n = static_cast<double>(samples);
  // Turns are taken relative to odometry's, so that angles near half a turn do not wrap.
  std::array<std::vector<double>, 3> off;
  for (std::vector<double>& axis : off) axis.resize(samples);
  std::array<double, 3> mean{};
  for (std::size_t i = 0; i < samples; ++i) {
    off[0][i] = static_cast<double>(drawn[0][i]) - odometryChange.x;
    off[1][i] = static_cast<double>(drawn[1][i]) - odometryChange.y;
    off[2][i] = wrapAngle(static_cast<double>(drawn[2][i]) - odometryChange.theta);
    for (std::size_t k = 0; k < 3; ++k) mean[k] += off[k][i] / n;
  }
  MotionChange change;
  change.mean = {odometryChange.x + mean[0], odometryChange.y + mean[1],
                 wrapAngle(odometryChange.theta + mean[2])};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      for (std::size_t i = 0; i < samples; ++i)
        change.covariance[3 * row + column] +=
            (off[row][i] - mean[row]) * (off[column][i] - mean[column]) / n;
  return change;
}

MotionChange changeOf(const MotionModel& motion, const Pose2& odometryChange, std::uint64_t seed,
                      std::uint64_t stream) {
  if (odometryChange.x == 0.0 && odometryChange.y == 0.0 && odometryChange.theta == 0.0) return {};
  return changeOf(motion, odometryChange, kCopies, seed, stream);
}

PoseEstimate moved(PoseEstimate e, const Pose2& change) {
  // With the displacement in the field frame, (dx, dy), a heading error h shifts the new position
  // by h (-dy, dx): the covariance is F P F^T with F = [1 0 -dy; 0 1 dx; 0 0 1].
  const Pose2 old = e.pose;
  e.pose = old * change;
  const double dx = e.pose.x - old.x;
  const double dy = e.pose.y - old.y;
  PoseCovariance& p = e.covariance;
  for (std::size_t column = 0; column < 3; ++column) {
    p[column] -= dy * p[6 + column];
    p[3 + column] += dx * p[6 + column];
  }
  for (std::size_t row = 0; row < 9; row += 3) {
    p[row] -= dy * p[row + 2];
    p[row + 1] += dx * p[row + 2];
  }
  return e;
}

PoseEstimate carriedOn(const PoseEstimate& estimate, const MotionModel& motion,
                       const Pose2& odometryChange, std::uint64_t seed, std::uint64_t stream) {
  return carriedOn(estimate, changeOf(motion, odometryChange, seed, stream));
}

PoseEstimate carriedOn(const PoseEstimate& estimate, const MotionChange& change, double noise) {
  PoseEstimate then = moved(estimate, change.mean);
  PoseCovariance its = change.covariance;
  for (double& c : its) c *= noise;
  add(its, estimate.pose.theta, then.covariance);
  return then;
}

}  // namespace ortung
