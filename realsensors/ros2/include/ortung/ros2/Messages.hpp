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

// The messages of ROS 2 for a robot in the plane, field by field as their packages define them
// (with Ortung's names). Lengths [m], angles [rad], times [ns since 1970]. Fields without a value,
// such as covariances of velocities, are zeros.

/// Time and frame of a message's data.
struct Header {
  std::int64_t stamp = 0;  ///< time of measurement [ns], within 2^31 s of 1970
  std::string frame;       ///< name of the frame
};
/// A vector or place in space; its unit depends on the message.
struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;
};
/// A rotation in space.
struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};
/// A pose in space.
struct Pose {
  Vector3 position;        ///< place [m]
  Quaternion orientation;  ///< rotation
};
/// Covariance of x, y, z and the rotations about these axes, row-major [m, rad].
using Covariance = std::array<double, 36>;

/// A scan of a laser scanner.
struct LaserScan {
  static constexpr std::string_view kType = "sensor_msgs/msg/LaserScan";
  Header header;
  float angleMin = 0.0F, angleMax = 0.0F, angleIncrement = 0.0F;  ///< angles of beams [rad]
  float timeIncrement = 0.0F, scanTime = 0.0F;  ///< time between beams, and between scans [s]
  float rangeMin = 0.0F, rangeMax = 0.0F;       ///< limits of the ranges [m]
  std::vector<float> ranges;       ///< ranges [m]; NaN: invalid; +infinity: nothing seen (REP 117)
  std::vector<float> intensities;  ///< intensity of each range, or empty
};

/// Pose and velocity of a robot by its odometry, or by any other estimate.
struct Odometry {
  static constexpr std::string_view kType = "nav_msgs/msg/Odometry";
  Header header;
  std::string childFrame;  ///< frame of the velocities, e.g. "base_link"
  Pose pose;
  Covariance poseCovariance{};   ///< covariance of the pose
  Vector3 linear;                ///< velocity in the child frame [m/s]
  Vector3 angular;               ///< angular velocity in the child frame [rad/s]
  Covariance twistCovariance{};  ///< covariance of the velocities
};

/// A velocity that a robot is told, at /cmd_vel.
struct Twist {
  static constexpr std::string_view kType = "geometry_msgs/msg/Twist";
  Vector3 linear;   ///< velocity in the robot's frame [m/s]
  Vector3 angular;  ///< angular velocity [rad/s]
};
/// A velocity with time and frame, as Nav2 tells it by an option since Jazzy.
struct TwistStamped {
  static constexpr std::string_view kType = "geometry_msgs/msg/TwistStamped";
  Header header;
  Twist twist;
};

/// The simulated time, at /clock.
struct RosClock {
  static constexpr std::string_view kType = "rosgraph_msgs/msg/Clock";
  std::int64_t time = 0;  ///< [ns], at least 0, below 2^31 s
};

/// The pose of a frame in its parent frame.
struct TransformStamped {
  Header header;
  std::string childFrame;  ///< frame whose pose this is
  Pose transform;          ///< pose of the child frame in the header's frame
};
/// Poses of frames, at /tf and /tf_static.
struct TfMessage {
  static constexpr std::string_view kType = "tf2_msgs/msg/TFMessage";
  std::vector<TransformStamped> transforms;
};

/// A pose with time and frame.
struct PoseStamped {
  static constexpr std::string_view kType = "geometry_msgs/msg/PoseStamped";
  Header header;
  Pose pose;
};
/// A pose with its covariance, time and frame.
struct PoseWithCovarianceStamped {
  static constexpr std::string_view kType = "geometry_msgs/msg/PoseWithCovarianceStamped";
  Header header;
  Pose pose;
  Covariance covariance{};  ///< covariance of the pose
};
/// Several poses, e.g. samples of a filter.
struct PoseArray {
  static constexpr std::string_view kType = "geometry_msgs/msg/PoseArray";
  Header header;
  std::vector<Pose> poses;
};

/// A sample of a filter.
struct Particle {
  Pose pose;
  double weight = 0.0;  ///< those of a cloud have the sum 1
};
/// The samples of a filter, as Nav2 has them.
struct ParticleCloud {
  static constexpr std::string_view kType = "nav2_msgs/msg/ParticleCloud";
  Header header;
  std::vector<Particle> particles;
};

/// A grid map.
struct OccupancyGrid {
  static constexpr std::string_view kType = "nav_msgs/msg/OccupancyGrid";
  Header header;
  std::int64_t mapLoadTime = 0;         ///< time at which the map was loaded [ns since 1970]
  float resolution = 0.0F;              ///< size of a cell [m]
  std::uint32_t width = 0, height = 0;  ///< size of the map [cells]
  Pose origin;                          ///< pose of the lower left corner of cell (0, 0)
  std::vector<std::int8_t> data;        ///< rows from below: 0 free to 100 occupied, -1 unknown
};

