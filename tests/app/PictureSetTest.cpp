// A data set of pictures: its files, its masks and depths, and what its annotations say.
#include <gtest/gtest.h>
#include <png.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "DecodedPng.hpp"
#include "FakeWorld.hpp"
#include "Files.hpp"
#include "PictureSet.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;
using test::messageOf;
using test::readBytes;

/// 0.5 m over the floor, looking along the horizon.
CameraView cameraOf() {
  return readCameraView(parseToml("size_px = [160, 120]\nfocal_px = [100.0, 100.0]", "camera.toml"),
                        0.5);
}

DecodedPng pictureIn(const fs::path& file) {
  const std::string bytes = readBytes(file);
  return DecodedPng(std::as_bytes(std::span(bytes)));
}

/// The numbers of 16 bits that a picture has.
std::vector<std::uint16_t> depthsIn(const fs::path& file) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&image, file.c_str()), 0) << file;
  image.format = PNG_FORMAT_LINEAR_Y;
  std::vector<std::uint16_t> depths(static_cast<std::size_t>(image.width) * image.height);
  EXPECT_NE(png_image_finish_read(&image, nullptr, depths.data(), 0, nullptr), 0);
  return depths;
}

class PictureSetTest : public testing::Test {
 protected:
  static PictureNotes notesOf(const CameraView* camera, const std::string& set) {
    PictureNotes notes;
    notes.camera = camera;
    notes.set = set;
    notes.tag = "simulation";
    return notes;
  }
  const std::vector<std::uint8_t> pixels_ = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const ImageView image_{{2, 2}, PixelFormat::kRgb, pixels_.data()};
  const CameraView camera_ = cameraOf();
  test::TemporaryFolder folder_;
};

TEST_F(PictureSetTest, HasNumberedPicturesWithTheirPixels) {
  PictureSet set(folder_ / "set", false);
  set.add(0, notesOf(&camera_, "front/camera/image"), image_, {}, {});
  set.add(1, notesOf(&camera_, "front/camera/image"), image_, {}, {});
  set.add(2, notesOf(nullptr, "rear/camera/image"), image_, {}, {});
  set.finish();
  EXPECT_EQ(set.numbers(), (std::vector<std::size_t>{0, 1, 2}));
  const DecodedPng picture = pictureIn(folder_ / "set/images/000002.png");
  EXPECT_TRUE(picture.is(0, 0, {1, 2, 3}));
  EXPECT_TRUE(picture.is(1, 0, {4, 5, 6}));
  EXPECT_TRUE(picture.is(0, 1, {7, 8, 9}));
  EXPECT_FALSE(fs::exists(folder_ / "set/images/000003.png"));
  EXPECT_TRUE(fs::is_empty(folder_ / "set/depth")) << "nothing is known of their pixels";
  EXPECT_TRUE(fs::is_empty(folder_ / "set/segmentations"));
  const YAML::Node images = YAML::LoadFile(folder_ / "set/annotations.yaml")["images"];
  ASSERT_EQ(images.size(), 3u);
  EXPECT_EQ(images["000001.png"]["width"].as<int>(), 2);
  EXPECT_EQ(images["000001.png"]["height"].as<int>(), 2);
}

TEST_F(PictureSetTest, HasTheCalibrationOfEachCameraThatHasOne) {
  PictureSet set(folder_ / "set", false);
  set.add(0, notesOf(&camera_, "front/camera/image"), image_, {}, {});
  set.add(1, notesOf(nullptr, "rear/camera/image"), image_, {}, {});
  EXPECT_EQ(readBytes(folder_ / "set/front-camera-image.toml"), toToml(camera_));
  EXPECT_FALSE(fs::exists(folder_ / "set/rear-camera-image.toml"));
}

TEST_F(PictureSetTest, GreyPicturesStayGrey) {
  PictureSet set(folder_ / "set", false);
  set.add(0, notesOf(nullptr, "a/b/c"), {{3, 1}, PixelFormat::kGrey, pixels_.data()}, {}, {});
  const DecodedPng picture = pictureIn(folder_ / "set/images/000000.png");
  ASSERT_EQ(picture.width, 3);
  EXPECT_TRUE(picture.is(2, 0, {3, 3, 3}));
}

// The lower 8 bits of a thing are its class; the others say which one it is.
TEST_F(PictureSetTest, MasksHaveAColourForEachClass) {
  PictureSet set(folder_ / "set", false);
  const std::vector<std::uint32_t> things = {0x100 + 5, 2, 0x300 + 6, 8};
  set.add(0, notesOf(&camera_, "a/b/c"), image_, things, std::vector<float>(4, 1.0F));
  const DecodedPng mask = pictureIn(folder_ / "set/segmentations/000000.png");
  EXPECT_TRUE(mask.is(0, 0, {255, 120, 0})) << "a ball";
  EXPECT_TRUE(mask.is(1, 0, {255, 255, 255})) << "a line";
  EXPECT_TRUE(mask.is(0, 1, {220, 0, 0})) << "a robot";
  EXPECT_TRUE(mask.is(1, 1, {90, 90, 140})) << "a wall";
}

