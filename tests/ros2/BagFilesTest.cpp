// Bags of ROS 2 in SQLite and bags of ROS 1: the same messages as those of an MCAP file.
#include <rapidcheck/gtest.h>

#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <fstream>
#include <random>
#include <sstream>

#include "BagMaker.hpp"
#include "Compression.hpp"
#include "Db3Maker.hpp"
#include "LogTesting.hpp"
#include "Ros1Maker.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using namespace ros2;

std::string packedBz2(const std::string& text) {
  std::istringstream in(text);
  boost::iostreams::filtering_istream packed;
  packed.push(boost::iostreams::bzip2_compressor());
  packed.push(in);
  return {std::istreambuf_iterator<char>(packed), {}};
}

/// "sensor_msgs/msg/LaserScan" as ROS 1 calls it.
std::string ros1Type(std::string_view type) {
  std::string name(type);
  return name.erase(name.find("/msg/"), 4);
}

class BagFiles : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  /// Hands each message of a recording to a function.
  template <class Take>
  static void record(Take take) {
    take("/tf_static", frameAt("base_footprint", "laser", {{0.2, 0, 0}, {}}));
    Image image;
    image.header = {kSecond, "camera"};
    image.width = image.height = 2;
    image.step = 6;
    image.encoding = "rgb8";
    image.data = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    take("/image", image);
    for (int i = 1; i <= 20; ++i) {
      take("/scan", scanOf(i * kSecond, "laser", {1.0F, 0.1F * static_cast<float>(i), 3.0F}));
      take("/odom", odometryAt(i * kSecond, 0.1 * i, 0.5));
      ros2::Range range;
      range.header = {i * kSecond, "sonar"};
      range.fieldOfView = 0.5F;
      range.maxRange = 4.0F;
      range.range = 1.0F;
      take("/sonar", range);
      PoseStamped pose;
      pose.header = {i * kSecond, "map"};
      take("/ground_truth", pose);
    }
  }
  std::string writeMcap(const std::string& name) const {
    BagMaker maker;
    record([&](const char* topic, const auto& message) { maker.add(topic, message); });
    return "mcap:" + folder_.write(name, maker.bytes()).string() + kImages;
  }
  void writeDb3(const std::string& name, bool isPacked = false,
                const std::string& settings = "") const {
    Db3Maker maker(path(name));
    maker.run(settings);
    maker.tables();
    record([&](const char* topic, const auto& message) {
      const std::string bytes = toCdr(message);
      maker.add(topic, message.kType, isPacked ? packZstd(bytes) : bytes);
    });
    maker.finish();
  }
  static Ros1Maker ros1() {
    Ros1Maker maker;
    record([&](const char* topic, const auto& message) {
      maker.add(topic, ros1Type(message.kType), toRos1(message));
    });
    return maker;
  }
  std::string errorOfBytes(const std::string& bytes) const {
    return errorOf("mcap:" + folder_.write("run.bin", bytes).string());
  }
  static constexpr const char* kImages = "?images=/image";
  TemporaryFolder folder_;
};

