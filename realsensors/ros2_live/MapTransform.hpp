#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"

namespace ortung::ros2 {

/// The transform map -> odom. It is published with each odometry message, without waiting for the
/// filter, with a stamp a while ahead, so that no lookup extrapolates; and again when the filter
/// has corrected it, a microsecond later, since each stamp is published once. Thread-safe.
class MapTransform {
 public:
  struct Options {
    std::string map = "map", odom = "odom";  ///< frames
    double ahead = 1.0;                      ///< how far [s]
  };
  explicit MapTransform(Options options) : options_(std::move(options)), ahead_(options_.ahead) {}

  /// Sets what sends the messages (tf2_msgs/TFMessage in CDR).
  void sendBy(std::function<void(std::string_view)> send);
  /// Whether it is told, which it is at first, and how far ahead it is valid from now on [s].
  void setTold(bool isTold);
  void setAhead(double ahead);
  /// Tells the transform for odometry that has arrived; nothing before the first correction.
  void follow(Timestamp odometry);
  /// Takes the odometry's pose in the map, and tells it if it has changed.
  void correct(const Pose2& odomInMap);

  bool isKnown() const;  ///< whether it was ever corrected

 private:
  void tell(Timestamp stamp);

  const Options options_;
  double ahead_;  ///< [s]
  bool isTold_ = true;
  mutable std::mutex mutex_;
  std::function<void(std::string_view)> send_;
  std::optional<Pose2> odomInMap_;
  std::optional<Timestamp> followed_;  ///< stamp of the newest odometry
  std::optional<Timestamp> told_;      ///< stamp of the newest transform
};

}  // namespace ortung::ros2
