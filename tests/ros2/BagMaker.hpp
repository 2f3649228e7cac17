#pragma once

/// Bags of a few messages for the tests of the source `mcap`.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ortung/ros2/McapWriter.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::testing {

inline constexpr std::int64_t kSecond = 1'000'000'000;  ///< [ns]

/// Writes a bag topic by topic.
class BagMaker {
 public:
  template <class M>
  BagMaker& add(const std::string& topic, const M& message, const std::string& encoding = "cdr",
                const std::map<std::string, std::string>& metadata = {}) {
    auto channel = channels_.find(topic);
    if (channel == channels_.end()) {
      const auto schema = writer_.addSchema(M::kType, "ros2msg", ros2::schemaText(M::kType));
      channel =
          channels_.emplace(topic, writer_.addChannel(schema, topic, encoding, metadata)).first;
    }
    writer_.write(channel->second, ++time_, ros2::toCdr(message));
    return *this;
  }
  std::string bytes() {
    writer_.finish();
    return bytes_;
  }

 private:
  std::string bytes_;
  // Without chunks there are no checksums before the messages themselves.
  ros2::McapWriter writer_{[this](std::string_view piece) { bytes_ += piece; },
                           {.isChunked = false}};
  std::map<std::string, std::uint16_t> channels_;
  std::uint64_t time_ = 0;
};

inline ros2::LaserScan scanOf(std::int64_t stamp, const std::string& frame,
                              std::vector<float> ranges) {
  ros2::LaserScan scan;
  scan.header = {stamp, frame};
  scan.angleMin = -0.5F;
  scan.angleIncrement = 0.5F;
  scan.angleMax = 0.5F;
  scan.rangeMin = 0.1F;
  scan.rangeMax = 8.1F;
  scan.ranges = std::move(ranges);
  return scan;
}

inline ros2::TfMessage frameAt(const std::string& parent, const std::string& child, ros2::Pose pose,
                               std::int64_t stamp = 0) {
  return {{{{stamp, parent}, child, pose}}};
}

inline ros2::Odometry odometryAt(std::int64_t stamp, double x, double speed) {
  ros2::Odometry odometry;
  odometry.header = {stamp, "odom"};
  odometry.childFrame = "base_footprint";
  odometry.pose.position.x = x;
  odometry.linear.x = speed;
  return odometry;
}

}  // namespace ortung::testing
