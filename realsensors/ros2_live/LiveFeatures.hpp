#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// The time of a message [us], rounded down.
Timestamp stampOf(const Header& header);

/// The topic of TOPIC=MODEL/TYPE/FEATURE, or of TOPIC alone.
std::string topicOf(const std::string& text);

/// A feature of a robot file that the messages of one topic fill, as they are.
struct LiveFeature {
  std::string topic;
  std::string_view type;  ///< of its messages
  SensorId feature;
  /// Makes a reading of a message (CDR), which is not trusted.
  /// @throws std::invalid_argument telling why it is none
  std::function<Message(std::string_view cdr)> read;
};

/// Finds the feature of TOPIC=MODEL/TYPE/FEATURE, whose format says which messages there are: a
/// cone has sensor_msgs/Range, a fix geometry_msgs/PoseWithCovarianceStamped of the robot's base, a
/// picture sensor_msgs/Image.
/// @param map frame in which fixes are @param toField converts poses in that frame to the field's
/// @throws std::invalid_argument if the container has no such feature, or if no message fills it
LiveFeature liveFeatureOf(const SensorContainer& container, const std::string& text,
                          const std::string& map,
                          const std::function<Pose2(const Pose2&)>& toField = {});

}  // namespace ortung::ros2
