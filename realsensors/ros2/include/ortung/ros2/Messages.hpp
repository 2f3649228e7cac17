#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"

/// Files and messages of ROS 2 by their public specifications; no part of ROS is needed.
namespace ortung::ros2 {

// The messages of ROS 2 that have to do with a robot in the plane, field by field as their
// packages define them (names here are ours). Lengths [m], angles [rad], times [ns since 1970].
// What is left out of them, such as covariances of velocities, is written as zeros.

struct Header {
  std::int64_t stamp = 0;  ///< [ns]; within 2^31 s of 1970
  std::string frame;
};
struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;
};
struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};
struct Pose {
  Vector3 position;
  Quaternion orientation;
};
using Covariance = std::array<double, 36>;  ///< of x, y, z and turns about them, row-major

struct LaserScan {
  static constexpr std::string_view kType = "sensor_msgs/msg/LaserScan";
  Header header;
  float angleMin = 0.0F, angleMax = 0.0F, angleIncrement = 0.0F;
  float timeIncrement = 0.0F, scanTime = 0.0F;  ///< [s]
  float rangeMin = 0.0F, rangeMax = 0.0F;
  std::vector<float> ranges;  ///< NaN: not valid; +infinity: nothing within range (REP 117)
  std::vector<float> intensities;
};

struct Odometry {
  static constexpr std::string_view kType = "nav_msgs/msg/Odometry";
  Header header;
  std::string childFrame;
  Pose pose;
  Covariance poseCovariance{};
  Vector3 linear;   ///< in the child frame [m/s]
  Vector3 angular;  ///< in the child frame [rad/s]
  Covariance twistCovariance{};
};

struct TransformStamped {
  Header header;
  std::string childFrame;
  Pose transform;
};
struct TfMessage {
  static constexpr std::string_view kType = "tf2_msgs/msg/TFMessage";
  std::vector<TransformStamped> transforms;
};

struct PoseStamped {
  static constexpr std::string_view kType = "geometry_msgs/msg/PoseStamped";
  Header header;
  Pose pose;
};
struct PoseWithCovarianceStamped {
  static constexpr std::string_view kType = "geometry_msgs/msg/PoseWithCovarianceStamped";
  Header header;
  Pose pose;
  Covariance covariance{};
};
struct PoseArray {
  static constexpr std::string_view kType = "geometry_msgs/msg/PoseArray";
  Header header;
  std::vector<Pose> poses;
};

struct OccupancyGrid {
  static constexpr std::string_view kType = "nav_msgs/msg/OccupancyGrid";
  Header header;
  std::int64_t mapLoadTime = 0;  ///< [ns]
  float resolution = 0.0F;       ///< edge of a cell
  std::uint32_t width = 0, height = 0;
  Pose origin;                    ///< of the lower left corner of cell (0, 0)
  std::vector<std::int8_t> data;  ///< rows from below: 0 free to 100 occupied, -1 unknown
};

struct Range {
  static constexpr std::string_view kType = "sensor_msgs/msg/Range";
  Header header;
  std::uint8_t radiationType = 0;  ///< 0 sound, 1 infrared
  float fieldOfView = 0.0F, minRange = 0.0F, maxRange = 0.0F;
  float range = 0.0F;  ///< NaN: not valid; +infinity: nothing within range
};

struct Image {
  static constexpr std::string_view kType = "sensor_msgs/msg/Image";
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string encoding;  ///< "rgb8", "mono8", ...
  std::uint8_t isBigEndian = 0;
  std::uint32_t step = 0;  ///< bytes of a row
  std::vector<std::uint8_t> data;
};

/// Points, each of the same fields. Those that are here have one row of them.
struct PointCloud {
  static constexpr std::string_view kType = "sensor_msgs/msg/PointCloud2";
  struct Field {
    static constexpr std::uint8_t kWord = 6;   ///< 32 bits without a sign
    static constexpr std::uint8_t kFloat = 7;  ///< 32 bits
    std::string name;
    std::uint32_t offset = 0;  ///< in a point [bytes]
    std::uint8_t type = kFloat;
    std::uint32_t count = 1;
  };
  Header header;
  std::uint32_t height = 1, width = 0;
  std::vector<Field> fields;
  bool isBigEndian = false;
  std::uint32_t pointStep = 0, rowStep = 0;  ///< [bytes]
  std::vector<std::uint8_t> data;
  bool isDense = true;  ///< no coordinate is NaN
};

/// Numbers that have no other message.
struct Words {
  static constexpr std::string_view kType = "std_msgs/msg/UInt32MultiArray";
  struct Dimension {
    std::string label;
    std::uint32_t size = 0, stride = 0;
  };
  std::vector<Dimension> dimensions;
  std::uint32_t offset = 0;
  std::vector<std::uint32_t> data;
};

/// The message in CDR (XCDR version 1), little endian, with the four bytes before it that say so.
/// For every message with a kType. @pre stamps are within 2^31 s of 1970
template <class M>
ORTUNG_API std::string toCdr(const M& message);

/// Reads CDR of either byte order from bytes that nobody vouches for; bytes behind the message are
/// passed over, as later versions of a type add fields at the end. Numbers may be NaN.
/// @param why what was found and expected, where it is none
template <class M>
ORTUNG_API std::optional<M> fromCdr(std::string_view bytes, std::string& why);

/// The definition of a message and of all that it is made of, in the form "ros2msg"; "" for a type
/// that is not here.
ORTUNG_API std::string schemaText(std::string_view type);

}  // namespace ortung::ros2
