#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "CloudShape.hpp"
#include "FrameTree.hpp"
#include "LiveFeatures.hpp"
#include "ReadingStreams.hpp"
#include "ScanShape.hpp"
#include "TiltHistory.hpp"
#include "VelocityHistory.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung::ros2 {

/// Messages of ROS 2 as readings of a robot, in the order of their time, whatever the order in
/// which they arrive. A scan waits for odometry of its own time and for other scanners' scans that
/// are due by then, as odometry does for the scan, so a bag that is played becomes the same moments
/// as if it was read. What comes is not trusted:
/// anything that is no such message, does not fit, or is late, is counted and left out.
/// Thread-safe.
class LiveReadings {
 public:
  /// A scanner of the robot, and the topic at which its scans are.
  struct Scanner {
    std::string topic;
    SensorId feature;
    std::size_t beams = 0;
    double maxRange = 0.0;  ///< [m]
  };
  /// A lidar whose clouds become scans, which see all around.
  struct Lidar {
    std::string topic;
    SensorId feature;
    CloudBand band;
  };
  struct Options {
    std::vector<Scanner> scanners;
    std::vector<Lidar> lidars;
    std::vector<LiveFeature> features;  ///< that messages fill as they are
    /// What tells roll and pitch, by which clouds are levelled: a topic of sensor_msgs/Imu,
    /// "odometry" or "none".
    std::string level = "odometry";
    SensorId odometry;
    bool followsFrames = false;  ///< whether odometry is the transform odom -> base, not a message
    std::string base = "base_footprint", odom = "odom";  ///< frames
    std::chrono::milliseconds patience{250};  ///< the longest that a reading waits for others
  };
  /// A moment, and the robot's pose in the frame of odometry then, if it is known: between two
  /// odometries it is interpolated.
  struct Moment {
    std::vector<Message> readings;  ///< of one stamp; none: time has passed without any
    std::optional<Pose2> inOdometry;
  };

  explicit LiveReadings(Options options);

  // What arrives, as bytes (CDR).
  void takeScan(std::size_t scanner, std::string_view cdr);
  void takeCloud(std::size_t lidar, std::string_view cdr);
  void takeFeature(std::size_t feature, std::string_view cdr);
  void takeImu(std::string_view cdr);
  void takeOdometry(std::string_view cdr);
  void takeTransforms(std::string_view cdr, bool isStatic);

  const std::vector<LiveFeature>& features() const { return options_.features; }

  /// Waits for the next moment. @param longest then an empty one is returned
  /// @return nothing after stop()
  std::optional<Moment> next(std::chrono::milliseconds longest);
  /// Ends waiting, now and for ever.
  void stop();

  /// The newest odometry that has arrived, which may be ahead of the moments.
  std::optional<Timestamp> newestOdometry() const;
  /// How many readings were taken of each topic; of odometry under "odometry".
  std::map<std::string, std::uint64_t> taken() const;
  /// The frame of the robot that odometry tells, if it is another one than the robot's.
  std::string otherBase() const;
  /// What was left out, in words and how often.
  std::map<std::string, std::uint64_t> leftOut() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Waiting {
    std::vector<Message> readings;
    std::optional<Pose2> inOdometry;
    Clock::time_point since;
  };
  /// What is used again for each cloud of a lidar.
  struct Cloud {
    std::mutex mutex;
    PointCloud message;
    std::optional<CloudShape> shape;
  };
  void put(Message message, std::optional<Pose2> inOdometry);
  void putScan(Message reading, const std::string& topic);
  void leaveOut(const std::string& what);
  void addOdometry(Timestamp stamp, const Pose2& pose, std::vector<std::uint32_t> words);
  Eigen::Matrix3d tiltAt(Timestamp stamp);
  bool isReady(Clock::time_point now) const;
  std::optional<Pose2> interpolated(Timestamp stamp) const;

  const Options options_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  bool isStopped_ = false;
  std::map<Timestamp, Waiting> waiting_;
  std::optional<Timestamp> delivered_;  ///< stamp of the moment that was given last
  std::optional<std::pair<Timestamp, Pose2>>
      lastPose_;  ///< in odometry, of a moment that was given
  std::optional<Timestamp> newestScan_, newestOdometry_;
  ReadingStreams streams_;  ///< of all but odometry
  std::size_t late_ = 0;    ///< messages in a row
  std::vector<std::optional<ScanShape>> shapes_;
  std::vector<bool> areUpsideDown_;
  std::vector<std::unique_ptr<Cloud>> clouds_;  ///< by lidar; each with a lock of its own
  TiltHistory tilts_;
  VelocityHistory velocities_;
  std::string imuFrame_;
  FrameTree frames_;
  PoseOdometry followed_;
  std::map<std::string, std::uint64_t> leftOut_, taken_;
  std::string otherBase_;
};

}  // namespace ortung::ros2
