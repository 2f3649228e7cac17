// A bag of ROS 2 with the input as messages of each type that is imported, by the source `mcap`:
// the first two bytes have the source's options; each message is introduced by a byte for its type
// and how it changes, and one for its length.
#include <algorithm>
#include <array>
#include <limits>

#include "Fuzz.hpp"
#include "Paths.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/core/Source.hpp"
#include "ortung/ros2/McapWriter.hpp"
#include "ortung/ros2/Messages.hpp"

namespace {

using namespace ortung;
using namespace ortung::ros2;

/// Sound messages, into which the input's bytes are put: a random one seldom passes for any.
template <class M>
std::string sound(int) {
  return toCdr(M());
}
template <>
std::string sound<LaserScan>(int number) {
  LaserScan scan;
  scan.header = {number * std::int64_t{100'000'000}, "laser"};
  scan.angleMin = -0.5F;
  scan.angleMax = 0.5F;
  scan.angleIncrement = 0.25F;
  scan.rangeMax = 8.0F;
  scan.ranges = {1.0F, 2.0F, 3.0F, 4.0F, 5.0F};
  return toCdr(scan);
}
template <>
std::string sound<ros2::Range>(int number) {
  ros2::Range range;
  range.header = {number * std::int64_t{100'000'000}, "sonar"};
  range.fieldOfView = 0.5F;
  range.maxRange = 4.0F;
  range.range = 1.0F;
  return toCdr(range);
}
template <>
std::string sound<TfMessage>(int number) {
  return toCdr(TfMessage{{{{number, "base_link"}, "laser", {{0.1, 0, 0.2}, {}}},
                          {{number, "odom"}, "base_link", {{1, 0, 0}, {}}}}});
}
template <>
std::string sound<Image>(int number) {
  Image image;
  image.header = {number, "camera"};
  image.width = image.height = 2;
  image.step = 6;
  image.encoding = "rgb8";
  image.data.resize(12);
  return toCdr(image);
}
template <>
std::string sound<OccupancyGrid>(int number) {
  OccupancyGrid map;
  map.header = {number, "map"};
  map.resolution = 0.1F;
  map.width = map.height = 3;
  map.data.resize(9, 100);
  return toCdr(map);
}

template <>
std::string sound<Imu>(int number) {
  Imu imu;
  imu.header = {number * std::int64_t{100'000'000}, "base_link"};
  imu.orientation = {0.02, 0.01, 0, 1};
  return toCdr(imu);
}
template <>
std::string sound<PointCloud>(int number) {
  PointCloud cloud;
  cloud.header = {number * std::int64_t{100'000'000}, "laser"};
  cloud.fields = {{"x", 0, PointCloud::Field::kFloat, 1},
                  {"y", 4, PointCloud::Field::kFloat, 1},
                  {"z", 8, PointCloud::Field::kFloat, 1},
                  {"t", 12, PointCloud::Field::kWord, 1}};
  cloud.pointStep = 16;
  cloud.width = 2;
  cloud.rowStep = 32;
  cloud.data = {0, 0, 128, 63, 0, 0, 0, 0,  0, 0, 0, 63, 0, 0, 0,  0,   // (1, 0, 0.5)
                0, 0, 0,   0,  0, 0, 0, 64, 0, 0, 0, 63, 0, 0, 16, 0};  // (0, 2, 0.5)
  return toCdr(cloud);
}

struct Kind {
  std::string_view type;
  const char* topic;
  std::string (*sound)(int);
  const char* feature;
};
constexpr std::array<Kind, 13> kKinds{{
    {LaserScan::kType, "/scan", sound<LaserScan>, ""},
    {LaserScan::kType, "/top", sound<LaserScan>, "top/LRF/scan"},
    {Odometry::kType, "/odom", sound<Odometry>, ""},
    {TfMessage::kType, "/tf_static", sound<TfMessage>, ""},
    {TfMessage::kType, "/tf", sound<TfMessage>, ""},
    {PoseStamped::kType, "/ground_truth", sound<PoseStamped>, ""},
    {PoseWithCovarianceStamped::kType, "/pose", sound<PoseWithCovarianceStamped>,
     "mcl/LOCALIZATION/pose"},
    {OccupancyGrid::kType, "/map", sound<OccupancyGrid>, ""},
    {ros2::Range::kType, "/sonar", sound<ros2::Range>, ""},
    {Image::kType, "/image", sound<Image>, ""},
    {Words::kType, "/words", sound<Words>, "own/type/words"},
    {PointCloud::kType, "/points", sound<PointCloud>, ""},
    {Imu::kType, "/imu", sound<Imu>, ""},
}};

/// Puts bytes into a message: triples of a place and a byte.
std::string changed(std::string message, std::string_view changes, bool isAll) {
  if (isAll) return std::string(changes);
  for (std::size_t i = 0; i + 1 < changes.size(); i += 2)
    message[static_cast<std::uint8_t>(changes[i]) % message.size()] = changes[i + 1];
  return message;
}

std::string bagOf(std::string_view input) {
  std::string bag;
  McapWriter writer([&](std::string_view piece) { bag += piece; }, {.isChunked = false});
  std::array<std::uint16_t, kKinds.size()> channels{};
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    std::map<std::string, std::string> about;
    if (*kKinds[i].feature != '\0') about["ortung_feature"] = kKinds[i].feature;
    channels[i] = writer.addChannel(writer.addSchema(std::string(kKinds[i].type), "ros2msg", ""),
                                    kKinds[i].topic, "cdr", about);
  }
  int number = 0;
  for (; input.size() >= 2 && number < 64; ++number) {
    const auto kind = static_cast<std::uint8_t>(input[0]);
    const std::size_t length =
        std::min<std::size_t>(static_cast<std::uint8_t>(input[1]), input.size() - 2);
    const std::size_t i = kind % kKinds.size();
    writer.write(channels[i], static_cast<std::uint64_t>(number) << (kind / 4),
                 changed(kKinds[i].sound(number), input.substr(2, length), kind >= 0x80));
    input.remove_prefix(2 + length);
  }
  writer.finish();
  return bag;
}

