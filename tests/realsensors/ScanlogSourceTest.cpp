#include <cmath>
#include <fstream>

#include "LogTesting.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

using namespace ortung::testing;
using Texts = std::vector<std::string>;

const std::string kHead =
    "# t odom n r; ANGLES -1.5 0.5 ; sensor at x=0.780 y=-0.100 yaw=0.500, max range 80.0\n";
const std::string kScans = kHead + "1.0 0.0 0.0 0.0 3 1.25 0 81.91\n2.0 0.5 0.0 0.1 3 1.5 2 -1\n";

class ScanlogSource : public ::testing::Test {
 protected:
  ScanlogSource() { folder_.write("scans.txt", kScans); }
  std::string text(const std::string& options = "") const { return "scanlog:" + path() + options; }
  std::string path() const { return folder_.path().string(); }
  TemporaryFolder folder_;
};

TEST_F(ScanlogSource, GivesScansWithTheirOdometryAndReference) {
  folder_.write("gt.txt", "# t x y theta\n1.0 4.0 -5.0 3.0\n2.0 4.5 -5.0 3.1 0.99\n");
  EXPECT_EQ(
      asText(readAll(text())),
      (Texts{"1000000 odometry/odometry/pose 2147483648 2147483648 18000 2147483648 2147483648",
             "1000000 laser/LRF/scan 1250 0 81910",
             "1000000 reference/groundTruth/pose 2147487648 2147478648 35189",
             "2000000 odometry/odometry/pose 2147484148 2147483648 18573 2147484148 2147484221",
             "2000000 laser/LRF/scan 1500 2000 0",
             "2000000 reference/groundTruth/pose 2147488148 2147478648 35762"}));
}

// 0.2 m/s and 0.5 rad/s = 2865 hundredths of a degree a second, from 1.5 s on; nothing before.
TEST_F(ScanlogSource, AddsCommandsToOdometryAsMotionData) {
  folder_.write("cmd_vel.txt", "# t v w\n1.5 0.2 0.5\n2.5 9 9\n");
  const Texts lines = asText(readAll(text("?commands=cmd_vel.txt")));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0],
            "1000000 odometry/odometry/pose 2147483648 2147483648 18000 2147483648 2147483648 "
            "2147483648 2147483648");
  EXPECT_TRUE(lines[2].ends_with(" 2147483848 2147486513")) << lines[2];
  folder_.write("at_once.txt", "1.0 0.2 0.5\n2.0 0.3 0\n");  // a command counts from its time on
  const Texts atOnce = asText(readAll(text("?commands=at_once.txt")));
  ASSERT_EQ(atOnce.size(), 4U);
  EXPECT_TRUE(atOnce[0].ends_with(" 2147483848 2147486513")) << atOnce[0];
  EXPECT_TRUE(atOnce[2].ends_with(" 2147483948 2147483648")) << atOnce[2];
  folder_.write("bad.txt", "1.5 0.2\n");
  EXPECT_THROW(readAll(text("?commands=bad.txt")), std::runtime_error);
  EXPECT_THROW(readAll(text("?commands=missing.txt")), std::runtime_error);
}

TEST_F(ScanlogSource, AddsReflectorsThatNobodyTellsApart) {
  folder_.write("refl.txt",
                "# t range bearing, sensor at +0.25 m\n1.5 2.5 0.5\n1.5 3 -0.5\n2 7.2 0\n");
  folder_.write("places.txt", "# id x y\n3 1.5 -2\n8 0 4.25\n");
  const std::string with = text("?reflectors=refl.txt&reflector_map=places.txt");
  EXPECT_EQ(asText(only(readAll(with), "laser/landmarks/reflectors")),
            (Texts{"1500000 laser/landmarks/reflectors 4294967295 2500 20865 4294967295 3000 15135",
                   "2000000 laser/landmarks/reflectors 4294967295 7200 18000"}));
  const std::string toml = makeSource(with)->robotToml();
  EXPECT_NE(toml.find("identified = false\nkind = \"reflector\"\nidentities = [3, 8]\n"
                      "pose = { x_m = 0.25, z_m = 2.0 }\nmax_range_m = 8.0\n"),
            toml.npos)
      << toml;
  EXPECT_NE(errorOf(text("?reflectors=refl.txt")).find("reflector_map"), std::string::npos);
  folder_.write("refl.txt", "1.5 2.5 0.5\n1.25 3 0\n");
  EXPECT_NE(errorOf(with).find("refl.txt:2: found a time before"), std::string::npos);
  folder_.write("refl.txt", "1.5 -2.5 0.5\n");
  EXPECT_NE(errorOf(with).find("refl.txt:1"), std::string::npos);
}

