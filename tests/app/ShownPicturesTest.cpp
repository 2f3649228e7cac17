#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <span>
#include <string>

#include "DecodedPng.hpp"
#include "Files.hpp"
#include "Learn.hpp"
#include "Palette.hpp"
#include "Show.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung::app {
namespace {

constexpr double kPostX = 1.5;
constexpr double kPostY = 0.8;
constexpr double kRange = 1.2;  // that the robot reads [m]
constexpr double kSigma = 0.3;  // of its ranges [m]
constexpr double kOutliers = 0.05;
constexpr Pose2 kTruth{4.0, 3.1, 0.5};

constexpr const char* kWorld = R"([world]
name = "plain"
x_m = [0, 6]
y_m = [0, 4]
[[landmark]]
kind = "post"
identity = 3
position_m = [1.5, 0.8]
)";

constexpr const char* kRobot = R"([robot]
name = "scout"
radius_m = 0.2
[[sensor]]
plugin = "landmarks"
model = "eye"
features = "list"
identities = [3]
range_sigma_m = 0.3
bearing_sigma_deg = 30
outliers = 0.05
[[sensor]]
plugin = "ground_truth"
)";

/// What `ortung show` draws, read back from the PNG file and compared with distances to one post
/// in a field of 6 m x 4 m, by hand.
class ShownPictures : public testing::Test {
 protected:
  ShownPictures() {
    test::writeBytes(folder_ / "plain.toml", kWorld);
    test::writeBytes(folder_ / "robot.toml", kRobot);
    quietly([&] {
      return runLearn({.world = folder_ / "plain.toml",
                       .robot = folder_ / "robot.toml",
                       .out = folder_ / "plain.ortung"});
    });
    RecordWriter record(folder_ / "run.rec");
    record.write({0, {"reference", "groundTruth", "pose"}, PoseData::encode(kTruth)});
    record.write({0, {"eye", "camera", "posts"}, {3, 1200, 18000 + 4000}});
    record.commit();
  }

  static std::string quietly(const std::function<int()>& run) {
    testing::internal::CaptureStdout();
    const int code = run();
    EXPECT_EQ(code, 0);
    return testing::internal::GetCapturedStdout();
  }

  ShowArguments arguments() const {
    ShowArguments arguments;
    arguments.tables = folder_ / "plain.ortung";
    arguments.robot = folder_ / "robot.toml";
    arguments.features = {"eye/*/*"};
    arguments.out = folder_ / "heat.png";
    return arguments;
  }

  DecodedPng shown(const ShowArguments& arguments) {
    printed_ = quietly([&] { return runShow(arguments); });
    const std::string png = test::readBytes(arguments.out);
    return DecodedPng(std::as_bytes(std::span(png)));
  }

  /// Compares every cell's colour with what it should be; marks may hide a few.
  static void expectColours(const DecodedPng& png,
                            const std::function<double(double x, double y)>& darkness) {
    const FoundField field(png);
    const int cell = field.width / 60;
    ASSERT_EQ(field.width, 60 * cell);
    ASSERT_EQ(field.height, 40 * cell);
    int hidden = 0;
    double worst = 0.0;
    for (int row = 0; row < 40; ++row) {
      for (int column = 0; column < 60; ++column) {
        const double found =
            darknessOf(png.at(field.left + column * cell + cell / 2,
                              field.top + field.height - 1 - row * cell - cell / 2));
        if (found < 0.0) {
          ++hidden;
          continue;
        }
        const double wanted = darkness(0.1 * column + 0.05, 0.1 * row + 0.05);
        worst = std::max(worst, std::abs(found - wanted));
      }
    }
    EXPECT_LT(worst, 0.02);
    EXPECT_LT(hidden, 60);
  }

  test::TemporaryFolder folder_;
  std::string printed_;
};

double distanceToPost(double x, double y) { return std::hypot(x - kPostX, y - kPostY); }

double probability(double x, double y) {
  const double residual = (distanceToPost(x, y) - kRange) / kSigma;
  return (1.0 - kOutliers) * std::exp(-0.5 * residual * residual) + kOutliers;
}

