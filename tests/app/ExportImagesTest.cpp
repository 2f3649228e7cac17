#include <gtest/gtest.h>
#include <png.h>
#include <stdlib.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "Golden.hpp"
#include "Paths.hpp"
#include "Program.hpp"

namespace ortung::test {
namespace {

namespace fs = std::filesystem;

/// A PNG's pixels as they are kept: bytes of colours or of a palette's numbers, or 16 bits.
struct Png {
  int width = 0, height = 0, channels = 0, bits = 0;
  std::vector<std::uint8_t> bytes;

  explicit Png(const fs::path& file) {
    FILE* in = std::fopen(file.c_str(), "rb");
    EXPECT_NE(in, nullptr) << file;
    if (in == nullptr) return;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, in);
    png_read_png(png, info, PNG_TRANSFORM_PACKING, nullptr);
    width = static_cast<int>(png_get_image_width(png, info));
    height = static_cast<int>(png_get_image_height(png, info));
    channels = png_get_channels(png, info);
    bits = png_get_bit_depth(png, info);
    const auto row = png_get_rowbytes(png, info);
    for (int v = 0; v < height; ++v) {
      const png_bytep from = png_get_rows(png, info)[v];
      bytes.insert(bytes.end(), from, from + row);
    }
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(in);
  }
};

constexpr const char* kRobot = R"([robot]
name = "eyes"
[[sensor]]
plugin = "camera"
model = "front"
pose = { x_m = 0.1, z_m = 0.6 }
[sensor.camera]
size_px = [160, 120]
focal_px = [105.0, 105.0]
tilt_deg = 15
[[sensor]]
plugin = "camera"
model = "mirror"
pose = { z_m = 0.75 }
[sensor.camera]
model = "unified"
size_px = [120, 120]
xi = 0.95
focal_px = [46.0, 46.0]
tilt_deg = 90
inner_px = 12
outer_px = 59
)";