TEST_F(ScanlogSource, ReadsTheScannerFromTheCommentAboveTheScans) {
  const std::string toml = makeSource(text())->robotToml();
  EXPECT_NE(
      toml.find("pose = { x_m = 0.78, y_m = -0.1, theta_deg = 28.64789 }\nbeams = 3\n"
                "first_angle_deg = -85.943669\nangle_step_deg = 28.64789\nmax_range_m = 30.0\n"
                "period_s = 1.0\n"),
      std::string::npos)
      << toml;
}

TEST_F(ScanlogSource, ReadsTheOtherWayToWriteAngles) {
  folder_.write("scans.txt",
                "# beam k (0-based) at angle -pi/2 + k*0.5 rad, counter-clockwise\n1 0 0 0 1 5\n");
  const std::string toml = makeSource(text())->robotToml();
  EXPECT_NE(
      toml.find("x_m = 0.0, y_m = 0.0, theta_deg = 0.0 }\nbeams = 1\nfirst_angle_deg = -90.0\n"
                "angle_step_deg = 28.64789\n"),
      std::string::npos)
      << toml;
}

TEST_F(ScanlogSource, LetsOptionsSayWhereTheScannerIs) {
  const std::string toml =
      makeSource(text("?laser_x=-0.1&laser_y=0.2&laser_yaw_deg=180&max_range_m=50"))->robotToml();
  EXPECT_NE(toml.find("x_m = -0.1, y_m = 0.2, theta_deg = 180.0 }"), std::string::npos) << toml;
  EXPECT_NE(toml.find("max_range_m = 50.0"), std::string::npos) << toml;
}

TEST_F(ScanlogSource, PrefersAReferenceThatSomebodyAddedToTheTruth) {
  folder_.write("gt.txt", "1.0 1 0 0\n");
  folder_.write("ref.txt.gz", compressedGz("1.0 2 0 0\n"));
  const std::string id = "reference/groundTruth/pose";
  EXPECT_EQ(only(readAll(text()), id).at(0).words[0], words::fromSignedMetres(2.0));
  EXPECT_EQ(only(readAll(text("?gt=gt.txt")), id).at(0).words[0], words::fromSignedMetres(1.0));
  EXPECT_TRUE(only(readAll(text("?gt=none")), id).empty());
}

TEST_F(ScanlogSource, UsesAFileOfOdometryInPlaceOfTheScansOwn) {
  folder_.write("odom.txt", "0.5 0 0 0\n1.5 0.25 0 0\n");
  EXPECT_EQ(
      asText(only(readAll(text("?odom=odom.txt")), "odometry/odometry/pose")),
      (Texts{"500000 odometry/odometry/pose 2147483648 2147483648 18000 2147483648 2147483648",
             "1500000 odometry/odometry/pose 2147483898 2147483648 18000 2147483898 2147483648"}));
}

TEST_F(ScanlogSource, ALineOfOdometryHasFourNumbers) {
  for (const auto& [line, count] : {std::pair{"0.5 0 0", "3"}, std::pair{"0.5 0 0 0 1", "5"}}) {
    folder_.write("odom.txt", std::string("0.1 0 0 0\n") + line + "\n");
    EXPECT_EQ(errorOf(text("?odom=odom.txt")),
              path() + "/odom.txt:2: found " + count +
                  " fields, expected 4: time [s], x [m], y [m], theta [rad]");
  }
}

TEST_F(ScanlogSource, PutsUpWithAJitteringClock) {
  folder_.write("scans.txt",
                kHead + "1 0 0 0 3 1 1 1\n2 0 0 0 3 1 1 1\n1.5 0 0 0 3 2 2 2\n2.5 0 0 0 3 3 3 3\n");
  EXPECT_EQ(
      asText(only(readAll(text()), "laser/LRF/scan")),
      (Texts{"1000000 laser/LRF/scan 1000 1000 1000", "2000000 laser/LRF/scan 1000 1000 1000",
             "2000001 laser/LRF/scan 2000 2000 2000", "2500000 laser/LRF/scan 3000 3000 3000"}));
  EXPECT_EQ(
      errorOf(text("?jitter_s=0.1")),
      path() +
          "/scans.txt:4: found time 1.5 s after 2 s, expected time to run forwards, or back by at"
          " most jitter_s=0.1 s");
}