TEST_F(BagFiles, GiveTheSameReadingsAndRobotInEveryFormat) {
  const auto twin = makeSource(writeMcap("run.mcap"));
  const auto expected = asText(readAll(*twin));
  ASSERT_EQ(expected.size(), 81u);
  writeDb3("run.db3");
  writeDb3("packed.db3", true);
  writeDb3("journal.db3", false, "PRAGMA journal_mode = WAL");  // closed, so there is none
  folder_.write("journal.db3.zstd", packZstd(readBytes(path("journal.db3"))));
  folder_.write("run.db3.zstd", packZstd(readBytes(path("run.db3"))));
  folder_.write("run.mcap.zstd", packZstd(readBytes(path("run.mcap"))));
  const Ros1Maker maker = ros1();
  const std::string& records = maker.records;
  const std::string head = "#ROSBAG V2.0\n" + Ros1Maker::bagHeader();
  folder_.write("none.bag", maker.bag());
  folder_.write("bz2.bag", head + Ros1Maker::chunkOf("bz2", records.size(), packedBz2(records)));
  folder_.write("lz4.bag", head + Ros1Maker::chunkOf("lz4", records.size(), packLz4(records)));
  folder_.write("a %20#.db3", readBytes(path("run.db3")));
  folder_.write("called.mcap", readBytes(path("run.db3")));  // what it is stands in its first bytes
  for (const char* name :
       {"run.db3", "packed.db3", "run.db3.zstd", "journal.db3", "journal.db3.zstd", "run.mcap.zstd",
        "none.bag", "bz2.bag", "lz4.bag", "called.mcap", "a %20#.db3"}) {
    for (const char* kind : {"mcap:", "bag:"}) {
      const auto source = makeSource(kind + path(name) + kImages);
      EXPECT_EQ(asText(readAll(*source)), expected) << name;
      const auto robot = [](const std::string& toml) { return toml.substr(toml.find("[[sensor")); };
      EXPECT_EQ(robot(source->robotToml()), robot(twin->robotToml())) << name;
      EXPECT_EQ(source->remark(), twin->remark()) << name;
    }
  }
}

TEST_F(BagFiles, OldNamesOfTopicsFramesAndTransformsAreThoseOfNow) {
  Ros1Maker maker;
  maker.add("odom", "nav_msgs/Odometry", toRos1(odometryAt(kSecond, 0.0, 0.0)))
      .add("tf", "tf/tfMessage", toRos1(frameAt("/base_footprint", "/laser", {{0.25, 0, 0}, {}})))
      .add("scan", "sensor_msgs/LaserScan", toRos1(scanOf(kSecond, "/laser", {1.0F, 2.0F, 3.0F})));
  const auto source = makeSource("mcap:" + folder_.write("old.bag", maker.bag()).string() +
                                 "?scans=/scan&odometry=/odom");
  EXPECT_EQ(readAll(*source).size(), 2u);
  EXPECT_NE(source->robotToml().find("pose = { x_m = 0.25,"), std::string::npos);
  EXPECT_EQ(source->remark(), "");
}

TEST_F(BagFiles, OfAFolderAreReadInTheOrderOfItsMetadata) {
  for (const int number : {0, 1}) {
    Db3Maker maker(path("bag_" + std::to_string(number) + ".db3"));
    maker.tables().add("/odom", Odometry::kType, toCdr(odometryAt(number * kSecond, number, 0.0)));
    maker.finish();
  }
  folder_.write("other.db3", "not of the bag");
  const auto listed = [&](const std::string& files, const std::string& more = "") {
    folder_.write("metadata.yaml", "rosbag2_bagfile_information:\n  version: 5\n" + more +
                                       "  relative_file_paths:\n" + files);
    return makeSource("mcap:" + folder_.path().string());
  };
  EXPECT_EQ(readAll(*listed("    - bag_0.db3\n    - bag_1.db3\n")).size(), 2u);
  EXPECT_EQ(listed("    - bag_0.db3\n    - bag_1.db3\n")->remark(), "");
  EXPECT_NE(listed("    - there/bag_1.db3\n    - bag_0.db3.zstd\n")->remark().find("earlier times"),
            std::string::npos);
  EXPECT_NE(errorOf([&] {
              listed("    - bag_0.db3\n", "  compression_format: lzma\n");
            }).find("metadata.yaml: found files compressed by 'lzma', expected zstd or nothing"),
            std::string::npos);
  std::filesystem::remove(path("other.db3"));
  const auto source = listed("    - gone.db3\n");
  EXPECT_EQ(readAll(*source).size(), 2u);
  EXPECT_NE(source->remark().find("names 'gone.db3', which is not there"), std::string::npos);
}

