#include <cstdlib>

#include "LogTesting.hpp"
#include "ortung/base/HelperProgram.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using Texts = std::vector<std::string>;

/// Stands in for ortung-mrpt-reader: a script that prints what the test wants.
class RawlogSource : public ::testing::Test {
 protected:
  RawlogSource() { ::setenv("ORTUNG_LIBEXEC", folder_.path().c_str(), 1); }
  ~RawlogSource() override { ::unsetenv("ORTUNG_LIBEXEC"); }
  std::string text(const std::string& script) const {
    const auto program = folder_.write("ortung-mrpt-reader", "#!/bin/sh\n" + script);
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return "rawlog:" + folder_.write("a.rawlog", "").string();
  }
  std::string printing(const std::string& lines) const {
    return text("cat <<'END'\n" + lines + "END\n");
  }
  std::string path() const { return (folder_.path() / "a.rawlog").string(); }
  TemporaryFolder folder_;
};

const std::string kScanner = "# scanner 0.78 0 0 -1.5 1.5 80 3\n";

TEST_F(RawlogSource, TakesTheReadersLines) {
  const auto source =
      makeSource(printing("# ortung-mrpt-reader 1\n" + kScanner +
                          "2000000 laser/LRF/scan 3 1 2 3\n"
                          "1000000 odometry/odometry/pose 5 1 2 3 4 5\n"
                          "# beacons 0.16 0 0 300\n"
                          "2000000 uwb/landmarks/beacon4Distance 1 5000\n# end 3\n"));
  EXPECT_EQ(asText(readAll(*source)),
            (Texts{"1000000 odometry/odometry/pose 1 2 3 4 5", "2000000 laser/LRF/scan 1 2 3",
                   "2000000 uwb/landmarks/beacon4Distance 5000"}));
  const std::string toml = source->robotToml();
  EXPECT_NE(toml.find("plugin = \"lrf\""), std::string::npos);
  EXPECT_NE(toml.find("kind = \"beacon\"\nidentities = [4]\npose = { x_m = 0.16"),
            std::string::npos)
      << toml;
}

TEST_F(RawlogSource, AScannerMayBeShortSightedOrNotSayHowFarItSees) {
  const auto robotWith = [&](const std::string& range) {
    return makeSource(printing("# scanner 0 0 0 -1.5 1.5 " + range +
                               " 3\n1 laser/LRF/scan 3 1 2 3\n# end 1\n"))
        ->robotToml();
  };
  EXPECT_NE(robotWith("0.5").find("max_range_m = 0.5\n"), std::string::npos) << robotWith("0.5");
  EXPECT_NE(robotWith("0").find("max_range_m = 30.0\n"), std::string::npos) << robotWith("0");
}

TEST_F(RawlogSource, TakesTheReaderForHostile) {
  const std::string where = " of what ortung-mrpt-reader prints, expected ";
  EXPECT_EQ(errorOf(printing("")),
            path() + ": found its end in line 0" + where + "a last line '# end COUNT'");
  EXPECT_EQ(errorOf(printing(kScanner + "1 laser/LRF/scan 3 1 2 3\n")),
            path() + ": found its end in line 2" + where + "a last line '# end COUNT'");
  EXPECT_EQ(errorOf(printing(kScanner + "1 laser/LRF/scan 3 1 2 3\n# end 2\n")),
            path() + ": found 1 readings before '# end 2' in line 3" + where + "as many");
  EXPECT_EQ(errorOf(printing(kScanner + "1 laser/LRF/scan 2 1 2\n# end 1\n")),
            path() + ": found 2 words of laser/LRF/scan in line 2" + where + "3");
  EXPECT_EQ(errorOf(printing("1 laser/LRF/scan 2 1 2\n# end 1\n")),
            path() + ": found a scan in line 1" + where + "a line '# scanner ...' before it");
  EXPECT_EQ(errorOf(printing("# scanner 0 0 0 nan 1 80 3\n")),
            path() + ": found 'nan' in line 1" + where + "a number");
  EXPECT_EQ(errorOf(printing("# scanner 0 0 0 0 1 80 99999\n")),
            path() + ": found 99999 beams, expected 1 to 8192");
  EXPECT_EQ(errorOf(printing("# scanner 0 0 0\n")),
            path() + ": found a comment of another length in line 1" + where + "7 numbers");
  const std::string junk = errorOf(printing("hello\n"));
  EXPECT_TRUE(
      junk.starts_with(path() + ": found 'hello' in line 1" + where + "a line of a record ("))
      << junk;
}

