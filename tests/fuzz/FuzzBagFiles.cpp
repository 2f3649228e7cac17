// Files of bags: SQLite's of rosbag2 and those of ROS 1. The first byte says what the rest is: a
// file, whole; a file to be compressed by zstd; records of a chunk, or changes of a sound one; or
// changes of a sound .db3 file.
#include <sqlite3.h>

#include <algorithm>
#include <memory>

#include "BagFile.hpp"
#include "CloudLayout.hpp"
#include "CloudMaker.hpp"
#include "Compression.hpp"
#include "Fuzz.hpp"
#include "Ros1Maker.hpp"
#include "ortung/ros2/Messages.hpp"

namespace {

using namespace ortung;
using namespace ortung::ros2;
using testing::Ros1Maker;

LaserScan scan() {
  LaserScan one;
  one.header = {5, "laser"};
  one.ranges = {1.0F, 2.0F, 3.0F};
  return one;
}

/// Puts bytes into a file: triples of a place and a byte.
std::string changed(std::string file, std::string_view changes) {
  for (std::size_t i = 0; i + 2 < changes.size(); i += 3) {
    const std::size_t at =
        static_cast<std::uint8_t>(changes[i]) * 256U + static_cast<std::uint8_t>(changes[i + 1]);
    file[at % file.size()] = changes[i + 2];
  }
  return file;
}

const std::string& soundRecords() {
  static const std::string kRecords = [] {
    Ros1Maker maker;
    for (int i = 0; i < 3; ++i)
      maker.add("scan", "sensor_msgs/LaserScan", testing::toRos1(scan()))
          .add("/tf", "tf/tfMessage",
               testing::toRos1(TfMessage{{{{1, "/odom"}, "/base_link", {}}}}))
          .add("/points", "sensor_msgs/PointCloud2",
               testing::toRos1(testing::cloudOf({{1, 2, 3}, {4, 5, 6}})));
    return maker.records;
  }();
  return kRecords;
}

/// A .db3 file of some pages: several leaves, and messages that go on in other pages.
const std::string& soundDb3() {
  static const std::string kFile = [] {
    sqlite3* made = nullptr;
    fuzz::require(sqlite3_open(":memory:", &made) == SQLITE_OK);
    const std::unique_ptr<sqlite3, int (*)(sqlite3*)> base(made, sqlite3_close);
    const char* sql =
        "PRAGMA page_size = 512; CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL,"
        "type TEXT NOT NULL, serialization_format TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
        "timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
        "CREATE INDEX timestamp_idx ON messages (timestamp ASC);"
        "INSERT INTO topics VALUES (1, '/scan', 'sensor_msgs/msg/LaserScan', 'cdr');"
        "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 40)"
        "INSERT INTO messages SELECT i, 1, i, zeroblob(i * i) FROM n;";
    fuzz::require(sqlite3_exec(made, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_int64 size = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> bytes(
        sqlite3_serialize(made, "main", &size, 0), sqlite3_free);
    return std::string(reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size));
  }();
  return kFile;
}

std::string fileOf(std::string_view input) {
  const auto kind = static_cast<std::uint8_t>(input[0]);
  input.remove_prefix(1);
  const std::string head = "#ROSBAG V2.0\n" + Ros1Maker::bagHeader(kind / 8);
  switch (kind % 8) {
    case 0:
      return std::string(input);
    case 1:
      return packZstd(input);
    case 2:
      return head + std::string(input);
    case 3:
      return head + Ros1Maker::chunkOf("none", input.size(), input);
    case 4: {
      const std::string records = changed(soundRecords(), input);
      return head + Ros1Maker::chunkOf("lz4", records.size(), packLz4(records));
    }
    case 5:
      return changed(head + Ros1Maker::chunkOf("none", soundRecords().size(), soundRecords()),
                     input);
    case 6:
      return packZstd(changed(soundDb3(), input));
    default:
      return changed(soundDb3(), input);
  }
}

template <class M>
void decode(std::string_view bytes) {
  std::string why;
  const bool isRead = fromRos1<M>(bytes, why).has_value();
  fuzz::require(isRead == why.empty());
}

/// What a cloud says of its bytes is read, or refused.
void findPoints(std::string_view bytes) {
  std::string why;
  const auto cloud = fromRos1<PointCloud>(bytes, why);
  if (!cloud) return;
  const auto layout = CloudLayout::of(*cloud, why);
  if (!layout) return;
  std::vector<float> x(layout->columns()), y(x), z(x);
  for (std::size_t row = 0; row < layout->rows(); ++row) {
    layout->readPlaces(row, 0, x, y, z);
    if (layout->hasTimes()) layout->readTimes(row, 0, x);
  }
}

void read(std::string_view input) {
  const auto file = openBagFile(fuzz::write("run.bag", fileOf(input)));
  for (McapMessage message; file->next(message);) {
    fuzz::require(message.channel != nullptr);
    decode<LaserScan>(message.data);
    decode<Odometry>(message.data);
    decode<TfMessage>(message.data);
    decode<OccupancyGrid>(message.data);
    decode<Image>(message.data);
    decode<PointCloud>(message.data);
    findPoints(message.data);
    decode<Imu>(message.data);
    decode<DiagnosticArray>(message.data);
    decode<Words>(message.data);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  fuzz::refusedOrDone<std::runtime_error>(
      [&] { read({reinterpret_cast<const char*>(bytes), size}); });
  return 0;
}
