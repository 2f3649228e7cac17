// Localizes a robot by readings that the program itself provides, e.g. of devices that it drives.
//
//   own_readings ROBOT_FILE TABLES < READINGS
//
// Here each line is a reading of odometry and scanner: STAMP_US X Y THETA RANGE RANGE ...
// in metres and radians; a range of 0 is invalid. The robot file has both as
// maps/robots/pioneer.toml does.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"
#include "ortung/run/Localization.hpp"

int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  ortung::Localization localization({.robot = argv[1], .tables = argv[2]});
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream numbers(line);
    ortung::Timestamp now = 0;
    ortung::Pose2 moved;
    numbers >> now >> moved.x >> moved.y >> moved.theta;
    std::vector<float> ranges{std::istream_iterator<float>(numbers), {}};
    std::ranges::replace(ranges, 0.0F, NAN);
    std::vector<std::uint32_t> scan;
    ortung::ScanData::encode(ranges, 8.0, scan);  // the scanner's greatest range is 8 m
    localization.container().set(std::vector<ortung::Message>{
        {now, {"odometry", "odometry", "pose"}, ortung::OdometryData::encode({.pose = moved})},
        {now, {"LMS200", "LRF", "180DegreeScan"}, scan}});
    if (const auto e = localization.update())
      std::printf("%.3f %.3f %.4f\n", e->pose.x, e->pose.y, e->pose.theta);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "own_readings: %s\n", error.what());
  return 1;
}
