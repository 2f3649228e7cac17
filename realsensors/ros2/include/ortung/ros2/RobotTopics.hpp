#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/PoseCovariance.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// A topic: a named stream of messages of one type.
struct Topic {
  std::string name;          ///< "/scan"
  std::string_view type;     ///< "sensor_msgs/msg/LaserScan"
  bool isLatched = false;    ///< the last message is also for those who come later
  std::string feature = {};  ///< "LMS200/LRF/180DegreeScan"; "" if it is not that of one feature
  std::string format = {};   ///< of that feature, Format::toText(); "" if it is not known
};

/// Converts a pose in the plane to one in space.
ORTUNG_API Pose fromPose2(const Pose2& pose);
/// Projects a pose in space onto the plane.
/// @returns a pose that is not finite if @p pose is not finite, or its quaternion is 0
ORTUNG_API Pose2 toPose2(const Pose& pose);
/// Converts a covariance of (x, y, heading) to one of a pose in space; all else is zero.
ORTUNG_API Covariance fromPlane(const PoseCovariance& plane);
/// Takes that of (x, y, heading) from the covariance of a pose in space. Its numbers may be any.
ORTUNG_API PoseCovariance toPlane(const Covariance& space);

/// A robot's readings as messages of ROS 2: /odom, /scan, /range/..., /image/..., /ground_truth,
/// the estimate of MCL at /pose and its samples at /particle_cloud, and the tree of frames
/// map -> odom -> base_link -> sensors at /tf and /tf_static. All have the stamps of their
/// readings. Readings for which ROS has no message keep their words, at /ortung/MODEL/TYPE/FEATURE,
/// as does odometry with motion data, beside /odom. Not thread-safe.
class ORTUNG_API RobotTopics {
 public:
  /// What gives the pose of the odometry frame in the map.
  enum class MapFrame : std::uint8_t {
    kBest,   ///< the estimate of MCL; before the first one, the ground truth
    kTruth,  ///< the ground truth
    kNone,   ///< nothing, e.g. because another localization reads the messages
  };
  struct Options {
    MapFrame mapFrame = MapFrame::kBest;  ///< what gives the pose of the odometry frame
    /// Prefix of the names of topics and frames, for several robots at a time; "": none.
    std::string robot = {};
    std::string base = "base_link", odom = "odom";  ///< frames of the robot and of its odometry
    /// What the names of the robot's frames begin with, if there is no `robot`.
    std::string framePrefix = {};
  };
  /// Gets a message. @param topic index into topics()
  using Sink = std::function<void(std::size_t topic, Timestamp stamp, std::string_view cdr)>;

  /// @param container features of the robot; must outlive this; its readings are not used
  RobotTopics(const SensorContainer& container, const Options& options);
  ~RobotTopics();

  /// All topics. Features that the container does not have append further ones.
  const std::vector<Topic>& topics() const;
  /// Adds a feature that the container does not have; its messages are its words. Once for each.
  void addWords(const SensorId& feature);
  /// The features of whose readings a topic's messages are made: "MODEL/TYPE/FEATURE" or with "*".
  std::vector<std::string> featuresOf(std::size_t topic) const;
  /// Sends what does not change: the mounts of the sensors.
  void start(Timestamp stamp, const Sink& sink) const;
  /// Sends the map, whose stamp and frame are set here.
  void show(OccupancyGrid map, Timestamp stamp, const Sink& sink) const;
  /// Sends the readings of one time.
  /// @throws std::invalid_argument for words that a feature refuses, and for a stamp that ROS does
  ///   not have
  void take(std::span<const Message> frame, const Sink& sink);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung::ros2
