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
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// Where messages of one type come.
struct Topic {
  std::string name;          ///< "/scan"
  std::string_view type;     ///< "sensor_msgs/msg/LaserScan"
  bool isLatched = false;    ///< the last message is also for those who come later
  std::string feature = {};  ///< "LMS200/LRF/180DegreeScan"; "" if it is not that of one feature
  std::string format = {};   ///< of that feature, Format::toText(); "" if it is not known
};

/// The pose in the plane that a pose in space is seen from above, and the other way round.
ORTUNG_API Pose fromPose2(const Pose2& pose);
/// @returns a pose that is not finite for one that is not, or whose quaternion is 0
ORTUNG_API Pose2 toPose2(const Pose& pose);

/// A robot's readings as messages of ROS 2: /odom, /scan, /range/..., /image/..., /ground_truth,
/// the estimate of MCL at /pose and its samples at /particle_cloud, and the tree of frames
/// map -> odom -> base_link -> sensors at /tf and /tf_static. All have the stamps of their
/// readings. What ROS has no message for keeps its words, at /ortung/MODEL/TYPE/FEATURE, and so
/// does odometry that has motion data, beside /odom. Not thread-safe.
class ORTUNG_API RobotTopics {
 public:
  /// What says where the frame of odometry lies in the map.
  enum class MapFrame : std::uint8_t {
    kBest,   ///< the estimate of MCL, from the first on; before it, the ground truth
    kTruth,  ///< the ground truth
    kNone,   ///< nothing: whoever plays the messages to a localization of his own wants that
  };
  struct Options {
    MapFrame mapFrame = MapFrame::kBest;
    /// Before the names of its topics and frames, for several robots at a time; "": none.
    std::string robot = {};
  };
  /// Gets a message. @param topic its number in topics()
  using Sink = std::function<void(std::size_t topic, Timestamp stamp, std::string_view cdr)>;

  /// @param container must outlive this; its readings are not looked at
  RobotTopics(const SensorContainer& container, const Options& options);
  ~RobotTopics();

  /// Grows as features appear that the container does not have; what is there stays.
  const std::vector<Topic>& topics() const;
  /// A feature that the container does not have, whose words are told as they are. Once each.
  void addWords(const SensorId& feature);
  /// Whose readings a topic's messages are made of, "MODEL/TYPE/FEATURE" or with "*".
  std::vector<std::string> featuresOf(std::size_t topic) const;
  /// What does not change: where the sensors sit.
  void start(Timestamp stamp, const Sink& sink) const;
  /// The map. Its stamp and frame are set here.
  void show(OccupancyGrid map, Timestamp stamp, const Sink& sink) const;
  /// The readings of one moment.
  /// @throws std::invalid_argument for words that a feature refuses, and for a stamp that ROS does
  ///   not have
  void take(std::span<const Message> frame, const Sink& sink);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ortung::ros2
