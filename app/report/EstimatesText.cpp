#include "EstimatesText.hpp"

#include <fmt/format.h>

#include <iterator>

namespace ortung::app {

void appendEstimate(const PoseEstimate& estimate, std::string& text) {
  const auto& c = estimate.covariance;
  fmt::format_to(std::back_inserter(text),
                 "{} {:.4f} {:.4f} {:.5f} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.3f} {}\n",
                 estimate.stamp, estimate.pose.x, estimate.pose.y, estimate.pose.theta, c[0], c[1],
                 c[2], c[4], c[5], c[8], estimate.share, estimate.samples);
}

}  // namespace ortung::app