TEST_F(RawlogSource, NamesTheSignalThatEndedTheReader) {
  EXPECT_EQ(
      errorOf(text("kill -SEGV $$\n")),
      path() +
          ": ortung-mrpt-reader was ended by signal 11 (Segmentation fault); the file is damaged"
          " or too large");
  EXPECT_EQ(errorOf(text("kill -XCPU $$\n")),
            path() +
                ": ortung-mrpt-reader was ended by signal 24 (CPU time limit exceeded); the file is"
                " damaged or too large");
  EXPECT_EQ(errorOf(text("echo '# error torn object'; exit 1\n")),
            path() + ": ortung-mrpt-reader ended with status 1: torn object");
}

TEST_F(RawlogSource, NamesTheFileThatIsNotThere) {
  EXPECT_EQ(errorOf("rawlog:/nowhere/a.rawlog"),
            "/nowhere/a.rawlog: found no such file, expected a rawlog");
}

/// Whether the reader was built; the tests lie beside it.
bool hasReader() {
  return errorOf([] { findHelper("ortung-mrpt-reader", ""); }).empty();
}

#define ORTUNG_NEED_READER() \
  if (!hasReader()) GTEST_SKIP() << "ortung-mrpt-reader was not built (ORTUNG_MRPT)"

void expectSameScansAndNearOdometry(const std::vector<Message>& rawlog,
                                    const std::vector<Message>& text) {
  const auto scans = only(text, "laser/LRF/scan");
  ASSERT_EQ(only(rawlog, "laser/LRF/scan").size(), scans.size());
  const auto rawScans = only(rawlog, "laser/LRF/scan");
  for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_EQ(rawScans[i].words, scans[i].words) << i;
  const auto raw = only(rawlog, "odometry/odometry/pose");
  const auto odometry = only(text, "odometry/odometry/pose");
  ASSERT_EQ(raw.size(), odometry.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    EXPECT_LE(std::abs(raw[i].stamp - odometry[i].stamp), 1);  // the text cut off digits
    for (std::size_t k = 0; k < 3; ++k) {                      // and has five of each length
      EXPECT_LE(std::abs(static_cast<std::int64_t>(raw[i].words[k]) -
                         static_cast<std::int64_t>(odometry[i].words[k])),
                1)
          << i << " word " << k;
    }
  }
}

TEST(RawlogData, IsTheSameAsItsNeutralText) {
  ORTUNG_NEED_READER();
  ORTUNG_NEED_DATA(demo, "mrpt_localization_demo");
  expectSameScansAndNearOdometry(
      readAll("rawlog:" + (demo / "raw/localization_demo.rawlog").string()),
      readAll("scanlog:" + demo.string()));
  ORTUNG_NEED_DATA(telecom, "mrpt_sena_telecom");
  expectSameScansAndNearOdometry(
      readAll("rawlog:" + (telecom / "raw/sena_telecom_one_loop.rawlog").string()),
      readAll("scanlog:" + telecom.string()));
}