TEST_F(BagFiles, WithAJournalBesideThemAreUnfinishedAndStayAsTheyAre) {
  writeDb3("run.db3");
  folder_.write("run.db3-wal", "what a recorder had not yet put into the file");
  const auto before = readBytes(path("run.db3"));
  EXPECT_NE(makeSource("mcap:" + path("run.db3"))->remark().find("run.db3 is unfinished"),
            std::string::npos);
  EXPECT_EQ(readBytes(path("run.db3")), before);
  EXPECT_EQ(readBytes(path("run.db3-wal")).substr(0, 4), "what");
}

TEST_F(BagFiles, ThatLetOthersComputeAreRefused) {
  const std::string topics =
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format "
      "TEXT);"
      "INSERT INTO topics VALUES (1, '/odom', 'nav_msgs/msg/Odometry', 'cdr');";
  const auto error = [&](const std::string& sql) {
    Db3Maker(path("run.db3")).run(topics + sql);
    return errorOf("mcap:" + path("run.db3"));
  };
  EXPECT_NE(error("CREATE VIEW messages AS WITH RECURSIVE x(n) AS (SELECT 1 UNION ALL SELECT n + 1 "
                  "FROM x) SELECT 1 AS topic_id, n AS timestamp, x'' AS data FROM x;")
                .find("run.db3: found no tables topics and messages, expected those of rosbag2"),
            std::string::npos);
  EXPECT_NE(error("CREATE TABLE messages(topic_id, timestamp, data AS (zeroblob(100000000)));"
                  "INSERT INTO messages VALUES (1, 1);")
                .find("found more messages than the file has bytes at message 1"),
            std::string::npos);
  EXPECT_NE(error("CREATE TABLE messages(topic_id, timestamp);").find("no such column: data"),
            std::string::npos);
  const std::string table = "CREATE TABLE messages(topic_id, timestamp, data);";
  EXPECT_NE(error(table + "INSERT INTO messages VALUES (7, 1, x'00');")
                .find("found a message of topic 7 at message 1, expected a topic of the table"),
            std::string::npos);
  EXPECT_NE(error(table + "INSERT INTO messages VALUES (1, -5, x'00');").find("a time of -5 ns"),
            std::string::npos);
  EXPECT_NE(error(table + "INSERT INTO messages VALUES (1, 1, 'text');").find("no bytes"),
            std::string::npos);
}

TEST_F(BagFiles, WithSizesThatAreNotTrueAreRefused) {
  const std::string head = "#ROSBAG V2.0\n" + Ros1Maker::bagHeader();
  const auto chunk = [&](const char* compression, std::size_t size, const std::string& packed) {
    return errorOfBytes(head + Ros1Maker::chunkOf(compression, size, packed));
  };
  const std::string zeros(1 << 20, '\0');
  EXPECT_NE(chunk("bz2", 1000, packedBz2(zeros)).find("a chunk that holds more than it says"),
            std::string::npos);
  EXPECT_NE(chunk("lz4", 1000, packLz4(zeros)).find("a chunk that holds more than it says"),
            std::string::npos);
  EXPECT_NE(chunk("none", 1000, "abc").find("a chunk of 3 bytes at byte"), std::string::npos);
  EXPECT_NE(chunk("none", 1U << 31, "abc").find("a chunk of 2147483648 bytes at byte"),
            std::string::npos);
  EXPECT_NE(chunk("bz2", 1 << 20, packedBz2(zeros).substr(0, 30)).find("it is cut off"),
            std::string::npos);
  EXPECT_NE(chunk("xz", 3, "abc").find("compressed with 'xz'"), std::string::npos);
  EXPECT_NE(errorOfBytes("#ROSBAG V1.2\n").find("found a bag of ROS 1 of another version"),
            std::string::npos);
  EXPECT_NE(errorOfBytes(head + std::string(8, '\0')).find("a sound field 'op'"),
            std::string::npos);
  EXPECT_NE(errorOfBytes(packZstd("nothing")).find("found another beginning at byte 0"),
            std::string::npos);
  EXPECT_NE(errorOfBytes(packZstd(zeros).substr(0, 20)).find("zstd that is damaged"),
            std::string::npos);
  const std::string inner = Ros1Maker::chunkOf("none", 0, "");
  EXPECT_NE(chunk("none", inner.size(), inner).find("a chunk within a chunk"), std::string::npos);
}

