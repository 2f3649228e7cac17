#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "MslLines.hpp"
#include "Paths.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/calibration/LineCalibration.hpp"
#include "ortung/vision/FloorSight.hpp"

namespace ortung {
namespace {

CameraView fisheye(double focal, double height, double tilt) {
  Parameters p("camera");
  p.set("model", "fisheye");
  p.set("size_px", std::vector<double>{608, 800});
  p.set("focal_px", std::vector<double>{focal, focal});
  p.set("distortion", std::vector<double>{-0.012, -0.004, 0.0, 0.0});
  return {readCamera(p), {.z = height, .tilt = tilt, .roll = 0.01}};
}

/// What a perfect detector would find, but for noise of the pixels.
LinePicture pictureFrom(const FieldLines& field, const CameraView& view, const Pose2& pose,
                        Random& random, double noise = 0.5) {
  LinePicture picture;
  picture.floorTop = 415.0;
  const auto add = [&](double x, double y) {
    const Pose2 place = inverse(pose) * Pose2{x, y, 0.0};
    if (std::hypot(place.x, place.y) > 9.0) return;
    const auto pixel = view.pixelOf({place.x, place.y, 0.0});
    if (!pixel || !view.model().contains(*pixel)) return;
    picture.points.push_back(
        {{pixel->u + random.gaussian() * noise, pixel->v + random.gaussian() * noise}, 5.0, true});
  };
  for (const FieldLine& line : field.lines()) {
    if (line.shape == FieldLine::Shape::kStraight) {
      const double length = std::hypot(line.x1 - line.x0, line.y1 - line.y0);
      for (double d = 0.0; d <= length; d += 0.15)
        add(line.x0 + (line.x1 - line.x0) * d / length, line.y0 + (line.y1 - line.y0) * d / length);
    } else {
      for (double t = line.from; t <= line.to; t += 0.15 / line.radiusX)
        add(line.x + line.radiusX * std::cos(t), line.y + line.radiusX * std::sin(t));
    }
  }
  return picture;
}

/// Pictures from three places all over the field.
std::vector<LinePicture> picturesFrom(const FieldLines& field, const CameraView& view,
                                      double noise = 0.5) {
  Random random(8);
  std::vector<LinePicture> pictures;
  for (const Pose2 pose : {Pose2{-7.0, 3.0, 2.8}, Pose2{2.5, 1.0, 2.9}, Pose2{8.0, -4.0, -0.6}})
    pictures.push_back(pictureFrom(field, view, pose, random, noise));
  return pictures;
}

TEST(LineCalibration, FindsTheCameraThatMadeThePictures) {
  const FieldLines field(mslLines({}));
  const CameraView truth = fisheye(318.0, 0.76, radians(3.0));
  const auto pictures = picturesFrom(field, truth);
  const auto found = calibrateByLines({608, 800}, pictures, LinePoseSearch(field), {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->view.place().z, 0.76, 0.01);
  EXPECT_NEAR(found->view.place().tilt, radians(3.0), radians(1.0));
  for (const LinePictureFit& fit : found->pictures) EXPECT_LT(fit.median, 0.02);
  // What counts: the same pixels show the same floor.
  for (double u = 50; u < 600; u += 100)
    for (double v = 470; v < 760; v += 60) {
      const auto a = truth.floorAt({u, v});
      const auto b = found->view.floorAt({u, v});
      ASSERT_TRUE(a && b);
      const double range = std::hypot(a->x, a->y);
      EXPECT_NEAR(std::hypot(b->x, b->y), range, 0.02 * range + 0.01);
    }
}

// The mean of r^2 / (1 + r^2 / 9) is 0.776 if r is normally distributed. Of near points it is less,
// since their sigma has the floor's centimetre as well, and each picture's pose fits its noise.
TEST(LineCalibration, CostsWhatTheNoiseOfPixelsExplains) {
  const FieldLines field(mslLines({}));
  const CameraView truth = fisheye(318.0, 0.76, radians(3.0));
  const auto pictures = picturesFrom(field, truth, 1.0);
  LineCalibrationGuess guess;
  guess.focals = {0.4};
  const auto found = calibrateByLines({608, 800}, pictures, LinePoseSearch(field), guess);
  ASSERT_TRUE(found);
  EXPECT_LT(found->cost, 0.79);
  EXPECT_GT(found->cost, 0.55);
}

TEST(LineCalibration, SaysThatThereWereNoLines) {
  const LinePoseSearch search{FieldLines(mslLines({}))};
  EXPECT_FALSE(calibrateByLines({608, 800}, std::vector<LinePicture>(2), search, {}));
}

struct Fitted {
  std::string group;
  LinePictureFit fit;
};

/// Calibrates each camera whose pictures begin with @p day by its own pictures.
std::vector<Fitted> fitAll(const std::string& day, const MslSizes& sizes) {
  std::map<std::string, std::vector<std::filesystem::path>> cameras;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(ORTUNG_SHARED_DATA) / "robocup_ml")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".jpg" && name.starts_with(day))
      cameras[name.substr(0, name.find("_cam") + 5)].push_back(entry.path());
  }
  const LinePoseSearch search{FieldLines(mslLines(sizes))};
  std::vector<Fitted> all;
  for (auto& [camera, files] : cameras) {
    std::sort(files.begin(), files.end());
    std::vector<LinePicture> pictures;
    ImageSize size;
    for (const auto& file : files) {
      const Picture picture = readPicture(file);
      const ImageView view = picture.view();
      const ColourTable colours(findColours({&view, 1}));
      LineFinder finder({});
      const auto points = finder.find(view, colours);
      pictures.push_back({{points.begin(), points.end()}, floorTopOf(view, colours)});
      size = picture.size;
    }
    const auto found = calibrateByLines(size, pictures, search, {});
    if (!found) continue;
    std::printf("%s: height %.3f m, tilt %.2f deg, cost %.3f, medians", camera.c_str(),
                found->view.place().z, degrees(found->view.place().tilt), found->cost);
    for (const LinePictureFit& fit : found->pictures) {
      std::printf(" %.3f (%zu)", fit.median, fit.points);
      all.push_back({camera, fit});
    }
    std::printf("\n");
  }
  return all;
}

class RealCameras : public testing::TestWithParam<std::pair<const char*, MslSizes>> {};

TEST_P(RealCameras, FitTheFieldByItsLinesAlone) {
  if (!std::filesystem::exists(std::filesystem::path(ORTUNG_SHARED_DATA) / "robocup_ml"))
    GTEST_SKIP() << "../shared/data/robocup_ml is absent";
  for (const Fitted& one : fitAll(GetParam().first, GetParam().second)) {
    if (one.fit.points < 10) continue;  // nothing near
    EXPECT_LT(one.fit.median, 0.10) << one.group;
  }
}

INSTANTIATE_TEST_SUITE_P(Venues, RealCameras,
                         testing::Values(std::pair{"20240717_r7_cam1", MslSizes{}},
                                         std::pair{"20220715_r7_cam2", MslSizes{}},
                                         std::pair{"20260514_r4",
                                                   MslSizes{.length = 18.0, .width = 12.0}}),
                         [](const auto& test) { return std::string("Day") + test.param.first; });

}  // namespace
}  // namespace ortung
