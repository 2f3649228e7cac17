#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Cameras.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/camera/CameraView.hpp"

namespace ortung {
namespace {

const char* const kPlain =
    "size_px = [641, 481]\nfocal_px = [400.0, 400.0]\ncentre_px = [320.0, 240.0]\n";

CameraView viewOf(const std::string& toml, double z) {
  return readCameraView(parseToml(toml, "camera.toml"), z);
}

TEST(CameraView, ALevelCameraSeesWhatIsAheadInTheMiddle) {
  const CameraView view = viewOf(kPlain, 0.8);
  const auto ahead = view.pixelOf({5.0, 0.0, 0.8});
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->u, 320.0, 1e-9);
  EXPECT_NEAR(ahead->v, 240.0, 1e-9);
  const auto left = view.pixelOf({5.0, 1.0, 0.0});  // left is left, the floor is below
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->u, 320.0 - 400.0 / 5.0, 1e-9);
  EXPECT_NEAR(left->v, 240.0 + 400.0 * 0.8 / 5.0, 1e-9);
  EXPECT_FALSE(view.pixelOf({-5.0, 0.0, 0.0}));
}

TEST(CameraView, TiltedByFortyFiveDegreesItsMiddleShowsTheFloorAtItsHeight) {
  const CameraView view = viewOf(std::string(kPlain) + "tilt_deg = 45\nroll_deg = 10\n", 0.8);
  const auto floor = view.floorAt({320.0, 240.0});
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->x, 0.8, 1e-9);
  EXPECT_NEAR(floor->y, 0.0, 1e-9);
  EXPECT_NEAR(view.floorAt({320.0, 240.0}, 0.3)->x, 0.5, 1e-9);
  EXPECT_FALSE(viewOf(kPlain, 0.8).floorAt({320.0, 239.0})) << "above the horizon";
}

TEST(CameraView, SeesTheFloorUpToAMillionMetres) {
  const CameraView view = viewOf(kPlain, 1.0);
  const auto floorAt = [&](double metres) { return view.floorAt({320.0, 240.0 + 400.0 / metres}); };
  ASSERT_TRUE(floorAt(0.99e6));
  EXPECT_NEAR(floorAt(0.99e6)->x, 0.99e6, 1.0);
  EXPECT_FALSE(floorAt(1.01e6)) << "that is the horizon";
}

TEST(CameraView, ARolledCameraSeesTheHorizonTurnAgainstIt) {
  // Clockwise as the camera looks: what lies level to the right moves up in its image.
  const CameraView view = viewOf(std::string(kPlain) + "roll_deg = 30\n", 0.8);
  const auto right = view.pixelOf({5.0, -1.0, 0.8});
  ASSERT_TRUE(right);
  EXPECT_NEAR(right->u, 320.0 + 80.0 * std::cos(std::numbers::pi / 6), 1e-9);
  EXPECT_NEAR(right->v, 240.0 - 80.0 * std::sin(std::numbers::pi / 6), 1e-9);
}

TEST(CameraView, LookingDownForwardIsUpInTheImage) {
  const CameraView view = viewOf(kIsometric, 0.7);
  const auto pixel = view.pixelOf({2.0, 1.0, 0.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->u, 239.5 - 40.0, 1e-9);
  EXPECT_NEAR(pixel->v, 239.5 - 80.0, 1e-9);
}

TEST(CameraView, FloorPointsOfPixelsProjectBack) {
  const CameraView view = viewOf(std::string(kFisheye) + "tilt_deg = 25\nroll_deg = -2\n", 0.75);
  for (double u = 20; u < 600; u += 37)
    for (double v = 420; v < 790; v += 41) {
      const auto floor = view.floorAt({u, v});
      if (!floor) continue;
      const auto back = view.pixelOf(*floor);
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->u, u, 1e-6);
      EXPECT_NEAR(back->v, v, 1e-6);
    }
}

TEST(CameraView, ItsTextMakesItAgain) {
  const CameraView view = viewOf(std::string(kUnified) + "tilt_deg = 90\nroll_deg = 1.5\n", 0.6);
  const std::string text = toToml(view);
  EXPECT_EQ(toToml(viewOf(text, 0.6)), text);
}

}  // namespace
}  // namespace ortung
