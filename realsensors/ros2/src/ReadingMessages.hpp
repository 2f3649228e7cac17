#pragma once

#include <optional>

#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/ScanData.hpp"
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
Range rangeMessage(const Message& reading, const ConeData::Config& config, Header header);
Image imageMessage(const Message& reading, Header header);
/// Converts the first fix; nothing if there is none.
std::optional<PoseWithCovarianceStamped> poseMessage(const Message& reading, Header header);
PoseArray samplesMessage(const Message& reading, Header header);

}  // namespace ortung::ros2