TEST_F(ScanlogSource, GoesByTheOrderOfLinesWhereStampsStandStill) {
  folder_.write("scans.txt", kHead + "7 0 0 0 3 1 1 1\n7 1 0 0 3 2 2 2\n7 2 0 0 3 3 3 3\n");
  folder_.write("gt.txt", "7 1 0 0\n7 2 0 0\n7 3 0 0\n");
  const auto stampsOf = [&](const std::string& options, const std::string& id) {
    std::vector<Timestamp> stamps;
    for (const Message& message : only(readAll(text(options)), id)) stamps.push_back(message.stamp);
    return stamps;
  };
  for (const char* id :
       {"laser/LRF/scan", "odometry/odometry/pose", "reference/groundTruth/pose"}) {
    EXPECT_EQ(stampsOf("", id), (std::vector<Timestamp>{7000000, 8000000, 9000000})) << id;
    EXPECT_EQ(stampsOf("?period_s=0.2", id), (std::vector<Timestamp>{7000000, 7200000, 7400000}))
        << id;
  }
  folder_.write("gt.txt", "7 1 0 0\n7 2 0 0\n");
  EXPECT_EQ(errorOf(text()),
            path() +
                ": found 2 reference poses for 3 scans, expected one a scan, since the"
                " stamps of the scans are not used (they do not change, or the option"
                " period_s is set)");
}

TEST_F(ScanlogSource, NamesFileAndLineOfWhatIsWrong) {
  const auto with = [&](const std::string& bytes) {
    folder_.write("scans.txt", bytes);
    return errorOf(text());
  };
  const std::string file = path() + "/scans.txt";
  EXPECT_EQ(with(kHead), path() + ": found no scan, expected at least one");
  EXPECT_EQ(with("1 0 0 0 1 5\n"),
            file +
                ":1: found no angles of the beams in the comments above, expected"
                " 'ANGLES FIRST STEP' or 'at angle -pi/2 + k*STEP' [rad]");
  EXPECT_EQ(with("# ANGLES 0\n1 0 0 0 1 5\n"),
            file +
                ":2: found no two numbers behind 'ANGLES' in the"
                " comment above, expected first angle and step [rad]");
  EXPECT_EQ(
      with("# ANGLES 0 3\n1 0 0 0 3 5 5 5\n"),
      file +
          ":2: found 3 beams that begin at 0.0 rad, 3.0 rad apart, expected a positive step, and a"
          " turn at most");
  EXPECT_EQ(with(kHead + "1 0 0 0 3 5 5\n"),
            file + ":2: found 7 fields, expected 8: time, odometry, n, n ranges");
  EXPECT_EQ(with(kHead + "1 0 0 0 3 5 5 5\n2 0 0 0 2 5 5\n"),
            file + ":3: found 2 beams, expected 3 as above");
  EXPECT_EQ(
      with(kHead + "1 0 0 0 3 5 inf 5\n"),
      file + ":2: found 'inf' in field 7, expected a range [m], a number in [-1000000, 1000000]");
  EXPECT_EQ(
      with(kHead + "1 0 0 0 3000000000 5\n"),
      file +
          ":2: found '3000000000' in field 5, expected a number of beams, a number in [1, 8192]");
  std::filesystem::remove(file);
  EXPECT_EQ(
      errorOf(text()),
      file + ": found no such file, nor one with .xz or .gz behind its name, expected one of them");
}

TEST_F(ScanlogSource, WritesAWorldWithACopyOfItsMap) {
  folder_.write("log/scans.txt", kScans);
  folder_.write("some_map.yaml", "image: pictures/m.pgm\nresolution: 0.05\norigin: [-1, -2, 0]\n");
  folder_.write("pictures/m.pgm.gz", compressedGz("P5\n2 1\n255\nab"));
  folder_.write("out/keep", "");
  const auto source = makeSource("scanlog:" + path() + "/log");  // the map lies one folder above
  source->writeWorld(folder_.path() / "out/hall.toml");
  EXPECT_EQ(readBytes(folder_.path() / "out/hall.toml"),
            "[world]\nname = \"hall\"\n\n[[grid]]\nmap = \"hall.yaml\"\nsurface_depth_cells = "
            "0.5\nmap_error_m = 0.02\n");
  EXPECT_EQ(readBytes(folder_.path() / "out/hall.yaml"),
            "image: hall.pgm\nresolution: 0.05\norigin: [-1, -2, 0]\n");
  EXPECT_EQ(readBytes(folder_.path() / "out/hall.pgm"), "P5\n2 1\n255\nab");
}

