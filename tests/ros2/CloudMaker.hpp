#pragma once

/// Clouds of points in any layout that the message permits, written byte by byte.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "ortung/ros2/Messages.hpp"

namespace ortung::testing {

struct CloudPoint {
  double x = 0.0, y = 0.0, z = 0.0;  ///< [m]
  double time = 0.0;                 ///< as the cloud tells it
};

/// How points are laid out. By default as many drivers do: x, y, z in 32 bits, 16 bytes a point.
struct CloudForm {
  using Field = ros2::PointCloud::Field;
  std::vector<Field> fields{{"x", 0, Field::kFloat, 1},
                            {"y", 4, Field::kFloat, 1},
                            {"z", 8, Field::kFloat, 1},
                            {"intensity", 12, Field::kFloat, 1}};
  std::uint32_t pointStep = 16;
  std::uint32_t rows = 1;
  std::uint32_t rowPadding = 0;  ///< behind each row [bytes]
  bool isBigEndian = false;
};

/// Writes a number of a type of sensor_msgs/PointField.
inline void putNumber(double number, std::uint8_t type, bool isBigEndian, std::uint8_t* to) {
  const auto put = [&](auto value) {
    std::memcpy(to, &value, sizeof value);
    if (isBigEndian) std::reverse(to, to + sizeof value);
  };
  switch (type) {
    case 1:
      return put(static_cast<std::int8_t>(number));
    case 2:
      return put(static_cast<std::uint8_t>(number));
    case 3:
      return put(static_cast<std::int16_t>(number));
    case 4:
      return put(static_cast<std::uint16_t>(number));
    case 5:
      return put(static_cast<std::int32_t>(number));
    case 6:
      return put(static_cast<std::uint32_t>(number));
    case 7:
      return put(static_cast<float>(number));
    default:
      return put(number);
  }
}

/// Makes a cloud. Bytes that no field has are 0xA5; numbers of a field that does not lie in its
/// point are left out. @pre points.size() is a multiple of form.rows
inline ros2::PointCloud cloudOf(const std::vector<CloudPoint>& points, const CloudForm& form = {},
                                std::int64_t stamp = 0, const std::string& frame = "lidar") {
  ros2::PointCloud cloud;
  cloud.header = {stamp, frame};
  cloud.height = form.rows;
  cloud.width = static_cast<std::uint32_t>(points.size() / form.rows);
  cloud.fields = form.fields;
  cloud.isBigEndian = form.isBigEndian;
  cloud.pointStep = form.pointStep;
  cloud.rowStep = cloud.width * cloud.pointStep + form.rowPadding;
  cloud.data.assign(std::size_t{cloud.rowStep} * cloud.height, 0xA5);
  constexpr std::array<std::uint32_t, 9> kSizes{8, 1, 1, 2, 2, 4, 4, 4, 8};
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint8_t* at =
        cloud.data.data() + i / cloud.width * cloud.rowStep + i % cloud.width * cloud.pointStep;
    for (const auto& field : form.fields) {
      if (field.offset + kSizes[field.type < 9 ? field.type : 0] > form.pointStep) continue;
      const CloudPoint& p = points[i];
      const double number = field.name == "x"           ? p.x
                            : field.name == "y"         ? p.y
                            : field.name == "z"         ? p.z
                            : field.name == "intensity" ? 7.0
                                                        : p.time;
      putNumber(number, field.type, form.isBigEndian, at + field.offset);
    }
  }
  return cloud;
}

}  // namespace ortung::testing