TEST_F(BagFiles, OfManyChunksOfNothingDoNotTakeForEver) {
  const std::string zeros(std::size_t{1} << 27, '\0');  // as much as a chunk may have
  const std::string empty = Ros1Maker::record({{"op", "x"}}, std::string_view(zeros).substr(64));
  const std::string one = Ros1Maker::chunkOf("bz2", empty.size(), packedBz2(empty));
  std::string bag = "#ROSBAG V2.0\n" + Ros1Maker::bagHeader();
  for (int i = 0; i < 20; ++i) bag += one;
  EXPECT_NE(errorOfBytes(bag).find("chunks that unpack to much more than the file has"),
            std::string::npos);
}

TEST_F(BagFiles, ThatAreDamagedAreReadOrRefused) {
  writeDb3("run.db3");
  for (const std::string& whole : {readBytes(path("run.db3")), ros1().bag()}) {
    std::mt19937 random(1);
    int read = 0;
    for (int i = 0; i < 300; ++i) {
      const std::string text =
          "mcap:" + folder_.write("changed", mutated(whole, random)).string() + kImages;
      try {
        const auto source = makeSource(text);
        for (const Message& message : readAll(*source)) EXPECT_FALSE(message.words.empty());
        ++read;
      } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("changed"), std::string::npos) << error.what();
      }
    }
    EXPECT_GT(read, 0);
    EXPECT_LT(read, 300);
  }
}

template <class M>
void expectSame(const M& message) {
  std::string why;
  const std::string bytes = toRos1(message);
  const auto read = fromRos1<M>(bytes, why);
  RC_ASSERT(read.has_value() && why.empty());
  RC_ASSERT(toCdr(*read) == toCdr(message));
  RC_ASSERT(!fromRos1<M>(std::string_view(bytes).substr(0, bytes.size() - 1), why));
  RC_ASSERT(why.starts_with("found "));
}

RC_GTEST_PROP(Ros1Messages, AreWhatRos2HasInItsOwnEncoding, (const std::vector<float>& numbers)) {
  const auto text = *rc::gen::container<std::string>(rc::gen::inRange('a', 'z'));
  const auto stamp = *rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 60);
  LaserScan scan = scanOf(stamp, text, numbers);
  scan.intensities = numbers;
  expectSame(scan);
  expectSame(odometryAt(stamp, static_cast<double>(numbers.size()), 0.5));
  expectSame(TfMessage{{{{stamp, text}, text + "x", {}}, {{stamp, "a"}, text, {}}}});
  Image image;
  image.encoding = text;
  image.data = *rc::gen::arbitrary<std::vector<std::uint8_t>>();
  expectSame(image);
  OccupancyGrid map;
  map.header = {stamp, text};
  map.data = *rc::gen::arbitrary<std::vector<std::int8_t>>();
  expectSame(map);
  PoseWithCovarianceStamped pose;
  pose.header = {stamp, text};
  pose.covariance[35] = 2.0;
  expectSame(pose);
}

template <class M>
void expectReadOrRefused(const std::string& bytes) {
  std::string why;
  const bool isRead = fromRos1<M>(bytes, why).has_value();
  RC_ASSERT(isRead == why.empty());
}

RC_GTEST_PROP(Ros1Messages, OfRandomBytesAreReadOrRefused, (const std::string& bytes)) {
  expectReadOrRefused<LaserScan>(bytes);
  expectReadOrRefused<TfMessage>(bytes);
  expectReadOrRefused<Words>(bytes);
}

}  // namespace
}  // namespace ortung