TEST_F(ScanlogSource, TakesTheNearestMap) {
  folder_.write("map.yaml", "image: far.pgm\nresolution: 1\norigin: [0, 0, 0]\n");
  folder_.write("far.pgm", "P5\n1 1\n255\nf");
  folder_.write("hall/near.yaml", "image: near.pgm\nresolution: 1\norigin: [0, 0, 0]\n");
  folder_.write("hall/near.pgm", "P5\n1 1\n255\nn");
  folder_.write("hall/log/scans.txt", kScans);
  makeSource("scanlog:" + path() + "/hall/log")->writeWorld(folder_.path() / "w.toml");
  EXPECT_EQ(readBytes(folder_.path() / "w.pgm"), "P5\n1 1\n255\nn");
}

TEST_F(ScanlogSource, SaysWhatIsWrongWithAMap) {
  const auto world = folder_.path() / "w.toml";
  const auto errorWith = [&](const std::string& options) {
    const auto source = makeSource(text(options));
    return errorOf([&] { source->writeWorld(world); });
  };
  EXPECT_EQ(errorWith(""), path() + ": found no map, expected one; the option map=FILE names it");
  folder_.write("a.yaml", "image: b.pgm\n");
  EXPECT_EQ(errorWith(""), path() + "/a.yaml: found no image 'b.pgm' beside it, expected one");
  folder_.write("b.pgm", "GIF89a");
  EXPECT_EQ(errorWith(""), path() + "/b.pgm: found no PGM, PPM or PNG image, expected one");
  folder_.write("c.yaml", "resolution: 1\n");
  EXPECT_EQ(errorWith("?map=c.yaml"), path() + "/c.yaml: found no line 'image: ...', expected one");
  EXPECT_NE(errorOf(text("?map=d.yaml")).find("map found no file 'd.yaml' in " + path()),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(world));
}

struct KnownLog {
  const char* name;
  std::size_t scans, truth;
  double duration;  ///< [s]
};

TEST(ScanlogData, HasAllReadingsOfTheRealLogs) {
  for (const auto& [name, scans, truth, duration] :
       {KnownLog{"carmen/intel", 910, 910, 2650.86}, KnownLog{"carmen/aces", 440, 440, 1318.06},
        KnownLog{"carmen/freiburg-101", 292, 292, 918.935},
        KnownLog{"carmen/belgioioso", 395, 395, 394.0},
        KnownLog{"crob_lab_jarvis/complex_path_fast/security", 618, 618, 73.8219},
        KnownLog{"crob_lab_jarvis/complex_path_fast/nav350", 590, 590, 73.7512},
        KnownLog{"mrpt_localization_demo", 37, 37, 9.28335},
        KnownLog{"mrpt_sena_telecom", 225, 225, 59.0749},
        KnownLog{"mrpt_uwb_ro", 342, 342, 362.081}}) {
    ORTUNG_NEED_DATA(data, name);
    const auto messages = readAll("scanlog:" + data.string());
    EXPECT_EQ(only(messages, "laser/LRF/scan").size(), scans) << name;
    EXPECT_EQ(only(messages, "odometry/odometry/pose").size(), scans) << name;
    EXPECT_EQ(only(messages, "reference/groundTruth/pose").size(), truth) << name;
    EXPECT_NEAR(toSeconds(messages.back().stamp - messages.front().stamp), duration, 0.01) << name;
  }
}

/// A PGM with the place of its cells, as map_server has it.
struct Map {
  std::string pixels;
  int width = 0;
  int height = 0;
  double resolution = 0.0;
  double x = 0.0;
  double y = 0.0;

