#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ortung/mcl/PoseEstimate.hpp"

namespace ortung::app {

/// The output of `ortung localize`: this line, then one an update.
inline constexpr std::string_view kEstimatesHeader =
    "# stamp_us x_m y_m theta_rad cov_xx_m2 cov_xy_m2 cov_xtheta_m_rad cov_yy_m2 cov_ytheta_m_rad "
    "cov_thetatheta_rad2 share samples\n";

void appendEstimate(const PoseEstimate& estimate, std::string& text);

/// At even times there are two columns more, the last ones.
inline constexpr std::string_view kAgeColumns = "age_s quality";

/// @param age of the newest weighing [s]; nothing before there was one: nan
void appendEstimate(const PoseEstimate& estimate, std::optional<double> age, std::string& text);

/// The same as a JSON object and a line feed; the covariance row by row; no age is null.
void appendEstimateJson(const PoseEstimate& estimate, std::optional<double> age, std::string& text);

/// The first line of such a file, a comment.
inline constexpr std::string_view kTumHeader = "# timestamp tx ty tz qx qy qz qw\n";

/// A pose as the RGB-D benchmark of TUM and `evo` have it, with a line feed: seconds, x y z [m],
/// and the quaternion x y z w of the heading.
void appendTum(Timestamp stamp, const Pose2& pose, std::string& text);

}  // namespace ortung::app
