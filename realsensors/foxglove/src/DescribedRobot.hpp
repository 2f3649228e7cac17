#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ortung/core/SensorContainer.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::foxglove {

/// A robot as the board describes it: its features as far as messages of ROS 2 need them.
struct DescribedRobot {
  SensorContainer container;
  std::unique_ptr<ros2::RobotTopics> topics;
  bool hasTruth = false;
};

/// @param lines of `DESCRIBE robot` @param options of its topics and frames
std::unique_ptr<DescribedRobot> describedRobot(const std::vector<std::string>& lines,
                                               const ros2::RobotTopics::Options& options);

}  // namespace ortung::foxglove