  explicit Map(const std::filesystem::path& yaml) {
    std::ifstream text(yaml);
    for (std::string line; std::getline(text, line);) {
      std::sscanf(line.c_str(), "resolution: %lf", &resolution);
      std::sscanf(line.c_str(), "origin: [%lf, %lf", &x, &y);
    }
    auto image = yaml;
    pixels = readBytes(image.replace_extension(".pgm"));
    std::sscanf(pixels.c_str(), "P5 %d %d", &width, &height);
    pixels = pixels.substr(pixels.size() -
                           static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }
  /// 0 occupied, 254 free, 205 unknown, -1 outside
  int at(double px, double py) const {
    const int column = static_cast<int>(std::floor((px - x) / resolution));
    const int row = height - 1 - static_cast<int>(std::floor((py - y) / resolution));
    if (column < 0 || row < 0 || column >= width || row >= height) return -1;
    return static_cast<unsigned char>(
        pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(column)]);
  }
};

TEST(ScanlogData, KeepsTheRobotInTheFreeSpaceOfTheWrittenWorld) {
  const TemporaryFolder folder;
  for (const char* name : {"carmen/intel", "carmen/aces", "carmen/belgioioso",
                           "carmen/freiburg-101", "crob_lab_jarvis/complex_path_fast/security",
                           "mrpt_localization_demo", "mrpt_sena_telecom", "mrpt_uwb_ro"}) {
    ORTUNG_NEED_DATA(data, name);
    const auto source = makeSource("scanlog:" + data.string());
    source->writeWorld(folder.path() / "w.toml");
    const Map map(folder.path() / "w.yaml");
    PoseData truth({"reference", "groundTruth", "pose"});
    std::size_t all = 0, inside = 0, occupied = 0;
    for (const Message& message : only(readAll(*source), "reference/groundTruth/pose")) {
      truth.setData(message.stamp, message.words);
      const int pixel = map.at(truth.reading().x, truth.reading().y);
      ++all;
      inside += pixel >= 0;
      occupied += pixel == 0;
    }
    std::printf("%s: %zu poses, %zu inside, %zu on occupied cells\n", name, all, inside, occupied);
    EXPECT_EQ(inside, all) << name;
    EXPECT_LE(occupied, all / 50) << name;  // the maps are made of scans, people and noise included
  }
}

TEST(ScanlogData, HitsTheWallsOfTheWrittenWorldWithItsBeams) {
  const TemporaryFolder folder;
  for (const char* name :
       {"carmen/intel", "carmen/freiburg-101", "crob_lab_jarvis/complex_path_fast/security",
        "mrpt_localization_demo", "mrpt_sena_telecom", "mrpt_uwb_ro"}) {
    ORTUNG_NEED_DATA(data, name);
    const auto source = makeSource("scanlog:" + data.string());
    source->writeWorld(folder.path() / "w.toml");
    const Map map(folder.path() / "w.yaml");
    const std::string toml = source->robotToml();
    const auto value = [&](const std::string& key) {
      return std::stod(toml.substr(toml.find(key + " = ") + key.size() + 3));
    };
    const Pose2 mount{value("x_m"), value("y_m"), value("theta_deg") * M_PI / 180};
    std::size_t all = 0, near = 0;
    std::vector<std::uint32_t> scan;
    for (const Message& message : readAll(*source)) {
      if (message.id.type == "LRF") scan = message.words;
      if (message.id.type != "groundTruth" || scan.empty()) continue;
      PoseData truth(message.id);
      truth.setData(message.stamp, message.words);
      const Pose2 laser = truth.reading() * mount;
      for (std::size_t k = 0; k < scan.size(); k += 7) {
        const double range = words::toMetres(scan[k]);
        if (range < 0.3 || range > 15) continue;
        const double angle = laser.theta + (value("first_angle_deg") +
                                            value("angle_step_deg") * static_cast<double>(k)) *
                                               M_PI / 180;
        bool hit = false;
        for (int dx = -2; dx <= 2; ++dx) {
          for (int dy = -2; dy <= 2; ++dy) {
            hit |= map.at(laser.x + range * std::cos(angle) + dx * map.resolution,
                          laser.y + range * std::sin(angle) + dy * map.resolution) < 89;  // 0.65
          }
        }
        ++all;
        near += hit;
      }
    }
    const double share = static_cast<double>(near) / static_cast<double>(all);
    std::printf("%s: %zu beams, %.3f end within two cells of an occupied one\n", name, all, share);
    EXPECT_GT(share, 0.8) << name;  // a wrong angle, mount or order of beams leaves a third
  }
}

}  // namespace
}  // namespace ortung
