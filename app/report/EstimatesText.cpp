#include "EstimatesText.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "SecondsText.hpp"

namespace ortung::app {

void appendEstimate(const PoseEstimate& estimate, std::string& text) {
  const auto& c = estimate.covariance;
  fmt::format_to(std::back_inserter(text),
                 "{} {:.4f} {:.4f} {:.5f} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.3f} {}\n",
                 estimate.stamp, estimate.pose.x, estimate.pose.y, estimate.pose.theta, c[0], c[1],
                 c[2], c[4], c[5], c[8], estimate.share, estimate.samples);
}

void appendEstimate(const PoseEstimate& estimate, std::optional<double> age, std::string& text) {
  appendEstimate(estimate, text);
  text.pop_back();
  fmt::format_to(std::back_inserter(text), " {:.3f} {:.3f}\n",
                 age.value_or(std::numeric_limits<double>::quiet_NaN()), estimate.quality);
}

void appendEstimateJson(const PoseEstimate& estimate, std::optional<double> age,
                        const Building& building, std::string& text) {
  const auto& c = estimate.covariance;
  nlohmann::ordered_json line;
  line["stamp_us"] = estimate.stamp;
  line["x_m"] = estimate.pose.x;
  line["y_m"] = estimate.pose.y;
  line["theta_rad"] = estimate.pose.theta;
  line["covariance"] = {
      {c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}};  // rows of x, y and theta
  line["share"] = estimate.share;
  line["samples"] = estimate.samples;
  line["quality"] = estimate.quality;
  line["status"] = nameOf(estimate.status);
  line["reason"] = nameOf(estimate.reason);
  line["protection_m"] = estimate.protection.metres;
  line["protection_rad"] = estimate.protection.radians;  // what is infinite is written as null
  line["smooth"] = {estimate.smooth.x, estimate.smooth.y, estimate.smooth.theta};
  line["relocalizations"] = estimate.relocalizations;
  line["relocalization"] = nameOf(estimate.relocalization);
  line["age_s"] = age ? nlohmann::ordered_json(*age) : nlohmann::ordered_json();
  if (!building.isEmpty()) {
    const Floor& floor = building.floorOf(estimate.pose.x);
    const Pose2 there = floor.fromField(estimate.pose);
    line["floor"] = floor.name;
    line["floor_pose"] = {there.x, there.y, there.theta};
  }
  text += line.dump() + "\n";
}

void appendTum(Timestamp stamp, const Pose2& pose, std::string& text) {
  fmt::format_to(std::back_inserter(text), "{} {:.6f} {:.6f} 0 0 0 {:.9f} {:.9f}\n",
                 secondsText(stamp), pose.x, pose.y, std::sin(pose.theta / 2),
                 std::cos(pose.theta / 2));
}

}  // namespace ortung::app
