// What a face of a drawing may show, against its edges by hand.
#include <gtest/gtest.h>

#include "FaceView.hpp"
#include "ortung/base/Random.hpp"

namespace ortung {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<double, 9>;

Vector times(const Matrix& m, const Vector& v) {
  return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
          m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}

/// A rotation, from a random quaternion.
Matrix anyTurn(Random& random) {
  double w = random.gaussian(), x = random.gaussian(), y = random.gaussian(), z = random.gaussian();
  const double n = std::sqrt(w * w + x * x + y * y + z * z);
  w /= n, x /= n, y /= n, z /= n;
  return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
          2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}

TEST(FaceView, SeesWhatIsBetweenItsEdgesAndSpheresThatReachInto) {
  Random random(11);
  int seen = 0;
  for (int i = 0; i < 2000; ++i) {
    const CameraPose camera{.axes = anyTurn(random)};
    SheetFace face;
    face.inCamera = anyTurn(random);
    face.left = random.uniform(-1.5, 0.5), face.right = face.left + random.uniform(0.1, 1.5);
    face.top = random.uniform(-1.5, 0.5), face.bottom = face.top + random.uniform(0.1, 1.5);
    const FaceView view(camera, face);
    const auto inField = [&](double x, double y, double z) {
      return times(camera.axes, times(face.inCamera, {x, y, z}));
    };
    const double z = random.uniform(0.5, 20.0), x = random.uniform(-1.5, 1.5) * z,
                 y = random.uniform(-1.5, 1.5) * z;
    const bool isInside =
        x > face.left * z && x < face.right * z && y > face.top * z && y < face.bottom * z;
    const Vector place = inField(x, y, z);
    EXPECT_EQ(view.sees(place[0], place[1], place[2], 0.0), isInside) << x << " " << y << " " << z;
    seen += isInside ? 1 : 0;
    // Behind the camera, where a point has the same place on the face's plane.
    EXPECT_FALSE(view.sees(-place[0], -place[1], -place[2], 0.0));
    // A sphere around any point that reaches a point in the middle of the face.
    const Vector middle =
        inField(0.5 * (face.left + face.right) * z, 0.5 * (face.top + face.bottom) * z, z);
    const double way = std::hypot(place[0] - middle[0], place[1] - middle[1], place[2] - middle[2]);
    EXPECT_TRUE(view.sees(place[0], place[1], place[2], 1.001 * way));
    // Straight behind the camera it must be larger than its distance, and to the side likewise.
    const Vector behind = inField(0, 0, -z);
    EXPECT_FALSE(view.sees(behind[0], behind[1], behind[2], 0.999 * z));
    const double slope = std::hypot(1.0, face.right);
    const Vector aside =
        inField(face.right + 2.0 * slope * slope, 0.5 * (face.top + face.bottom), 1);
    EXPECT_FALSE(view.sees(aside[0], aside[1], aside[2], 1.999 * slope)) << "2 slope from the edge";
  }
  EXPECT_GT(seen, 50);
}

TEST(FaceView, SeesASphereUntilItHasLeftTheView) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    CameraPose camera;
    camera.axes = anyTurn(random);
    SheetFace face;
    face.inCamera = anyTurn(random);
    face.left = random.uniform(-1.5, 0.3);
    face.right = face.left + random.uniform(0.1, 1.5);
    face.top = random.uniform(-1.5, 0.3);
    face.bottom = face.top + random.uniform(0.1, 1.5);
    const FaceView view(camera, face);
    const auto sees = [&](const Vector& p, double reach) {
      const Vector relative = times(camera.axes, times(face.inCamera, p));
      return view.sees(relative[0], relative[1], relative[2], reach);
    };
    const double depth = random.uniform(0.5, 5.0);
    const double x = random.uniform(face.left, face.right);
    const double y = random.uniform(face.top, face.bottom);
    EXPECT_TRUE(sees({depth * x, depth * y, depth}, 0.0)) << i;
    const double reach = random.uniform(0.0, 0.2);
    const auto expectBorder = [&](const Vector& border, const Vector& outwards) {
      const double length = std::hypot(outwards[0], outwards[1], outwards[2]);
      for (const auto& [share, isSeen] : {std::pair{0.999, true}, {1.001, false}}) {
        const double by = share * (reach + 1e-6) / length;
        EXPECT_EQ(sees({border[0] + by * outwards[0], border[1] + by * outwards[1],
                        border[2] + by * outwards[2]},
                       reach + 1e-6),
                  isSeen)
            << i << " " << share;
      }
    };
    expectBorder({depth * face.left, depth * y, depth}, {-1.0, 0.0, face.left});
    expectBorder({depth * face.right, depth * y, depth}, {1.0, 0.0, -face.right});
    expectBorder({depth * x, depth * face.top, depth}, {0.0, -1.0, face.top});
    expectBorder({depth * x, depth * face.bottom, depth}, {0.0, 1.0, -face.bottom});
    EXPECT_FALSE(sees({0.0, 0.0, -1.001 * reach - 1e-9}, reach)) << i << " behind";
    Vector within{};
    for (double& part : within) part = random.uniform(-0.5, 0.5) * reach;
    EXPECT_TRUE(sees(within, reach)) << i << " around the camera";
  }
}

}  // namespace
}  // namespace ortung
