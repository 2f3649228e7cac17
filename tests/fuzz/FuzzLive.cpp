// Messages of ROS 2 as a robot on the network may send them: any bytes, in any order, and sound
// ones with any numbers.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "LiveReadings.hpp"
#include "MapWorld.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/PoseFixData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace {

using namespace ortung::ros2;
using ortung::SensorId;

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

/// A cloud of up to 255 bytes, whose fields and sizes are mostly sound.
std::string cloudOf(Input& in) {
  static constexpr const char* kNames[] = {"x", "y", "z", "t", "time", "timestamp"};
  PointCloud cloud;
  cloud.header = headerOf(in, in.take<std::uint8_t>() != 0 ? "laser" : "odom");
  const bool isSound = in.take<std::uint8_t>() % 4 != 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto type = in.take<std::uint8_t>();
    const char* name = i < 3 ? kNames[i] : kNames[3 + type % 3];
    cloud.fields.push_back({name, isSound ? 4 * i : in.take<std::uint32_t>(),
                            isSound ? PointCloud::Field::kFloat : type, 1});
  }
  cloud.pointStep = isSound ? 16 : in.take<std::uint32_t>();
  cloud.isBigEndian = in.take<std::uint8_t>() % 2 == 1;
  const std::string_view bytes = in.piece();
  cloud.data.assign(bytes.begin(), bytes.end());
  cloud.height = isSound ? 1 : in.take<std::uint32_t>();
  cloud.width = isSound ? static_cast<std::uint32_t>(bytes.size() / 16) : in.take<std::uint32_t>();
  cloud.rowStep = isSound ? cloud.width * 16 : in.take<std::uint32_t>();
  return toCdr(cloud);
}

std::string imuOf(Input& in) {
  Imu imu;
  imu.header = headerOf(in, in.take<std::uint8_t>() != 0 ? "base_footprint" : "laser");
  imu.orientation = {in.take<float>(), in.take<float>(), in.take<double>(), in.take<float>()};
  imu.orientationCovariance[0] = in.take<float>();
  return toCdr(imu);
}

void takeOne(Input& in, LiveReadings& readings) {
  switch (in.take<std::uint8_t>() % 14) {
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
    case 8:
      return readings.takeCloud(0, in.piece());
    case 9:
      return readings.takeCloud(0, cloudOf(in));
    case 10:
      return readings.takeImu(in.piece());
    case 11:
      return readings.takeImu(imuOf(in));
    case 12:
      return readings.takeFeature(0, in.piece());
    case 13:
      return readings.takeFeature(1, in.piece());
    default:
      return readings.takeOdometry(odometryOf(in));
  }
}

/// The features that messages fill as they are.
const ortung::SensorContainer& features() {
  static const auto* const kAll = [] {
    auto* all = new ortung::SensorContainer;
    all->add(std::make_unique<ortung::ConeData>(ortung::SensorId{"front", "sonar", "range"},
                                                ortung::Pose2{}, ortung::ConeData::Config{}));
    all->add(std::make_unique<ortung::PoseFixData>(ortung::SensorId{"marker", "fix", "pose"},
                                                   ortung::PoseFixData::Config{}));
    return all;
  }();
  return *kAll;
}
const ortung::SensorData& featureOf(const ortung::SensorId& id) {
  return *features().findExactly(id);
}

/// What comes out can be set in a container, and comes in the order of time.
void takeAll(LiveReadings& readings, const ortung::ScanData::Config& scanner) {
  ortung::OdometryData odometry({"odometry", "odometry", "pose"});
  ortung::ScanData scan({"laser", "LRF", "scan"}, {}, scanner);
  ortung::ScanData::Config around;
  around.beams = 8;
  around.angleStep = 0.785;
  ortung::ScanData cloud({"lidar", "LRF", "scan"}, {}, around);
  while (const auto moment = readings.next(std::chrono::milliseconds(0))) {
    if (moment->readings.empty()) return;
    for (const ortung::Message& reading : moment->readings) {
      if (reading.stamp != moment->readings.front().stamp) std::abort();
      if (reading.id.type == "sonar" || reading.id.type == "fix")
        featureOf(reading.id).checkData(reading.words);
      else if (reading.id.type != "LRF")
        odometry.checkData(reading.words);
      else
        (reading.id.model == "lidar" ? cloud : scan).checkData(reading.words);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input in({reinterpret_cast<const char*>(data), size});
  LiveReadings::Options options;
  options.scanners = {{"scan", {"laser", "LRF", "scan"}, 5, 10.0}};
  const SensorId lidar{"lidar", "LRF", "scan"};
  options.lidars = {{"points", lidar, {.beams = 8, .minHeight = -1.0}}};
  options.features = {liveFeatureOf(features(), "sonar=front/sonar/range", "map"),
                      liveFeatureOf(features(), "marker=marker/fix/pose", "map")};
  options.odometry = {"odometry", "odometry", "pose"};
  const auto kind = in.take<std::uint8_t>();
  options.followsFrames = kind % 2 == 1;
  options.level = kind % 4 < 2 ? "odometry" : "imu";
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
