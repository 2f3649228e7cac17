#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "Cameras.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/camera/CameraModel.hpp"

namespace ortung {
namespace {

/// A table that holds what a mirror sees whose floor points lie at 0.01 m a pixel and grow.
std::string tableToml() {
  std::string floor;
  for (int row = 0; row < 17; ++row)
    for (int column = 0; column < 21; ++column) {
      const double x = -(row - 8) * 0.3;
      const double y = -(column - 10) * 0.24;
      const double grow = 1.0 + 0.08 * std::hypot(x, y);
      floor +=
          (floor.empty() ? "" : ", ") + std::to_string(x * grow) + ", " + std::to_string(y * grow);
    }
  return "model = \"table\"\nsize_px = [401, 321]\nheight_m = 0.8\ngrid = [21, 17]\nfloor_m = [" +
         floor + "]\n";
}

class RoundTrip : public testing::TestWithParam<std::string> {};

TEST_P(RoundTrip, UnprojectedPixelsProjectToThemselves) {
  const auto camera = cameraOf(GetParam());
  Random random(4);
  int seen = 0;
  for (int i = 0; i < 10000; ++i) {
    const Pixel pixel{random.uniform() * (camera->size().width - 1),
                      random.uniform() * (camera->size().height - 1)};
    const auto ray = camera->unproject(pixel);
    if (!ray) continue;
    EXPECT_NEAR(std::hypot(ray->x, ray->y, ray->z), 1.0, 1e-12);
    const auto back = camera->project({3.0 * ray->x, 3.0 * ray->y, 3.0 * ray->z});
    ASSERT_TRUE(back) << pixel.u << " " << pixel.v;
    EXPECT_NEAR(back->u, pixel.u, 1e-6);
    EXPECT_NEAR(back->v, pixel.v, 1e-6);
    ++seen;
  }
  EXPECT_GT(seen, 6000);
}

TEST_P(RoundTrip, ItsTextMakesItAgain) {
  const auto camera = cameraOf(GetParam());
  const auto again = cameraOf(camera->toml());
  EXPECT_EQ(again->toml(), camera->toml());
  const auto a = camera->unproject({100.25, 200.5});
  const auto b = again->unproject({100.25, 200.5});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->x, b->x);
  EXPECT_EQ(a->y, b->y);
  EXPECT_EQ(a->z, b->z);
}

INSTANTIATE_TEST_SUITE_P(Models, RoundTrip,
                         testing::Values(kPerspective, kFisheye, kUnified, kOcam, kIsometric,
                                         tableToml(),
                                         "model = \"unified\"\nsize_px = [400, 400]\nxi = 1.4\n"
                                         "focal_px = [300.0, 300.0]\n"),
                         [](const auto& test) { return "m" + std::to_string(test.index); });

TEST(CameraModel, MirrorsExchangeLeftAndRight) {
  const auto plain = cameraOf(kFisheye);
  const auto mirrored = cameraOf(std::string(kFisheye) + "mirrored = true\n");
  const auto a = plain->project({0.3, 0.2, 1.0});
  const auto b = mirrored->project({-0.3, 0.2, 1.0});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->u, b->u);
  EXPECT_EQ(a->v, b->v);
}

TEST(CameraModel, SeesNothingWithinItsMask) {
  const auto camera = cameraOf(std::string(kIsometric) + "inner_px = 30.0\nouter_px = 200.0\n");
  EXPECT_FALSE(camera->unproject({239.5 + 29.0, 239.5}));
  EXPECT_TRUE(camera->unproject({239.5 + 31.0, 239.5}));
  EXPECT_FALSE(camera->unproject({239.5, 239.5 + 201.0}));
  EXPECT_FALSE(camera->project({0.001, 0.0, 1.0}));
}

TEST(CameraModel, TheIsometricMirrorShowsTheFloorToScale) {
  const auto camera = cameraOf(kIsometric);
  for (const double x : {-5.0, -1.0, 0.0, 2.5})
    for (const double y : {-4.0, 0.5, 5.5}) {
      const auto pixel = camera->project({x, y, 0.7});
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->u, 239.5 + 40.0 * x, 1e-9);
      EXPECT_NEAR(pixel->v, 239.5 + 40.0 * y, 1e-9);
    }
}

