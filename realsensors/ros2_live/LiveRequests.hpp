#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "Participant.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/PoseCovariance.hpp"

namespace ortung::ros2 {

/// What others ask of a localization, by topics and services, until its own thread does it; also
/// while there is no map yet. Thread-safe.
class LiveRequests {
 public:
  struct InitialPose {
    Pose2 pose;
    PoseCovariance covariance{};
  };
  /// What was asked since the last time.
  struct Asked {
    std::optional<InitialPose> pose;
    std::optional<std::string> floor;  ///< the robot's floor; a pose is one on it
    bool relocalizes = false;          ///< whether the robot is searched for anew
    bool tellsNow = false;             ///< whether pose and particles are told at once
    bool isConfigured = false;         ///< whether a manager has configured the node
  };

  explicit LiveRequests(std::string mapFrame) : mapFrame_(std::move(mapFrame)) {}

  /// Reads /initialpose, and offers the services of amcl.
  void serve(Participant& node);
  /// A geometry_msgs/msg/PoseWithCovarianceStamped in CDR, which request of set_initial_pose is,
  /// too. @throws std::invalid_argument if it is none, or not in the map's frame
  void takePose(std::string_view cdr);
  /// Says that the robot is on a floor of its building.
  void goTo(const std::string& floor);
  void relocalize();
  void tellNow();
  void configure();

  Asked take();

 private:
  const std::string mapFrame_;
  std::mutex mutex_;
  Asked asked_;
};

}  // namespace ortung::ros2
