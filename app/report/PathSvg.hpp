#pragma once

#include <string>
#include <vector>

#include "ortung/base/Pose2.hpp"
#include "ortung/mcl/PoseEstimate.hpp"

/// Paths of the report's map, as SVG in the field's metres; y runs upwards.
namespace ortung::app {

/// Poses as commands of an SVG path, which breaks at jumps and at gaps of more than @p longestStep
/// [s].
std::string pathCommands(const std::vector<std::pair<Timestamp, Pose2>>& poses, double longestStep);

/// The estimate's path, coloured by quality in tenths, above an outline that shows it on any floor.
/// Beneath it lies a band wherever the status is not tracking, of another form for each status.
/// @param longestStep of time over which a line is drawn [s]
std::string estimateSvg(const std::vector<PoseEstimate>& path, double longestStep);

/// The colours of the tenths of quality, from 0 to 1, as a bar for the legend.
std::string qualityBar();

}  // namespace ortung::app
