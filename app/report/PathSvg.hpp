#pragma once

#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

/// Paths of the report's map, as SVG in field coordinates [m]; y points up.
namespace ortung::app {

/// Returns poses as the commands of an SVG path, which is broken at jumps and at gaps of more than
/// @p longestStep [s].
std::string pathCommands(const std::vector<std::pair<Timestamp, Pose2>>& poses, double longestStep);

/// Draws the estimate's path, coloured by quality in ten steps, above an outline that makes it
/// visible on any floor. Where the status is not "tracking", there is a band below it, of another
/// form for each status.
/// @param longestStep longest time over which a line is drawn [s]
std::string estimateSvg(const std::vector<PoseEstimate>& path, double longestStep);

/// Draws the ten colours of quality, from 0 to 1, as a bar for the legend.
std::string qualityBar();

}  // namespace ortung::app
