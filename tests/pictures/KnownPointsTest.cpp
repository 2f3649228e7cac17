#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "Snapshots.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::test {
namespace {

constexpr double kRadius = 0.15;  ///< of painted spots [m]

std::string spotAt(double x, double y) {
  std::ostringstream text;
  text << "[[ellipse]]\nkind = \"line\"\ncolour = \"white\"\ncenter_m = [" << x << ", " << y
       << "]\nsize_m = [" << 2 * kRadius << ", " << 2 * kRadius << "]\n";
  return text.str();
}

/// Spots all over the floor, far enough from one another.
std::vector<FloorPoint> places() {
  std::vector<FloorPoint> all;
  for (double x = -5.5; x <= 5.5; x += 0.9)
    for (double y = -5.5; y <= 5.5; y += 0.9)
      if (std::hypot(x, y) > 0.4) all.push_back({x, y});
  return all;
}

std::unique_ptr<SimWorld> spottedWorld() {
  std::string toml = "[world]\nx_m = [-40, 40]\ny_m = [-40, 40]\n";
  for (const FloorPoint& place : places()) toml += spotAt(place.x, place.y);
  return worldOf(toml);
}

constexpr int kRoom = 2;  ///< around a spot that is looked at [pixels]

struct Blob {
  double area = 0.0;  ///< [pixels]
  Pixel middle;
  double uLow = 1e9, uHigh = -1e9, vLow = 1e9, vHigh = -1e9;
};

/// Where the model says that a spot is: the outline, point by point, and the middle of its area.
std::optional<Blob> expectedAt(const CameraView& view, const FloorPoint& inSensor) {
  constexpr int kCorners = 90;
  std::vector<Pixel> outline;
  Blob blob;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = kTurn * i / kCorners;
    const auto pixel = view.pixelOf(
        {inSensor.x + kRadius * std::cos(angle), inSensor.y + kRadius * std::sin(angle), 0.0});
    if (!pixel) return std::nullopt;
    outline.push_back(*pixel);
    blob.uLow = std::min(blob.uLow, pixel->u);
    blob.uHigh = std::max(blob.uHigh, pixel->u);
    blob.vLow = std::min(blob.vLow, pixel->v);
    blob.vHigh = std::max(blob.vHigh, pixel->v);
  }
  for (int i = 0; i < kCorners; ++i) {
    const Pixel& a = outline[static_cast<std::size_t>(i)];
    const Pixel& b = outline[static_cast<std::size_t>((i + 1) % kCorners)];
    const double cross = a.u * b.v - b.u * a.v;
    blob.area += 0.5 * cross;
    blob.middle.u += (a.u + b.u) * cross / 6.0;
    blob.middle.v += (a.v + b.v) * cross / 6.0;
  }
  blob.middle.u /= blob.area;
  blob.middle.v /= blob.area;
  blob.area = std::abs(blob.area);
  return blob;
}

/// The white that is seen there: how much, and its middle.
Blob seenAt(Snapshot& picture, const Blob& where) {
  constexpr double kTurfRed = 26.0;
  Blob blob;
  for (int v = static_cast<int>(where.vLow) - kRoom; v <= static_cast<int>(where.vHigh) + kRoom + 1;
       ++v)
    for (int u = static_cast<int>(where.uLow) - kRoom;
         u <= static_cast<int>(where.uHigh) + kRoom + 1; ++u) {
      const double white = std::max((picture.at(u, v, 0) - kTurfRed) / (255.0 - kTurfRed), 0.0);
      blob.area += white;
      blob.middle.u += white * u;
      blob.middle.v += white * v;
    }
  blob.middle.u /= blob.area;
  blob.middle.v /= blob.area;
  return blob;
}

struct Errors {
  int spots = 0;
  double mean = 0.0;
  double worst = 0.0;
};

Errors errorsOf(const CameraView& view) {
  const auto world = spottedWorld();
  CameraPicture camera(view);
  const Pose2 sensor{0.3, -0.2, 0.7};
  Snapshot picture = snap(camera, *world, sensor);
  const ImageSize size = picture.size;
  std::vector<Blob> blobs;
  for (const FloorPoint& place : places()) {
    const Pose2 inSensor = inverse(sensor) * Pose2{place.x, place.y, 0.0};
    if (const auto blob = expectedAt(view, {inSensor.x, inSensor.y})) blobs.push_back(*blob);
  }
  Errors errors;
  for (const Blob& expected : blobs) {
    const auto isNear = [&](const Blob& other) {
      return &other != &expected && other.uLow < expected.uHigh + 2 * kRoom &&
             other.uHigh > expected.uLow - 2 * kRoom && other.vLow < expected.vHigh + 2 * kRoom &&
             other.vHigh > expected.vLow - 2 * kRoom;
    };
    if (expected.area < 8.0 || expected.uLow < 6 || expected.vLow < 6 ||
        expected.uHigh > size.width - 7 || expected.vHigh > size.height - 7 ||
        std::any_of(blobs.begin(), blobs.end(), isNear))
      continue;
    const Blob seen = seenAt(picture, expected);
    const double error =
        std::hypot(seen.middle.u - expected.middle.u, seen.middle.v - expected.middle.v);
    EXPECT_NEAR(seen.area, expected.area, 0.15 * expected.area + 2.0)  // thin ones count more
        << "at " << expected.middle.u << ", " << expected.middle.v << " seen " << seen.middle.u
        << ", " << seen.middle.v;
    ++errors.spots;
    errors.mean += error;
    errors.worst = std::max(errors.worst, error);
  }
  errors.mean /= std::max(errors.spots, 1);
  ::testing::Test::RecordProperty("spots", errors.spots);
  ::testing::Test::RecordProperty("worst_px", std::to_string(errors.worst));
  std::cout << "  " << errors.spots << " spots, mean " << errors.mean << " px, worst "
            << errors.worst << " px\n";
  return errors;
}