TEST_F(ShownPictures, ExpectationsAreTheDistancesThatTheyAre) {
  const DecodedPng png = shown(arguments());
  // The nearest and the farthest centres of cells end the scale.
  const double low = distanceToPost(1.45, 0.75);
  const double high = distanceToPost(5.95, 3.95);
  expectColours(png,
                [&](double x, double y) { return (distanceToPost(x, y) - low) / (high - low); });
}

TEST_F(ShownPictures, ProbabilitiesAreThoseOfTheSensorModel) {
  ShowArguments with = arguments();
  with.record = folder_ / "run.rec";
  with.scale = "linear";
  const DecodedPng png = shown(with);
  // The bearing is right at one of all headings that each cell has tried. Somewhere on the ring of
  // 1.2 m all but fits, and far away only the outliers are left.
  expectColours(png, [&](double x, double y) { return (probability(x, y) - kOutliers) / 0.95; });
  EXPECT_NE(printed_.find("each cell: the best of 180 headings"), std::string::npos) << printed_;
  EXPECT_NE(printed_.find("true pose: 4.000 m, 3.100 m, 28.6 deg"), std::string::npos) << printed_;
}

TEST_F(ShownPictures, ALogarithmicScaleIsThatOfTheLogarithms) {
  ShowArguments with = arguments();
  with.record = folder_ / "run.rec";
  with.scale = "log";
  const DecodedPng png = shown(with);
  expectColours(png, [&](double x, double y) {
    return std::log(probability(x, y) / kOutliers) / std::log(1.0 / kOutliers);
  });
}

TEST_F(ShownPictures, AGivenHeadingIsTheOnlyOneTried) {
  ShowArguments with = arguments();
  with.record = folder_ / "run.rec";
  with.scale = "linear";
  with.headingDeg = 30.0;
  const DecodedPng png = shown(with);
  const auto both = [](double x, double y) {
    const double seen = std::atan2(kPostY - y, kPostX - x) - 30.0 * M_PI / 180.0;
    const double off = std::remainder(seen - 40.0 * M_PI / 180.0, 2.0 * M_PI) / (M_PI / 6.0);
    return probability(x, y) * (0.95 * std::exp(-0.5 * off * off) + 0.05);
  };
  double low = 1.0;
  double high = 0.0;
  for (int i = 0; i < 2400; ++i) {
    const double p = both(0.1 * (i % 60) + 0.05, 0.1 * (i / 60) + 0.05);
    low = std::min(low, p);
    high = std::max(high, p);
  }
  expectColours(png, [&](double x, double y) { return (both(x, y) - low) / (high - low); });
  EXPECT_NE(printed_.find("heading 30 deg"), std::string::npos) << printed_;
}

TEST_F(ShownPictures, TheTruePoseAndLandmarksAreMarkedWhereTheyAre) {
  ShowArguments with = arguments();
  with.record = folder_ / "run.rec";
  const DecodedPng png = shown(with);
  const FoundField field(png);
  const double pixelsPerMetre = field.width / 6.0;
  double x = 0.0;
  double y = 0.0;
  int marked = 0;
  int posts = 0;
  for (int row = field.top; row < field.top + field.height; ++row) {
    for (int column = field.left; column < field.left + field.width; ++column) {
      const double inX = (column - field.left) / pixelsPerMetre;
      const double inY = (field.top + field.height - row) / pixelsPerMetre;
      if (png.is(column, row, palette::kLandmark)) {
        ++posts;
        EXPECT_LT(std::hypot(inX - kPostX, inY - kPostY), 0.15);
      }
      if (!png.is(column, row, palette::kTruth)) continue;
      x += inX;
      y += inY;
      ++marked;
    }
  }
  EXPECT_GT(posts, 20);
  ASSERT_GT(marked, 50);
  // The ring's middle, drawn a little towards the heading by its pointer.
  EXPECT_NEAR(x / marked, kTruth.x + 0.06, 0.06);
  EXPECT_NEAR(y / marked, kTruth.y + 0.03, 0.05);
}

}  // namespace
}  // namespace ortung::app
