// Messages of ROS 2 as a robot on the network may send them: any bytes, in any order, and sound
// ones with any numbers.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "LiveReadings.hpp"
#include "MapWorld.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace {

using namespace ortung::ros2;

/// Takes numbers from the input.
class Input {
 public:
  explicit Input(std::string_view bytes) : bytes_(bytes) {}
  bool isEmpty() const { return bytes_.empty(); }
  template <class T>
  T take() {
    T value{};
    const std::size_t size = std::min(sizeof value, bytes_.size());
    std::memcpy(&value, bytes_.data(), size);
    bytes_.remove_prefix(size);
    return value;
  }
  std::string_view piece() {
    const std::string_view piece = bytes_.substr(0, take<std::uint8_t>());
    bytes_.remove_prefix(std::min(piece.size(), bytes_.size()));
    return piece;
  }

 private:
  std::string_view bytes_;
};

Header headerOf(Input& in, const std::string& frame) {
  constexpr std::int64_t kMost = std::int64_t{1} << 60;
  // Small steps as a rule, so that moments come to their end.
  const bool isNear = in.take<std::uint8_t>() != 0;
  const std::int64_t stamp =
      isNear ? 1'000'000'000'000 + in.take<std::uint16_t>() * 1'000'000LL : in.take<std::int64_t>();
  return {std::clamp(stamp, -kMost, kMost), frame};
}

std::string scanOf(Input& in) {
  LaserScan scan;
  scan.header = headerOf(in, "laser");
  scan.angleMin = in.take<float>();
  scan.angleIncrement = in.take<std::uint8_t>() != 0 ? 0.1F : in.take<float>();
  scan.rangeMax = in.take<std::uint8_t>() != 0 ? 10.0F : in.take<float>();
  scan.ranges.resize(in.take<std::uint8_t>() != 0 ? 5 : in.take<std::uint8_t>());
  for (float& range : scan.ranges) range = in.take<float>();
  return toCdr(scan);
}

std::string odometryOf(Input& in) {
  Odometry moved;
  moved.header = headerOf(in, "odom");
  moved.childFrame = "base_footprint";
  moved.pose = {{in.take<double>(), in.take<double>(), 0.0}, {0, 0, in.take<double>(), 1}};
  moved.linear.x = in.take<double>();
  moved.angular.z = in.take<float>();
  return toCdr(moved);
}

std::string framesOf(Input& in) {
  static constexpr const char* kNames[] = {"odom", "base_footprint", "laser", "map"};
  TfMessage frames;
  const std::size_t count = in.take<std::uint8_t>() % 4;
  for (std::size_t i = 0; i < count; ++i)
    frames.transforms.push_back(
        {headerOf(in, kNames[in.take<std::uint8_t>() % 4]),
         kNames[in.take<std::uint8_t>() % 4],
         {{in.take<double>(), in.take<float>(), 0}, {0, 0, in.take<float>(), in.take<float>()}}});
  return toCdr(frames);
}

void takeOne(Input& in, LiveReadings& readings) {
  switch (in.take<std::uint8_t>() % 8) {
    case 0:
      return readings.takeScan(0, in.piece());
    case 1:
      return readings.takeOdometry(in.piece());
    case 2:
      return readings.takeTransforms(in.piece(), false);
    case 3:
      return readings.takeTransforms(in.piece(), true);
    case 4:
      return readings.takeScan(0, scanOf(in));
    case 5:
      return readings.takeTransforms(framesOf(in), false);
    case 6:
      return readings.takeTransforms(framesOf(in), true);
    default:
      return readings.takeOdometry(odometryOf(in));
  }
}

/// What comes out can be set in a container, and comes in the order of time.
void takeAll(LiveReadings& readings, const ortung::ScanData::Config& scanner) {
  ortung::OdometryData odometry({"odometry", "odometry", "pose"});
  ortung::ScanData scan({"laser", "LRF", "scan"}, {}, scanner);
  while (const auto moment = readings.next(std::chrono::milliseconds(0))) {
    if (moment->readings.empty()) return;
    for (const ortung::Message& reading : moment->readings) {
      if (reading.stamp != moment->readings.front().stamp) std::abort();
      reading.id.type == "LRF" ? scan.checkData(reading.words) : odometry.checkData(reading.words);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input in({reinterpret_cast<const char*>(data), size});
  LiveReadings::Options options;
  options.scanners = {{"scan", {"laser", "LRF", "scan"}, 5, 10.0}};
  options.odometry = {"odometry", "odometry", "pose"};
  options.followsFrames = in.take<std::uint8_t>() % 2 == 1;
  ortung::ScanData::Config scanner;
  scanner.beams = 5;
  scanner.angleStep = 0.1;
  scanner.maxRange = 10.0;
  LiveReadings readings(options);
  while (!in.isEmpty()) {
    takeOne(in, readings);
    takeAll(readings, scanner);
  }
  std::string why;
  const auto map = fromCdr<OccupancyGrid>({reinterpret_cast<const char*>(data), size}, why);
  if (map) whyNoWorld(*map);
  return 0;
}