/// A range of a sonar or an infrared sensor.
struct Range {
  static constexpr std::string_view kType = "sensor_msgs/msg/Range";
  Header header;
  std::uint8_t radiationType = 0;          ///< kind of radiation: 0 sound, 1 infrared
  float fieldOfView = 0.0F;                ///< opening angle of the cone [rad]
  float minRange = 0.0F, maxRange = 0.0F;  ///< limits of the range [m]
  float range = 0.0F;  ///< range [m]; NaN: invalid; +infinity: nothing within range
};

/// An image of a camera.
struct Image {
  static constexpr std::string_view kType = "sensor_msgs/msg/Image";
  Header header;
  std::uint32_t height = 0, width = 0;  ///< size [px]
  std::string encoding;                 ///< format of the pixels: "rgb8", "mono8", ...
  std::uint8_t isBigEndian = 0;         ///< whether numbers of several bytes are big-endian
  std::uint32_t step = 0;               ///< length of a row [bytes]
  std::vector<std::uint8_t> data;
};

/// How a part of a robot is turned and how it moves, by an inertial unit.
struct Imu {
  static constexpr std::string_view kType = "sensor_msgs/msg/Imu";
  using Covariance3 = std::array<double, 9>;  ///< row-major; its first number is -1: no such value
  Header header;
  Quaternion orientation;  ///< of the unit, in a frame whose z axis points up (REP 145)
  Covariance3 orientationCovariance{};   ///< [rad^2]
  Vector3 angular;                       ///< angular velocity in the unit's frame [rad/s]
  Covariance3 angularCovariance{};       ///< [rad^2/s^2]
  Vector3 acceleration;                  ///< with that of gravity, in the unit's frame [m/s^2]
  Covariance3 accelerationCovariance{};  ///< [m^2/s^4]
};

/// Points, each of the same fields, in rows.
struct PointCloud {
  static constexpr std::string_view kType = "sensor_msgs/msg/PointCloud2";
  struct Field {
    static constexpr std::uint8_t kWord = 6;    ///< 32 bits without a sign
    static constexpr std::uint8_t kFloat = 7;   ///< 32 bits
    static constexpr std::uint8_t kDouble = 8;  ///< 64 bits
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

/// How parts of a robot are, for people and for those who stop it: at /diagnostics.
struct DiagnosticArray {
  static constexpr std::string_view kType = "diagnostic_msgs/msg/DiagnosticArray";
  struct KeyValue {
    std::string key, value;
  };
  struct Status {
    enum Level : std::uint8_t { kOk, kWarn, kError, kStale };
    std::uint8_t level = kStale;
    std::string name;        ///< of the part
    std::string message;     ///< how it is
    std::string hardwareId;  ///< of the device; "": none
    std::vector<KeyValue> values;
  };
  Header header;
  std::vector<Status> status;
};

/// Numbers that have no other message.
struct Words {
  static constexpr std::string_view kType = "std_msgs/msg/UInt32MultiArray";
  /// A dimension of the array.
  struct Dimension {
    std::string label;
    std::uint32_t size = 0, stride = 0;
  };
  std::vector<Dimension> dimensions;
  std::uint32_t offset = 0;
  std::vector<std::uint32_t> data;
};

/// Encodes a message in CDR (XCDR version 1), little endian, after the four bytes that say so.
/// Available for every message with a kType. @pre stamps are within 2^31 s of 1970
template <class M>
ORTUNG_API std::string toCdr(const M& message);

/// Decodes CDR of either byte order from untrusted bytes. Bytes behind the message are ignored,
/// since later versions of a type add fields at the end. Numbers may be NaN.
/// @param why out: what was found and expected, if it is not such a message
/// @return the message, or nothing
template <class M>
ORTUNG_API std::optional<M> fromCdr(std::string_view bytes, std::string& why);

/// Decodes CDR as above into a message that is there, whose memory it uses again.
/// @return whether it is such a message; if not, its content is anything
template <class M>
ORTUNG_API bool fromCdr(std::string_view bytes, M& message, std::string& why);

/// Decodes the same message as ROS 1 serializes it, from untrusted bytes: little endian without
/// alignment. Frames lose the slash at their beginning. Bytes behind the message are ignored.
/// Numbers may be NaN.
/// @param why out: what was found, if it is not such a message
/// @return the message, or nothing
template <class M>
ORTUNG_API std::optional<M> fromRos1(std::string_view bytes, std::string& why);

/// Returns the definition of a type and of all types that it contains, in the form "ros2msg"; ""
/// for an unknown type.
ORTUNG_API std::string schemaText(std::string_view type);

}  // namespace ortung::ros2