TEST_F(PictureSetTest, DepthsAreMillimetresAndZeroBeyond16Bits) {
  PictureSet set(folder_ / "set", false);
  const std::vector<std::uint32_t> things(4, 0);
  set.add(0, notesOf(&camera_, "a/b/c"), image_, things,
          std::vector<float>{1.2344F, 0.0F, 65.53F, 70});
  set.add(1, notesOf(&camera_, "a/b/c"), image_, things,
          std::vector<float>{0.0006F, std::numeric_limits<float>::infinity(), std::nanf(""), 2});
  EXPECT_EQ(depthsIn(folder_ / "set/depth/000000.png"),
            (std::vector<std::uint16_t>{1234, 0, 65530, 0}));
  EXPECT_EQ(depthsIn(folder_ / "set/depth/000001.png"),
            (std::vector<std::uint16_t>{1, 0, 0, 2000}));
}

TEST_F(PictureSetTest, FoldersWithSomethingInThemAreUsedOnlyIfForced) {
  fs::create_directory(folder_ / "full");
  test::writeBytes(folder_ / "full" / "letter", "dear");
  const auto refusal = [&](const std::string& name) {
    return messageOf<std::runtime_error>([&] { PictureSet(folder_ / name, false); });
  };
  EXPECT_EQ(refusal("full"), (folder_ / "full").string() +
                                 ": is not empty; name an empty or new folder, or use --force to "
                                 "overwrite pictures");
  EXPECT_FALSE(fs::exists(folder_ / "full/images"));
  EXPECT_EQ(refusal("full/letter"),
            (folder_ / "full/letter").string() + ": is a file, expected a folder");
  fs::create_directory(folder_ / "empty");
  EXPECT_EQ(refusal("empty"), "(nothing was thrown)");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { PictureSet(folder_ / "full", true); }),
            "(nothing was thrown)");
  EXPECT_EQ(readBytes(folder_ / "full" / "letter"), "dear");
}

WorldObject objectOf(const std::string& kind, double x, double y, bool isRound) {
  WorldObject object;
  object.kind = kind;
  object.pose = {x, y, 0.25};
  object.radius = object.halfX = object.halfY = 0.1;
  object.zHigh = 0.2;
  object.isRound = isRound;
  return object;
}

/// Pixels of 160 x 120 on which one object is seen within a box, both ends included.
std::vector<std::uint32_t> seen(std::uint32_t number, int left, int top, int right, int bottom) {
  std::vector<std::uint32_t> things(160 * 120, 1);
  for (int v = top; v <= bottom; ++v)
    for (int u = left; u <= right; ++u)
      things[static_cast<std::size_t>(v * 160 + u)] = number << 8 | 5;
  return things;
}

const Annotation* annotationOf(const std::vector<Annotation>& all, const std::string& type) {
  for (const Annotation& one : all)
    if (one.type == type) return &one;
  return nullptr;
}

TEST(Annotations, HaveTheBoxAndThePlaceOfWhatIsSeen) {
  FakeWorld world(10, 10);
  world.addObject(objectOf("robot", 4, 1, true));
  world.addObject(objectOf("ball", 2, 0, true));
  const auto all = annotationsOf(seen(2, 70, 65, 90, 88), world, cameraOf(), {});
  ASSERT_EQ(all.size(), 2u);
  const Annotation* ball = annotationOf(all, "ball");
  ASSERT_NE(ball, nullptr);
  EXPECT_TRUE(ball->isSeen);
  EXPECT_EQ(ball->left, 70);
  EXPECT_EQ(ball->top, 65);
  EXPECT_EQ(ball->right, 90);
  EXPECT_EQ(ball->bottom, 88);
  EXPECT_EQ(ball->pose.x, 2.0);
  EXPECT_DOUBLE_EQ(ball->z, 0.1);
  // Balls and robots have an annotation that says that there is none.
  const Annotation* robot = annotationOf(all, "robot");
  ASSERT_NE(robot, nullptr);
  EXPECT_FALSE(robot->isSeen);
}

TEST(Annotations, KindsAreThoseOfTheDataSet) {
  FakeWorld world(10, 10);
  world.addObject(objectOf("goal", 2, 0, true));
  world.addObject(objectOf("goal", 2, 0, false));
  world.addObject(objectOf("wall", 2, 0, false));
  world.addObject(objectOf("chair", 2, 0, false));
  const std::string types[] = {"goalpost", "top_bar", "", "obstacle"};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto all = annotationsOf(seen(i + 1, 70, 65, 90, 88), world, cameraOf(), {});
    EXPECT_EQ(all.size(), types[i].empty() ? 2u : 3u) << "and neither a ball nor a robot";
    EXPECT_EQ(all[0].type, types[i].empty() ? "ball" : types[i]);
  }
}