void read(std::string_view input) {
  static PluginFactory factory({ORTUNG_PLUGINS_DIR});
  constexpr std::array<std::pair<const char*, const char*>, 14> kOptions{
      {{"images", "/image"},
       {"truth", "tf"},
       {"odometry", "tf"},
       {"base", "base_link"},
       {"stamps", "log"},
       {"scans", "/top"},
       {"mounts", "laser:1,0,90"},
       {"max_range_m", "5"},
       {"clouds", "/points"},
       {"level", "/imu"},
       {"band", "-1,1"},
       {"cloud_beams", "8"},
       {"cloud_min_range_m", "0.01"},
       {"level", "none"}}};
  Parameters parameters("mcap");
  parameters.set("path", fuzz::write("run.mcap", bagOf(input.substr(2))).string());
  for (std::size_t i = 0; i < kOptions.size(); ++i)
    if ((static_cast<std::uint8_t>(input[i / 8]) >> (i % 8) & 1) != 0)
      parameters.set(kOptions[i].first, std::string(kOptions[i].second));
  const auto source = factory.make<Source>("mcap", parameters);
  Timestamp last = std::numeric_limits<Timestamp>::min();
  for (Message message; source->next(message);) {
    fuzz::require(message.stamp >= last && !message.id.model.empty());
    last = message.stamp;
  }
  source->robotToml();
  source->remark();
  source->writeWorld(fuzz::folder() / "out.toml");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size < 2) return 0;
  fuzz::refusedOrDone<std::runtime_error, std::invalid_argument>(
      [&] { read({reinterpret_cast<const char*>(bytes), size}); });
  return 0;
}
