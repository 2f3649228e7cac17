#include "Centre.hpp"

#include <cmath>
#include <vector>

#include "Resampling.hpp"
#include "RivalsTuning.hpp"

namespace ortung {

using namespace tuning;

Centre centreOf(const SampleSet& set) {
  const std::vector<double> weights = normalized(set.logWeight);
  double x = 0.0;
  double y = 0.0;
  double c = 0.0;
  double s = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    x += weights[i] * static_cast<double>(set.x[i]);
    y += weights[i] * static_cast<double>(set.y[i]);
    c += weights[i] * std::cos(static_cast<double>(set.theta[i]));
    s += weights[i] * std::sin(static_cast<double>(set.theta[i]));
  }
  Centre centre{{x, y, std::atan2(s, c)}, 0.0};
  double squares = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double dx = static_cast<double>(set.x[i]) - x;
    const double dy = static_cast<double>(set.y[i]) - y;
    const double turn = wrapAngle(static_cast<double>(set.theta[i]) - centre.pose.theta);
    squares += weights[i] * (dx * dx + dy * dy + turn * turn);
  }
  centre.open = std::sqrt(squares);
  return centre;
}

double apart(const Pose2& a, const Pose2& b) {
  return distance(a, b) + std::abs(wrapAngle(a.theta - b.theta));
}

bool isSame(const Pose2& rival, const Pose2& belief) {
  return distance(rival, belief) < hypothesis::kSamePlace &&
         std::abs(wrapAngle(rival.theta - belief.theta)) < hypothesis::kSameTurn;
}

}  // namespace ortung