// At 2 m a ball of 0.2 m is 10 pixels wide, and from 85 to 74 rows down to 73: some 120 pixels.
TEST(Annotations, AThingOfWhichAQuarterIsHiddenIsConcealed) {
  FakeWorld world(10, 10);
  world.addObject(objectOf("ball", 2, 0, true));
  const auto isConcealed = [&](int width, int height) {
    const auto all =
        annotationsOf(seen(1, 75, 74, 75 + width - 1, 74 + height - 1), world, cameraOf(), {});
    return all.at(0).isConcealed;
  };
  EXPECT_FALSE(isConcealed(10, 12));
  EXPECT_FALSE(isConcealed(10, 10));
  EXPECT_TRUE(isConcealed(10, 8));
  EXPECT_TRUE(isConcealed(6, 12));
}

TEST(Annotations, WhatThePictureCutsOffIsNotHidden) {
  FakeWorld world(10, 10);
  world.addObject(objectOf("ball", 2, 1.59, true));  // its middle at the left border
  const auto all = annotationsOf(seen(1, 0, 74, 4, 85), world, cameraOf(), {});
  EXPECT_FALSE(all.at(0).isConcealed);
}

TEST(Annotations, YamlHasCornersPosesAndTheCamera) {
  const CameraView camera = cameraOf();
  PictureNotes notes;
  notes.file = "000007.png";
  notes.size = {160, 120};
  notes.camera = &camera;
  notes.sensor = Pose2{1.5, -2.5, std::numbers::pi / 2};
  notes.location = "a \"hall\"";
  notes.tag = "record";
  notes.set = "front/camera/image";
  Annotation post{"goalpost", true, true, 10, 20, 30, 40, {11.0, 1.0, std::numbers::pi}, 0.5};
  Annotation ball = post;
  ball.type = "ball";
  ball.isConcealed = false;
  Annotation robot;
  robot.type = "robot";
  notes.annotations = {post, ball, robot};
  const YAML::Node picture =
      YAML::Load(annotationsYaml(std::array{annotationYaml(notes)}))["images"]["000007.png"];
  const YAML::Node all = picture["annotations"];
  ASSERT_EQ(all.size(), 3u);
  using Corners = std::vector<std::vector<int>>;
  EXPECT_EQ(all[0]["vector"].as<Corners>(), (Corners{{10, 20}, {30, 20}, {30, 40}, {10, 40}}));
  EXPECT_EQ(all[1]["vector"].as<Corners>(), (Corners{{10, 20}, {30, 40}}));
  EXPECT_TRUE(all[0]["concealed"].as<bool>());
  EXPECT_FALSE(all[1]["concealed"].as<bool>());
  EXPECT_FALSE(all[1]["blurred"].as<bool>());
  EXPECT_EQ(all[0]["pose"]["position"]["z"].as<double>(), 0.5);
  EXPECT_NEAR(std::abs(all[0]["pose"]["orientation"]["z"].as<double>()), 1.0, 1e-8);
  EXPECT_FALSE(all[2]["in_image"].as<bool>());
  EXPECT_FALSE(all[2]["vector"]);
  EXPECT_FALSE(all[2]["pose"]);
  const YAML::Node metadata = picture["metadata"];
  EXPECT_EQ(metadata["location"].as<std::string>(), "a \"hall\"");
  EXPECT_EQ(metadata["tags"][0].as<std::string>(), "record");
  EXPECT_EQ(metadata["imageset_id"].as<std::string>(), "front/camera/image");
  EXPECT_NEAR(metadata["fov"].as<double>(), 2 * std::atan(0.795) * 180 / std::numbers::pi, 1e-6);
  EXPECT_EQ(metadata["camera_pose"]["position"]["x"].as<double>(), 1.5);
  EXPECT_EQ(metadata["camera_pose"]["position"]["y"].as<double>(), -2.5);
  EXPECT_EQ(metadata["camera_pose"]["position"]["z"].as<double>(), 0.5);
}

TEST(Annotations, YamlLeavesOutWhatIsNotKnown) {
  PictureNotes notes;
  notes.file = "a.png";
  notes.size = {1, 1};
  const YAML::Node metadata =
      YAML::Load(annotationsYaml(std::array{annotationYaml(notes)}))["images"]["a.png"]["metadata"];
  for (const char* key : {"fov", "location", "camera_pose"}) EXPECT_FALSE(metadata[key]) << key;
}

}  // namespace
}  // namespace ortung::app
