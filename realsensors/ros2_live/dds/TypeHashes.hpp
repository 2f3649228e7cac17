#pragma once

#include <string_view>

namespace ortung::ros2 {

/// The hash of a type's description (RIHS01, REP 2011 and 2016), 64 hexadecimal digits, by which
/// Iron and later check that both sides mean the same message; "" for types that no node here has.
/// @param type "sensor_msgs/msg/LaserScan"
std::string_view typeHashOf(std::string_view type);

}  // namespace ortung::ros2
