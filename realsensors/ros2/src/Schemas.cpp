#include <algorithm>
#include <array>
#include <vector>

#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {
namespace {

/// A type as its package defines it, without the definitions of its parts.
struct Definition {
  std::string_view name;                  ///< name of the type without "msg/"
  std::string_view fields;                ///< definition of its fields
  std::array<std::string_view, 3> parts;  ///< types of fields, except numbers and texts
};

constexpr Definition kDefinitions[] = {
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n", {}},
    {"std_msgs/Header",
     "builtin_interfaces/Time stamp\nstring frame_id\n",
     {"builtin_interfaces/Time"}},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n", {}},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n", {}},
    {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n", {}},
    {"geometry_msgs/Pose",
     "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n",
     {"geometry_msgs/Point", "geometry_msgs/Quaternion"}},
    {"geometry_msgs/Transform",
     "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n",
     {"geometry_msgs/Vector3", "geometry_msgs/Quaternion"}},
    {"geometry_msgs/Twist",
     "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n",
     {"geometry_msgs/Vector3"}},
    {"geometry_msgs/TwistStamped",
     "std_msgs/Header header\ngeometry_msgs/Twist twist\n",
     {"std_msgs/Header", "geometry_msgs/Twist"}},
    {"rosgraph_msgs/Clock", "builtin_interfaces/Time clock\n", {"builtin_interfaces/Time"}},
    {"geometry_msgs/PoseWithCovariance",
     "geometry_msgs/Pose pose\nfloat64[36] covariance\n",
     {"geometry_msgs/Pose"}},
    {"geometry_msgs/TwistWithCovariance",
     "geometry_msgs/Twist twist\nfloat64[36] covariance\n",
     {"geometry_msgs/Twist"}},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n",
     {"std_msgs/Header", "geometry_msgs/Transform"}},
    {"geometry_msgs/PoseStamped",
     "std_msgs/Header header\ngeometry_msgs/Pose pose\n",
     {"std_msgs/Header", "geometry_msgs/Pose"}},
    {"geometry_msgs/PoseWithCovarianceStamped",
     "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n",
     {"std_msgs/Header", "geometry_msgs/PoseWithCovariance"}},
    {"geometry_msgs/PoseArray",
     "std_msgs/Header header\ngeometry_msgs/Pose[] poses\n",
     {"std_msgs/Header", "geometry_msgs/Pose"}},
    {"tf2_msgs/TFMessage",
     "geometry_msgs/TransformStamped[] transforms\n",
     {"geometry_msgs/TransformStamped"}},
    {"nav_msgs/Odometry",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
     "geometry_msgs/TwistWithCovariance twist\n",
     {"std_msgs/Header", "geometry_msgs/PoseWithCovariance", "geometry_msgs/TwistWithCovariance"}},
    {"nav_msgs/MapMetaData",
     "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\nuint32 height\n"
     "geometry_msgs/Pose origin\n",
     {"builtin_interfaces/Time", "geometry_msgs/Pose"}},
    {"nav_msgs/OccupancyGrid",
     "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n",
     {"std_msgs/Header", "nav_msgs/MapMetaData"}},
    {"nav2_msgs/Particle", "geometry_msgs/Pose pose\nfloat64 weight\n", {"geometry_msgs/Pose"}},
    {"nav2_msgs/ParticleCloud",
     "std_msgs/Header header\nnav2_msgs/Particle[] particles\n",
     {"std_msgs/Header", "nav2_msgs/Particle"}},
    {"sensor_msgs/LaserScan",
     "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
     "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n"
     "float32[] ranges\nfloat32[] intensities\n",
     {"std_msgs/Header"}},
    {"sensor_msgs/Range",
     "uint8 ULTRASOUND=0\nuint8 INFRARED=1\nstd_msgs/Header header\nuint8 radiation_type\n"
     "float32 field_of_view\nfloat32 min_range\nfloat32 max_range\nfloat32 range\n",
     {"std_msgs/Header"}},
    {"sensor_msgs/Imu",
     "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
     "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
     "float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n"
     "float64[9] linear_acceleration_covariance\n",
     {"std_msgs/Header", "geometry_msgs/Quaternion", "geometry_msgs/Vector3"}},
    {"sensor_msgs/PointField",
     "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\n"
     "uint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\n"
     "uint32 count\n",
     {}},
    {"sensor_msgs/PointCloud2",
     "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
     "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n",
     {"std_msgs/Header", "sensor_msgs/PointField"}},
    {"diagnostic_msgs/KeyValue", "string key\nstring value\n", {}},
    {"diagnostic_msgs/DiagnosticStatus",
     "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\n"
     "string message\nstring hardware_id\ndiagnostic_msgs/KeyValue[] values\n",
     {"diagnostic_msgs/KeyValue"}},
    {"diagnostic_msgs/DiagnosticArray",
     "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n",
     {"std_msgs/Header", "diagnostic_msgs/DiagnosticStatus"}},
    {"std_msgs/MultiArrayDimension", "string label\nuint32 size\nuint32 stride\n", {}},
    {"std_msgs/MultiArrayLayout",
     "std_msgs/MultiArrayDimension[] dim\nuint32 data_offset\n",
     {"std_msgs/MultiArrayDimension"}},
    {"std_msgs/UInt32MultiArray",
     "std_msgs/MultiArrayLayout layout\nuint32[] data\n",
     {"std_msgs/MultiArrayLayout"}},
    {"sensor_msgs/Image",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\n"
     "uint32 step\nuint8[] data\n",
     {"std_msgs/Header"}},
};

const Definition* find(std::string_view name) {
  for (const Definition& one : kDefinitions)
    if (one.name == name) return &one;
  return nullptr;
}

}  // namespace

std::string schemaText(std::string_view type) {
  std::string name(type);
  if (const std::size_t part = name.find("/msg/"); part != name.npos) name.erase(part, 4);
  const Definition* whole = find(name);
  if (whole == nullptr) return "";
  std::string text(whole->fields);
  std::vector<const Definition*> list{whole};  // each type once, its parts after it
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (const std::string_view part : list[i]->parts) {
      const Definition* one = find(part);
      if (one == nullptr || std::find(list.begin(), list.end(), one) != list.end()) continue;
      list.push_back(one);
      constexpr std::size_t kRule = 80;
      text += std::string(kRule, '=') + "\nMSG: " + std::string(one->name) + "\n";
      text += one->fields;
    }
  }
  return text;
}

}  // namespace ortung::ros2
