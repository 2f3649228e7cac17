/// Clouds of megabytes, ten times a second: reading them takes no memory but for the first one.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>

#include "CloudMaker.hpp"
#include "CloudShape.hpp"
#include "CountedAllocations.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::ros2 {
namespace {

using testing::CloudForm;
using testing::cloudOf;
using testing::CloudPoint;

TEST(CloudShape, TakesNoMemoryAfterTheFirstCloud) {
  std::vector<CloudPoint> points;
  for (int i = 0; i < 20'000; ++i) {
    const double bearing = kTurn * i / 20'000;
    points.push_back({3 * std::cos(bearing), 3 * std::sin(bearing), 0.001 * (i % 500), 4e3 * i});
  }
  CloudForm form;
  form.fields.push_back({"t", 16, CloudForm::Field::kWord, 1});
  form.pointStep = 20;
  const std::string bytes = toCdr(cloudOf(points, form));
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.translation().z() = 0.5;
  CloudShape shape(CloudBand(), mount);
  SweepMotion motion;
  motion.velocity = {1.0, 0.0, 1.0};
  PointCloud cloud;
  std::string why;
  const auto take = [&] {
    const std::size_t before = allocations.load();
    const bool isRead = fromCdr(bytes, cloud, why);
    const auto layout = CloudLayout::of(cloud, why);
    const bool isTaken = isRead && layout && !shape.fit(*layout, motion, why).empty();
    const std::size_t taken = allocations.load() - before;
    EXPECT_TRUE(isTaken) << why;
    return taken;
  };
  EXPECT_GT(take(), 0u);  // the counter counts
  for (int i = 0; i < 3; ++i) EXPECT_EQ(take(), 0u);
}

}  // namespace
}  // namespace ortung::ros2