TEST(RawlogData, GivesRangesOfBeaconsAndTheirRobotFile) {
  ORTUNG_NEED_READER();
  ORTUNG_NEED_DATA(data, "mrpt_uwb_ro");
  const auto source = makeSource(
      "rawlog:" + (data / "raw/uwb_ro-localization_demo.rawlog").string() +
      "?gt=../ref.txt&map=uwb_ro-localization_demo_map.gridmap.gz&beacons=../beacons.txt");
  const auto messages = readAll(*source);
  EXPECT_EQ(only(messages, "laser/LRF/scan").size(), 343u);
  EXPECT_EQ(only(messages, "reference/groundTruth/pose").size(), 342u);
  const auto ranges = only(messages, "uwb/landmarks/beacon2Distance");
  ASSERT_EQ(ranges.size(), 337u);  // 6 of the 1029 ranges are 0; 339 frames, 2 of them without
  EXPECT_EQ(ranges[0].stamp, 1178275990919835);
  EXPECT_EQ(ranges[0].words, std::vector<std::uint32_t>{6313});  // ranges.txt: 6.3133
  EXPECT_NE(source->robotToml().find("identities = [1, 2, 3]"), std::string::npos);
  const TemporaryFolder folder;
  source->writeWorld(folder.path() / "uwb.toml");
  const std::string head =
      "[world]\nname = \"uwb\"\n\n[[grid]]\nmap = \"uwb.gridmap.gz\"\nsurface_depth_cells = "
      "0.5\nmap_error_m = 0.02\n"
      "\n[[landmark]]\nkind = \"beacon\"\nidentity = 1\nposition_m = [-1.79, -4.55, 1.94]\n";
  EXPECT_EQ(readBytes(folder.path() / "uwb.toml").substr(0, head.size()), head);
  EXPECT_EQ(readBytes(folder.path() / "uwb.gridmap.gz"),
            readBytes(data / "raw/uwb_ro-localization_demo_map.gridmap.gz"));
}

TEST(RawlogData, KeepsAllFramesOfALogWithACoarseClock) {
  ORTUNG_NEED_READER();
  ORTUNG_NEED_DATA(data, "mrpt_slam_sim/raw");
  const auto messages = readAll("rawlog:" + (data / "kf-slam_demo.rawlog").string());
  EXPECT_EQ(only(messages, "camera/landmarks/posts").size(), 250u);
  EXPECT_EQ(only(messages, "odometry/odometry/pose").size(), 250u);
  EXPECT_EQ(only(readAll("rawlog:" + (data / "RO-SLAM_demo.rawlog").string()),
                 "uwb/landmarks/beacon8Distance")
                .size(),
            100u);
}

TEST(MrptReader, PrintsAGridMapFromItsBottomRow) {
  ORTUNG_NEED_READER();
  ORTUNG_NEED_DATA(data, "mrpt_uwb_ro/raw/uwb_ro-localization_demo_map.gridmap.gz");
  const std::string bytes =
      runHelper(findHelper("ortung-mrpt-reader", ""), {"gridmap", data.string()}, "grid", 1 << 22);
  const std::string header = "ortung-gridmap 700 650 0.0399999991 -10 -10\n";
  ASSERT_EQ(bytes.substr(0, header.size()), header);
  ASSERT_EQ(bytes.size(), header.size() + 700 * 650);
  // The robot starts at (0, 0), which is free; the corner of the grid is unknown.
  EXPECT_GT(static_cast<unsigned char>(bytes[header.size() + 250 * 700 + 250]), 200);
  EXPECT_NEAR(static_cast<unsigned char>(bytes[header.size()]), 127.5, 1.0);
}

TEST(MrptReader, RefusesWhatIsNoRawlog) {
  ORTUNG_NEED_READER();
  const TemporaryFolder folder;
  const auto path = folder.write("a.rawlog", "hello").string();
  const std::string error = errorOf("rawlog:" + path);
  EXPECT_TRUE(error.starts_with(path + ": ortung-mrpt-reader ended with status 1: ")) << error;
  EXPECT_NE(errorOf("rawlog:" + folder.write("empty.rawlog", "").string()), "");
}

}  // namespace
}  // namespace ortung
