#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "FrameTree.hpp"
#include "ScanShape.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung::ros2 {

/// Messages of ROS 2 as readings of a robot, in the order of their time, whatever the order in
/// which they arrive. A scan waits for odometry of its own time, as odometry does for the scan, so
/// a bag that is played becomes the same moments as if it was read. What comes is not trusted:
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
  struct Options {
    std::vector<Scanner> scanners;
    SensorId odometry;
    bool followsFrames = false;  ///< whether odometry is the transform odom -> base, not a message
    std::string base = "base_footprint", odom = "odom";  ///< frames
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
  void takeOdometry(std::string_view cdr);
  void takeTransforms(std::string_view cdr, bool isStatic);

  /// Waits for the next moment. @param longest then an empty one is returned
  /// @return nothing after stop()
  std::optional<Moment> next(std::chrono::milliseconds longest);
  /// Ends waiting, now and for ever.
  void stop();

  /// The newest odometry that has arrived, which may be ahead of the moments.
  std::optional<Timestamp> newestOdometry() const;
  /// What was left out, in words and how often.
  std::map<std::string, std::uint64_t> leftOut() const;

  /// The longest that a scan waits for odometry, and odometry for a scan.
  static constexpr std::chrono::milliseconds kPatience{250};

 private:
  using Clock = std::chrono::steady_clock;
  struct Waiting {
    std::vector<Message> readings;
    std::optional<Pose2> inOdometry;
    Clock::time_point since;
  };
  void put(Message message, std::optional<Pose2> inOdometry);
  void leaveOut(const std::string& what);
  void addOdometry(Timestamp stamp, const Pose2& pose, std::vector<std::uint32_t> words);
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
  std::size_t late_ = 0;  ///< messages in a row
  std::vector<std::optional<ScanShape>> shapes_;
  std::vector<bool> areUpsideDown_;
  FrameTree frames_;
  PoseOdometry followed_;
  std::map<std::string, std::uint64_t> leftOut_;
};

}  // namespace ortung::ros2
