/// Balls on pictures of real robots (../shared/data/robocup_ml), beside boxes around them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "Paths.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/calibration/ImageFile.hpp"
#include "ortung/vision/BallFinder.hpp"

namespace ortung {
namespace {

namespace fs = std::filesystem;

const fs::path kPictures = fs::path(ORTUNG_SHARED_DATA) / "robocup_ml";
const fs::path kMarks = fs::path(ORTUNG_SOURCE_DIR) / "tests/data/vision/robocup_ml_balls.json";
constexpr double kRadius = 0.11;  // [m]

/// A camera as all of these robots have it, about: they differ by 5 % in focal length and height,
/// and by a degree in tilt.
CameraView aboutTheirCamera() {
  Parameters p("camera");
  p.set("model", "fisheye");
  p.set("size_px", std::vector<double>{608, 800});
  p.set("focal_px", std::vector<double>{327, 327});
  p.set("distortion", std::vector<double>{0, 0, 0, 0});
  return {readCamera(p), {.z = 0.76, .tilt = 0.01}};
}

/// Whether a pixel is in a box [u, v, width, height], which may be off by a fifth of its size.
bool isIn(const nlohmann::json& box, const Pixel& p) {
  return std::abs(p.u - box.at(0).get<double>()) <= 0.6 * box.at(2).get<double>() + 1.0 &&
         std::abs(p.v - box.at(1).get<double>()) <= 0.6 * box.at(3).get<double>() + 1.0;
}

TEST(RealBalls, AreFoundWhereTheyWereMarked) {
  if (!fs::exists(kPictures)) GTEST_SKIP() << kPictures << " is absent";
  const CameraView view = aboutTheirCamera();
  BallFinder finder(view, {.radius = kRadius});
  int found = 0, missed = 0, wrong = 0;
  std::ifstream in(kMarks);
  const nlohmann::json marks = nlohmann::json::parse(in);
  for (const auto& image : marks.at("images")) {
    const Picture picture = readPicture(kPictures / image.at("file").get<std::string>());
    const ImageView pixels = picture.view();
    std::vector<Pixel> middles;
    for (const SeenBall& ball : finder.find(pixels, ColourTable(findColours({&pixels, 1}))))
      if (const auto pixel = view.pixelOf(
              {ball.range * std::cos(ball.bearing), ball.range * std::sin(ball.bearing), kRadius}))
        middles.push_back(*pixel);
    for (const auto& box : image.at("balls")) {
      const bool isFound =
          std::any_of(middles.begin(), middles.end(), [&](const Pixel& p) { return isIn(box, p); });
      ++(isFound ? found : missed);
    }
    for (const Pixel& p : middles) {
      const auto isIt = [&](const nlohmann::json& box) { return isIn(box, p); };
      const auto& balls = image.at("balls");
      const auto& unsure = image.at("unsure");
      if (std::any_of(balls.begin(), balls.end(), isIt) ||
          std::any_of(unsure.begin(), unsure.end(), isIt))
        continue;
      ++wrong;
      std::printf("%s: no ball at %.0f, %.0f\n", image.at("file").get<std::string>().c_str(), p.u,
                  p.v);
    }
  }
  const double precision = found / std::max(1.0, 1.0 * (found + wrong));
  const double recall = found / std::max(1.0, 1.0 * (found + missed));
  std::printf("balls: %d found, %d missed, %d wrong; precision %.2f, recall %.2f\n", found, missed,
              wrong, precision, recall);
  EXPECT_GE(precision, 0.9);
  EXPECT_GE(recall, 0.75);
}

}  // namespace
}  // namespace ortung
