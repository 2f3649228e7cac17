#pragma once

#include <optional>

#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/ros2/Messages.hpp"

// Readings as messages of ROS 2. The words are those that the feature takes, but for the estimate
// and samples of MCL, which are checked here: all throw std::invalid_argument.
namespace ortung::ros2 {

/// [ns] @throws std::invalid_argument for a time before 1970, or beyond 2^31 s
std::int64_t rosTime(Timestamp stamp);

/// Whether the reading tells more than odometryMessage().
bool hasMotionData(const Message& reading);
Odometry odometryMessage(const Message& reading, Header header, std::string child);
LaserScan scanMessage(const Message& reading, const ScanData::Config& config, Header header);
Range rangeMessage(const Message& reading, const ConeData::Config& config, Header header);
Image imageMessage(const Message& reading, Header header);
/// The first fix; nothing if there is none.
std::optional<PoseWithCovarianceStamped> poseMessage(const Message& reading, Header header);
PoseArray samplesMessage(const Message& reading, Header header);

}  // namespace ortung::ros2
