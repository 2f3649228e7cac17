#pragma once

#include <optional>
#include <string>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/formats/ProtectionData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/formats/TrackData.hpp"
#include "ortung/ros2/Messages.hpp"

// Converts readings to messages of ROS 2. The feature has checked the words, except for the
// estimate and the samples of MCL, which are checked here. All throw std::invalid_argument.
namespace ortung::ros2 {

/// Converts a stamp to [ns]. @throws std::invalid_argument for a time before 1970, or beyond 2^31 s
std::int64_t rosTime(Timestamp stamp);

/// Whether the reading has motion data, which odometryMessage() leaves out.
bool hasMotionData(const Message& reading);
Odometry odometryMessage(const Message& reading, Header header, std::string child);
LaserScan scanMessage(const Message& reading, const ScanData::Config& config, Header header);
/// @param cone its format: the opening angle and the greatest range
Range rangeMessage(const Message& reading, const Format& cone, Header header);
/// The range of the first row; nothing without one. @param row a format of rows with ranges
std::optional<Range> rowRangeMessage(const Message& reading, const Format& row, Header header);
/// What the rows of a format are: places (x, y, or ranges with bearings), ranges alone, or neither.
enum class RowKind : std::uint8_t { kOther, kPlaces, kRanges };
RowKind rowKindOf(const Format& format);
/// Whether places are in the robot's frame, not the sensor's.
bool areInRobot(const Format& format);
/// Places of rows with x, y, z and all that the rows tell, by the names in `row`.
PointCloud cloudMessage(const Message& reading, const Format& row, Header header);
Image imageMessage(const Message& reading, Header header);
/// What a Range says, by REP 117 [m]: infinity beyond its greatest range, where nothing was seen;
/// NaN below its least one, where something is too near to tell its distance.
ORTUNG_API double metresOf(const Range& told);
/// Converts the first fix; nothing if there is none.
std::optional<PoseWithCovarianceStamped> poseMessage(const Message& reading, Header header);
PoseArray samplesMessage(const Message& reading, Header header);
/// Cells where the map no longer fits for sure: 0 where a wall is gone, 100 where something is new,
/// -1 elsewhere; nothing if they lie so far apart that the grid would have more than 2^22 cells.
std::optional<OccupancyGrid> changesMessage(const Message& reading, Header header);
/// How far a localization can be relied on: OK while tracking, WARN while uncertain, else ERROR.
/// @param name of the localization among all parts of the robot
ORTUNG_API DiagnosticArray diagnosticsMessage(const TrackData::Reading& track,
                                              const ProtectionData::Reading& bound,
                                              const std::string& name, Header header);

}  // namespace ortung::ros2