TEST(CameraModel, ATableShowsItsFloorPointsAtItsPixels) {
  const auto camera = cameraOf(tableToml());
  // Column 15, row 4 of the grid: 20 pixels a step. x = 1.2, y = -1.2, both grown.
  const double grow = 1.0 + 0.08 * std::hypot(1.2, 1.2);
  const auto pixel = camera->project({1.2 * grow, -1.2 * grow, 0.8});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->u, 300.0, 1e-3);  // the text has six digits
  EXPECT_NEAR(pixel->v, 80.0, 1e-3);
}

TEST(CameraModel, ATableReachesHalfAStepBeyondItsGrid) {
  const auto camera = cameraOf(tableToml());  // 20 pixels a step, on 401 x 321
  for (const double off : {-9.9, 0.0, 200.0, 409.9}) {
    EXPECT_TRUE(camera->unproject({off, 160.0})) << off;
    EXPECT_TRUE(camera->unproject({160.0, std::min(off, 329.9)})) << off;
  }
  for (const double off : {-1000.0, -15.0, -10.1, 410.1, 415.0, 1000.0})
    EXPECT_FALSE(camera->unproject({off, 160.0})) << off;
  for (const double off : {-1000.0, -15.0, -10.1, 330.1, 335.0, 1000.0})
    EXPECT_FALSE(camera->unproject({160.0, off})) << off;
  for (const Pixel& pixel : {Pixel{-9.9, 100.0}, {409.9, 100.0}, {100.0, -9.9}, {100.0, 329.9}}) {
    const auto back = camera->project(*camera->unproject(pixel));
    ASSERT_TRUE(back) << pixel.u << " " << pixel.v;
    EXPECT_NEAR(back->u, pixel.u, 1e-6);
    EXPECT_NEAR(back->v, pixel.v, 1e-6);
  }
}

// Beyond the radius where the distorted radius falls again, 1 + (2 i + 1) k_i r^(2 i) = 0 for k_i
// alone, two points would have one pixel. It is found in steps of 0.0035.
TEST(CameraModel, SeesAsFarAsItsDistortionIsOneToOne) {
  const auto limitOf = [](const std::string& distortion) {
    const auto camera = cameraOf("size_px = [641, 641]\nfocal_px = [100.0, 100.0]\ndistortion = [" +
                                 distortion + "]\n");
    double r = 0.0;
    while (r < 3.0 && camera->project({r, 0.0, 1.0})) r += 1e-3;
    return r;
  };
  EXPECT_NEAR(limitOf("-0.2"), std::sqrt(1.0 / (3.0 * 0.2)), 0.005);
  EXPECT_NEAR(limitOf("0, -0.2"), std::pow(1.0 / (5.0 * 0.2), 1.0 / 4.0), 0.005);
  EXPECT_NEAR(limitOf("0, 0, 0, 0, -0.2"), std::pow(1.0 / (7.0 * 0.2), 1.0 / 6.0), 0.005);
}

TEST(CameraModel, DoesNotLookBehindItself) {
  EXPECT_FALSE(cameraOf(kPerspective)->project({0.0, 0.0, -1.0}));
  EXPECT_FALSE(cameraOf(kPerspective)->project({1.0, 0.0, 0.0}));
  EXPECT_FALSE(cameraOf(kIsometric)->project({1.0, 0.0, -0.1}));
  EXPECT_FALSE(cameraOf(kUnified)->project({0.01, 0.0, -1.0}));
  EXPECT_FALSE(cameraOf(kFisheye)->project({0.0, 0.0, 0.0}));
  EXPECT_FALSE(cameraOf(kFisheye)->project({NAN, 0.0, 1.0}));
  EXPECT_FALSE(cameraOf(kFisheye)->unproject({INFINITY, 0.0}));
}

