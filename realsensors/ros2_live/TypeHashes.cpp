#include "TypeHashes.hpp"

#include <array>
#include <utility>

namespace ortung::ros2 {
namespace {

/// Of the messages that the node reads and tells; tests/ros2_live/type_hash_test.py computes them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kHashes = {{
    {"diagnostic_msgs/msg/DiagnosticArray",
     "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"},
    {"geometry_msgs/msg/PoseWithCovarianceStamped",
     "26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e"},
    {"nav2_msgs/msg/ParticleCloud",
     "193d8cb88ca2b98cd81ece15342744f054bb398ebfa8f6369914432303f42b11"},
    {"nav_msgs/msg/OccupancyGrid",
     "8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7"},
    {"nav_msgs/msg/Odometry", "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0"},
    {"rmw_dds_common/msg/ParticipantEntitiesInfo",
     "ceeef91b55abeb561ed93174430982c9df07b7e93e81a22ceebf7d95651d00a6"},
    {"sensor_msgs/msg/Imu", "7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b"},
    {"sensor_msgs/msg/LaserScan",
     "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"},
    {"sensor_msgs/msg/PointCloud2",
     "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5"},
    {"tf2_msgs/msg/TFMessage", "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"},
}};

}  // namespace

std::string_view typeHashOf(std::string_view type) {
  for (const auto& [name, hash] : kHashes)
    if (name == type) return hash;
  return "";
}

}  // namespace ortung::ros2
