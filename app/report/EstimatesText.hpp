#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/tables/Building.hpp"

namespace ortung::app {

/// First line of the output of `ortung localize`; a line for each update follows.
inline constexpr std::string_view kEstimatesHeader =
    "# stamp_us x_m y_m theta_rad cov_xx_m2 cov_xy_m2 cov_xtheta_m_rad cov_yy_m2 cov_ytheta_m_rad "
    "cov_thetatheta_rad2 share samples\n";

/// Appends an estimate's line.
void appendEstimate(const PoseEstimate& estimate, std::string& text);

/// Two further columns at the end, for poses at even times.
inline constexpr std::string_view kAgeColumns = "age_s quality";

/// Appends an estimate's line with these columns.
/// @param age time since samples were last weighed [s]; nothing: not yet, written as nan
void appendEstimate(const PoseEstimate& estimate, std::optional<double> age, std::string& text);

/// Appends the same as a JSON object and a line feed; the covariance row by row; no age is null. In
/// a building it has the floor's name, and the pose in the floor's own frame.
void appendEstimateJson(const PoseEstimate& estimate, std::optional<double> age,
                        const Building& building, std::string& text);

/// The first line of such a file, a comment.
inline constexpr std::string_view kTumHeader = "# timestamp tx ty tz qx qy qz qw\n";

/// Appends a pose in the format of the RGB-D benchmark of TUM and of `evo`, with a line feed:
/// seconds, x y z [m], and the quaternion x y z w of the heading.
void appendTum(Timestamp stamp, const Pose2& pose, std::string& text);

}  // namespace ortung::app