TEST(CameraModel, RefusesSettingsThatMakeNoCamera) {
  const auto refusal = [](const std::string& toml) -> std::string {
    try {
      cameraOf(toml);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_NE(refusal("size_px = [640, 480]\n").find("focal_px"), std::string::npos);
  EXPECT_NE(refusal("model = \"pinhole\"\nsize_px = [640, 480]\n").find("fisheye"),
            std::string::npos);
  EXPECT_NE(refusal("size_px = [640.5, 480]\nfocal_px = [1, 1]\n").find("whole"),
            std::string::npos);
  EXPECT_NE(refusal("size_px = [1e9, 480]\nfocal_px = [1, 1]\n").find("8192"), std::string::npos);
  EXPECT_NE(refusal("model = \"ocam\"\nsize_px = [64, 48]\npolynomial = [-3.0]\n").find("positive"),
            std::string::npos);
  EXPECT_NE(refusal("model = \"table\"\nsize_px = [64, 48]\nheight_m = 1\ngrid = [2, 2]\n"
                    "floor_m = [1, 1]\n")
                .find("expected 8"),
            std::string::npos);
  const std::string lens = "size_px = [64, 48]\nfocal_px = [50, 50]\ndistortion = [";
  const std::string numbers = "0, 0, 0, 0";
  EXPECT_EQ(refusal(lens + numbers + ", 0]\n"), "taken");
  for (const std::string& more : {std::string(", 0, 7"), [&] {
                                    std::string many;
                                    for (int i = 0; i < 4000; ++i) many += ", 7";
                                    return many;
                                  }()})
    EXPECT_NE(refusal(lens + numbers + more + "]\n").find("numbers, expected at most 5"),
              std::string::npos);
  const std::string unified = "model = \"unified\"\nxi = 1\n" + lens;
  EXPECT_EQ(refusal(unified + numbers + "]\n"), "taken");
  EXPECT_NE(refusal(unified + numbers + ", 0]\n").find("has 5 numbers, expected at most 4"),
            std::string::npos);
}

TEST(CameraModel, NumbersHaveTheLimitsThatRefusalsTell) {
  struct Limits {
    std::string settings;  ///< with @ where the number stands
    std::string low;
    std::string high;
  };
  const std::string size = "size_px = [64, 48]\n";
  const std::string lens = size + "focal_px = [50, 50]\n";
  std::vector<Limits> all = {
      {"focal_px = [50, 50]\nsize_px = [64, @]", "8", "8192"},
      {lens + "centre_px = [@, 0]", "-100000", "100000"},
      {lens + "inner_px = @", "0", "100000"},
      {lens + "outer_px = @", "0", "100000"},
      {"model = \"unified\"\n" + lens + "xi = @", "0", "10"},
      {"model = \"unified\"\nxi = 1\n" + lens + "skew_px = @", "-100000", "100000"},
      {"model = \"ocam\"\n" + size + "polynomial = [10, @]", "-1000000000", "1000000000"},
      {"model = \"ocam\"\n" + size + "polynomial = [10]\naffine = [@, 0, 0]", "-10", "10"},
      {"model = \"isometric\"\n" + size + "height_m = 1\npixels_per_m = @", "0.01", "100000"},
      {"model = \"isometric\"\n" + size + "pixels_per_m = 10\nheight_m = @", "0.01", "100"},
      {"model = \"table\"\n" + size + "grid = [2, 2]\nfloor_m = [1, 1]\nheight_m = @", "0.01",
       "100"},
      {"model = \"table\"\n" + size + "height_m = 1\nfloor_m = [1, 1]\ngrid = [2, @]", "2", "1024"},
      {"model = \"table\"\n" + size + "height_m = 1\ngrid = [2, 2]\nfloor_m = [@, 1]",
       "-1000000000", "1000000000"}};
  for (const std::string model : {"perspective", "fisheye", "unified"}) {
    const std::string head =
        "model = \"" + model + "\"\n" + (model == "unified" ? "xi = 1\n" : "") + size;
    all.push_back({head + "focal_px = [@, 50]", "1", "1000000"});
    all.push_back({head + "focal_px = [50, 50]\ndistortion = [@, 0, 0, 0]", "-10000", "10000"});
  }
  for (const Limits& limits : all) {
    const auto isRefused = [&](const std::string& number) {
      std::string toml = limits.settings;
      toml.replace(toml.find('@'), 1, number);
      try {
        cameraOf(toml + "\n");
      } catch (const ConfigError& error) {
        return std::string(error.what())
                   .find("must be in [" + limits.low + ", " + limits.high + "]") !=
               std::string::npos;
      }
      return false;
    };
    EXPECT_FALSE(isRefused(limits.low)) << limits.settings;
    EXPECT_FALSE(isRefused(limits.high)) << limits.settings;
    EXPECT_TRUE(isRefused(std::to_string(std::stod(limits.low) - 0.005))) << limits.settings;
    EXPECT_TRUE(isRefused(std::to_string(std::stod(limits.high) + 0.005))) << limits.settings;
  }
}

// Whatever a calibration says, a camera is refused, or sees directions and pixels that are numbers.
TEST(CameraModel, TakesOrRefusesAbsurdNumbers) {
  const std::vector<std::string> absurd = {"nan",   "inf",   "-inf",   "0",   "-1",   "1e30",
                                           "-1e30", "1e300", "1e-300", "1e4", "-1e4", "1e6"};
  const std::string size = "size_px = [64, 48]\n";
  std::vector<std::string> cameras;
  for (const std::string& x : absurd) {
    const std::string focal = "focal_px = [" + x + ", 50]\n";
    const std::string four = "distortion = [" + x + ", 0, " + x + ", 0]\n";
    for (const char* model : {"perspective", "fisheye", "unified"}) {
      const std::string head = "model = \"" + std::string(model) + "\"\n" + size;
      const std::string xi = std::string(model) == "unified" ? "xi = 1\n" : "";
      cameras.push_back(head + xi + focal);
      cameras.push_back(head + xi + "focal_px = [50, 50]\n" + four);
      cameras.push_back(head + xi + "focal_px = [50, 50]\ncentre_px = [" + x + ", 0]\n");
      cameras.push_back(head + xi + "focal_px = [50, 50]\nouter_px = " + x + "\n");
    }
    cameras.push_back("model = \"unified\"\n" + size + "focal_px = [50, 50]\nxi = " + x + "\n");
    cameras.push_back("model = \"unified\"\n" + size +
                      "focal_px = [50, 50]\nxi = 1\nskew_px = " + x + "\n");
    cameras.push_back("model = \"ocam\"\n" + size + "polynomial = [" + x + "]\n");
    cameras.push_back("model = \"ocam\"\n" + size + "polynomial = [10, " + x + ", 0, " + x + "]\n");
    cameras.push_back("model = \"ocam\"\n" + size + "polynomial = [10]\naffine = [" + x +
                      ", 0, 0]\n");
    cameras.push_back("model = \"isometric\"\n" + size + "pixels_per_m = " + x +
                      "\nheight_m = 1\n");
    cameras.push_back("model = \"isometric\"\n" + size + "pixels_per_m = 50\nheight_m = " + x +
                      "\n");
    cameras.push_back("model = \"table\"\n" + size + "height_m = 1\ngrid = [2, 2]\nfloor_m = [" +
                      x + ", 1, 1, -1, -1, 1, -1, " + x + "]\n");
  }
  for (const std::string& toml : cameras) {
    std::shared_ptr<const CameraModel> camera;
    try {
      camera = cameraOf(toml);
    } catch (const ConfigError& error) {
      EXPECT_STRNE(error.what(), "") << toml;
      continue;
    }
    for (const double u : {0.0, 31.5, 63.0, 1e5, 1e300, -1e300})
      if (const auto ray = camera->unproject({u, 20.0}))
        EXPECT_NEAR(std::hypot(ray->x, ray->y, ray->z), 1.0, 1e-9) << toml << u;
    for (const double x : {0.0, 0.3, 1e5, 1e-300})
      if (const auto pixel = camera->project({x, 0.2, 1.0}))
        EXPECT_TRUE(std::isfinite(pixel->u) && std::isfinite(pixel->v)) << toml << x;
  }
}

}  // namespace
}  // namespace ortung