void expectWithin(const CameraView& view, int spots, double mean, double worst) {
  const Errors errors = errorsOf(view);
  EXPECT_GE(errors.spots, spots);
  EXPECT_LT(errors.mean, mean);
  EXPECT_LT(errors.worst, worst);
}

constexpr const char* kPlain =
    "model = \"perspective\"\nsize_px = [640, 480]\nfocal_px = [420.0, 425.0]\n"
    "centre_px = [322.5, 236.25]\n";

TEST(KnownPoints, AreWhereAPerspectiveCameraHasThem) {
  const CameraView view = viewOf(kPlain, 0.7, radians(20.0));
  EXPECT_TRUE(CameraSheet(view.model()).isPicture());  // drawn directly
  expectWithin(view, 20, 0.05, 0.2);
}

TEST(KnownPoints, AreWhereACameraThatIsRolledHasThem) {
  expectWithin(viewOf(kPlain, 1.1, radians(35.0), radians(20.0)), 20, 0.05, 0.2);
}

TEST(KnownPoints, AreWhereADistortedLensHasThem) {
  expectWithin(viewOf(kPerspective, 0.7, radians(25.0)), 15, 0.1, 0.3);
}

TEST(KnownPoints, AreWhereAFisheyeHasThem) {
  expectWithin(viewOf(kFisheye, 0.75, radians(30.0)), 15, 0.1, 0.3);
}

TEST(KnownPoints, AreWhereAMirrorHasThem) {
  expectWithin(viewOf(kUnified, 0.7, radians(90.0)), 40, 0.1, 0.3);
}

TEST(KnownPoints, AreWhereAPolynomialHasThem) {
  expectWithin(viewOf(kOcam, 0.8, radians(90.0)), 60, 0.1, 0.3);
}

/// A mirror of which nothing is known but the floor that it shows: the farther, the more of it.
TEST(KnownPoints, AreWhereATableHasThem) {
  std::ostringstream toml;
  toml << "model = \"table\"\nsize_px = [401, 401]\nheight_m = 0.7\ngrid = [81, 81]\nfloor_m = [";
  for (int row = 0; row <= 80; ++row)
    for (int column = 0; column <= 80; ++column) {
      const double right = (column - 40) / 40.0;
      const double up = (40 - row) / 40.0;
      const double stretched = 1.5 + 3.0 * (right * right + up * up);
      toml << (row + column == 0 ? "" : ", ") << up * stretched << ", " << -right * stretched;
    }
  toml << "]\n";
  expectWithin(viewOf(toml.str(), 0.7, radians(90.0)), 40, 0.15, 0.5);
}

/// The floor's points in closed form, without the model.
TEST(KnownPoints, AppearToScaleAllOverTheFloorInAnIsometricMirror) {
  const auto world = spottedWorld();
  CameraPicture camera(viewOf(kIsometric, 0.7, radians(90.0)));
  Snapshot picture = snap(camera, *world, {0.113, -0.071, 0.0});
  constexpr double kScale = 40.0;  ///< [pixels a metre]
  constexpr double kMiddle = 239.5;
  double worst = 0.0;
  for (const FloorPoint& place : places()) {
    Blob expected;
    expected.middle = {kMiddle - kScale * (place.y + 0.071), kMiddle - kScale * (place.x - 0.113)};
    expected.uLow = expected.middle.u - kScale * kRadius;
    expected.uHigh = expected.middle.u + kScale * kRadius;
    expected.vLow = expected.middle.v - kScale * kRadius;
    expected.vHigh = expected.middle.v + kScale * kRadius;
    if (expected.uLow < 5 || expected.vLow < 5 || expected.uHigh > 474 || expected.vHigh > 474)
      continue;
    const Blob seen = seenAt(picture, expected);
    // pi r^2: a circle of 6 pixels everywhere.
    EXPECT_NEAR(seen.area, 113.1, 5.0) << place.x << ", " << place.y;
    worst = std::max(
        worst, std::hypot(seen.middle.u - expected.middle.u, seen.middle.v - expected.middle.v));
  }
  std::cout << "  worst " << worst << " px\n";
  EXPECT_LT(worst, 0.5);
}

}  // namespace
}  // namespace ortung::test