class ExportImages : public ::testing::Test {
 protected:
  ExportImages() {
    std::string name = (fs::temp_directory_path() / "ortung-pictures-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    std::ofstream(folder_ / "robot.toml") << kRobot;
  }
  ~ExportImages() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path path(const std::string& name) const { return folder_ / name; }
  /// Of a robot that stands before the opponent's goal.
  Outcome exportTo(const std::string& out, std::vector<std::string> more = {},
                   const std::string& start = "7.5,1,-15") const {
    std::vector<std::string> arguments{
        "export",
        "images",
        "sim:" ORTUNG_SOURCE_DIR "/maps/fields/msl.toml?speed=0&duration=0.3&start=" + start,
        "--robot",
        path("robot.toml").string(),
        "--out",
        path(out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ortung(arguments);
  }

 private:
  fs::path folder_;
};

TEST_F(ExportImages, WritesPicturesWithWhatTheyShow) {
  const Outcome outcome = exportTo("set");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(": 8 pictures"), std::string::npos) << outcome.out;
  const YAML::Node images = YAML::LoadFile(path("set/annotations.yaml").string())["images"];
  ASSERT_EQ(images.size(), 8u);
  const YAML::Node first = images["000000.png"];
  EXPECT_EQ(first["width"].as<int>(), 160);
  EXPECT_EQ(first["height"].as<int>(), 120);
  EXPECT_EQ(first["metadata"]["imageset_id"].as<std::string>(), "front/camera/image");
  EXPECT_EQ(first["metadata"]["location"].as<std::string>(), "msl");
  const YAML::Node pose = first["metadata"]["camera_pose"];
  const double heading = -15.0 * std::acos(-1.0) / 180.0;
  EXPECT_NEAR(pose["position"]["x"].as<double>(), 7.5 + 0.1 * std::cos(heading), 1e-6);
  EXPECT_NEAR(pose["position"]["y"].as<double>(), 1.0 + 0.1 * std::sin(heading), 1e-6);
  EXPECT_DOUBLE_EQ(pose["position"]["z"].as<double>(), 0.6);
  int posts = 0, bars = 0;
  bool saysNoBall = false;
  for (const YAML::Node& one : first["annotations"]) {
    const auto type = one["type"].as<std::string>();
    if (type == "ball") saysNoBall = !one["in_image"].as<bool>();
    if (type == "goalpost") ++posts;
    if (type != "goalpost" && type != "top_bar") continue;
    if (type == "top_bar") ++bars;
    ASSERT_EQ(one["vector"].size(), 4u);
    EXPECT_NEAR(one["pose"]["position"]["x"].as<double>(), 11.0, 1e-9);
  }
  EXPECT_EQ(posts, 2);
  EXPECT_EQ(bars, 1);
  EXPECT_TRUE(saysNoBall);  // it lies behind the robot
  EXPECT_TRUE(fs::exists(path("set/front-camera-image.toml")));
}

// Of 100 s it takes a picture in each of the first cycles.
TEST_F(ExportImages, ItsProgressIsTheShareOfTheTimeThatIsSimulated) {
  const std::string field = ORTUNG_SOURCE_DIR "/maps/fields/msl.toml";
  const Outcome outcome = ortung({"export", "images", "sim:" + field + "?duration=100", "--robot",
                                  path("robot.toml").string(), "--out", path("set").string(),
                                  "--count", "4", "--progress"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const std::size_t bar = outcome.err.find(']');
  ASSERT_NE(bar, std::string::npos) << outcome.err;
  EXPECT_TRUE(outcome.err.substr(bar).starts_with("]   0 %")) << outcome.err;
}

TEST_F(ExportImages, HasMasksAndDepthsOfTheSamePixels) {
  ASSERT_EQ(exportTo("set").exitCode, 0);
  const Png mask(path("set/segmentations/000000.png"));
  const Png depth(path("set/depth/000000.png"));
  ASSERT_EQ(mask.width, 160);
  ASSERT_EQ(mask.channels, 1);
  ASSERT_EQ(depth.bits, 16);
  ASSERT_EQ(depth.width * depth.height, 160 * 120);
  int field = 0;
  for (int v = 60; v < 120; ++v)
    for (int u = 0; u < 160; ++u) {
      const std::size_t pixel = static_cast<std::size_t>(v) * 160 + static_cast<std::size_t>(u);
      if (mask.bytes[pixel] != 1 && mask.bytes[pixel] != 2) continue;  // floor and lines
      // The floor in closed form: height over how far the ray falls.
      const double tilt = 15.0 * std::acos(-1.0) / 180.0;
      const double x = (u - 79.5) / 105.0, y = (v - 59.5) / 105.0;
      const double falls = (std::sin(tilt) + y * std::cos(tilt)) / std::sqrt(1.0 + x * x + y * y);
      const double millimetres = depth.bytes[2 * pixel] * 256.0 + depth.bytes[2 * pixel + 1];
      ASSERT_NEAR(millimetres, 600.0 / falls, 0.002 * 600.0 / falls + 1.0) << u << ", " << v;
      ++field;
    }
  EXPECT_GT(field, 5000);
}

TEST_F(ExportImages, LooksAsItDid) {
  ASSERT_EQ(exportTo("plain").exitCode, 0);
  ASSERT_EQ(exportTo("varied", {"--seed", "7", "--variation", "0.6", "--count", "1"}).exitCode, 0);
  const auto compare = [&](const std::string& made, const std::string& golden) {
    const fs::path file = goldenFile("pictures/" + golden);
    if (!fs::exists(file) && std::getenv("ORTUNG_NEW_GOLDEN") != nullptr) {
      fs::create_directories(file.parent_path());
      fs::copy_file(path(made), file);
    }
    ASSERT_TRUE(fs::exists(file)) << file;
    const Png is(path(made)), was(file);
    ASSERT_EQ(is.bytes.size(), was.bytes.size());
    // Another version of Mesa may round otherwise; an edge may be elsewhere by a part of a pixel.
    double sum = 0.0;
    std::size_t far = 0;
    for (std::size_t i = 0; i < is.bytes.size(); ++i) {
      const int off = std::abs(is.bytes[i] - was.bytes[i]);
      sum += off;
      far += off > 24 ? 1U : 0U;
    }
    EXPECT_LT(sum / static_cast<double>(is.bytes.size()), 1.0) << golden;
    EXPECT_LT(static_cast<double>(far), 0.01 * static_cast<double>(is.bytes.size())) << golden;
  };
  compare("plain/images/000000.png", "front.png");
  compare("plain/images/000001.png", "mirror.png");
  compare("varied/images/000000.png", "varied.png");
}

TEST_F(ExportImages, TakesTheSamePicturesAgain) {
  const std::vector<std::string> options{
      "--anywhere", "--seed", "3", "--variation", "1", "--camera", "mirror/camera/image"};
  ASSERT_EQ(exportTo("one", options).exitCode, 0);
  ASSERT_EQ(exportTo("other", options).exitCode, 0);
  for (const char* name : {"000000.png", "000003.png"})
    EXPECT_EQ(readBytes(path("one/images") / name), readBytes(path("other/images") / name));
  EXPECT_NE(readBytes(path("one/images/000000.png")), readBytes(path("one/images/000001.png")));
}

TEST_F(ExportImages, CopiesThePicturesOfARecord) {
  const std::string world = ORTUNG_SOURCE_DIR "/maps/fields/msl.toml";
  const Outcome imported =
      ortung({"import", "sim:" + world + "?speed=0&duration=0.3&start=7.5,1,-15&pictures=on",
              "--with-robot", path("robot.toml").string(), "--out", path("run.rec").string()});
  ASSERT_EQ(imported.exitCode, 0) << imported.err;
  ASSERT_EQ(exportTo("drawn").exitCode, 0);
  const Outcome outcome =
      ortung({"export", "images", "record:" + path("run.rec").string(), "--robot",
              path("robot.toml").string(), "--world", world, "--out", path("copied").string()});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  for (const char* name : {"000000.png", "000001.png", "000007.png"})
    EXPECT_EQ(readBytes(path("copied/images") / name), readBytes(path("drawn/images") / name));
  // Of the four that each of the two cameras took, in turn.
  for (const auto& [every, taken] : {std::pair<std::string, std::vector<int>>{"2", {0, 1, 4, 5}},
                                     {"3", {0, 1, 6, 7}},
                                     {"4", {0, 1}}}) {
    const std::string some = "every" + every;
    const Outcome left = ortung({"export", "images", "record:" + path("run.rec").string(),
                                 "--robot", path("robot.toml").string(), "--world", world,
                                 "--every", every, "--out", path(some).string()});
    ASSERT_EQ(left.exitCode, 0) << left.err;
    EXPECT_NE(left.out.find(": " + std::to_string(taken.size()) + " pictures"), std::string::npos)
        << left.out;
    for (std::size_t i = 0; i < taken.size(); ++i)
      EXPECT_EQ(readBytes(path(some + "/images/00000" + std::to_string(i) + ".png")),
                readBytes(path("copied/images/00000" + std::to_string(taken[i]) + ".png")))
          << every << " " << i;
  }
  const YAML::Node pose = YAML::LoadFile(
      path("copied/annotations.yaml").string())["images"]["000001.png"]["metadata"]["camera_pose"];
  EXPECT_NEAR(pose["position"]["x"].as<double>(), 7.5, 1e-3);  // truth is in whole millimetres
}

TEST_F(ExportImages, RefusesAFolderWithSomethingInIt) {
  fs::create_directories(path("full"));
  std::ofstream(path("full") / "letter.txt") << "dear";
  const Outcome outcome = exportTo("full");
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.err.find("is not empty"), std::string::npos) << outcome.err;
  EXPECT_EQ(exportTo("full", {"--force", "--count", "1"}).exitCode, 0);
}

TEST_F(ExportImages, NeedsARobotWithACamera) {
  const Outcome outcome = exportTo("set", {"--camera", "rear/camera/image"});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.err.find("has no calibrated camera rear/camera/image"), std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace ortung::test
