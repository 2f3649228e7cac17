#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "AllFormats.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/PoseFixData.hpp"

/// p(s | l) of a whole container (paper, section 5.2): for a set, at one pose, and where features
/// expect nothing.
namespace ortung {
namespace {

using test::batchOfOne;
using test::kPi;
using test::Room;

const Pose2 kNowhere{1e6, 1e6, 0.0};

/// Every format that weighs, each with a reading taken at one pose.
class Container {
 public:
  Container() {
    for (auto& feature : test::allFormats(room_, region_, mount_, pose_ * mount_))
      container_.add(std::move(feature));
    PointsData& points = add<PointsData>("points", PointsData::Config{.maxRange = 6.0});
    const std::vector<PointsData::Point> seen = {{2.0, 0.5}, {3.0, -1.0}};
    test::learnEverywhere(points, region_, kPi / 90, [&](const Pose2& sensor) {
      return PointsData::encode(
          std::vector<PointsData::Point>{{room_.range(sensor.x, sensor.y, sensor.theta), 0.0}});
    });
    points.setData(1, PointsData::encode(seen));
    PoseFixData& fix = add<PoseFixData>("fix", PoseFixData::Config{});
    fix.beginLearning(region_, kPi / 90);
    fix.endLearning();
    fix.setData(1, PoseFixData::encode(std::vector<PoseFixData::Fix>{
                       {pose_, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}}}));
  }
  const SensorContainer& operator*() const { return container_; }
  const SensorContainer* operator->() const { return &container_; }

 private:
  template <class T>
  T& add(const char* feature, const typename T::Config& config) {
    if constexpr (std::is_constructible_v<T, SensorId, Pose2, typename T::Config>)
      return static_cast<T&>(
          container_.add(std::make_unique<T>(SensorId{"M", "T", feature}, mount_, config)));
    else
      return static_cast<T&>(
          container_.add(std::make_unique<T>(SensorId{"M", "T", feature}, config)));
  }

  const Room room_;
  const FieldRegion region_ = room_.region(0.25, 0.2);
  const Pose2 mount_{0.12, -0.05, 0.4};
  const Pose2 pose_{0.6, 0.4, 0.7};
  SensorContainer container_;
};

const Container& learned() {
  static const Container container;  // learning takes its time
  return container;
}

Pose2 anyPose() {
  // On the field, beside it, far away.
  const int reach = *rc::gen::element(4, 8, 1000);
  return {*rc::gen::inRange(-1000 * reach, 1000 * reach) / 1000.0,
          *rc::gen::inRange(-1000 * reach, 1000 * reach) / 1000.0,
          *rc::gen::inRange(-9000, 9000) / 1000.0};
}

RC_GTEST_PROP(ContainerProduct, IsTheSameForAPoseAndForASetOfIt, ()) {
  const Pose2 pose = anyPose();
  const double sum = static_cast<double>(batchOfOne(*learned(), pose));
  const double product = learned()->getProbability(pose);
  RC_ASSERT(product >= 0.0);
  RC_ASSERT(product <= 1.0);
  RC_ASSERT(std::abs(std::log(product) - sum) <= 1e-5 * std::max(1.0, std::abs(sum)));
}

RC_GTEST_PROP(ContainerProduct, MultipliesEveryFeatureAndTheFloorOfThoseWithoutExpectation, ()) {
  const Pose2 pose = anyPose();
  double product = 1.0;
  for (const auto& feature : learned()->all()) {
    const Pose2 asSamplesHave{static_cast<float>(pose.x), static_cast<float>(pose.y),
                              static_cast<float>(pose.theta)};
    const double p = feature->getProbability(asSamplesHave);
    // What the feature gives where nobody can expect anything.
    const double floor = std::exp(static_cast<double>(batchOfOne(*feature, kNowhere)));
    RC_ASSERT(p == kNoExpectation || p >= 0.999 * floor);
    product *= p == kNoExpectation ? floor : std::exp(double(batchOfOne(*feature, pose)));
  }
  RC_ASSERT(std::abs(learned()->getProbability(pose) - product) <= 1e-5 * product);
}

TEST(ContainerProduct, APoseThatNobodyExpectsNeverBeatsABadOne) {
  const double nowhere = learned()->getProbability(kNowhere);
  EXPECT_GE(nowhere, 0.0) << "there are readings that speak, if not for this pose";
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const Pose2 pose{random.uniform(-6, 6), random.uniform(-4, 4), random.uniform(-4, 4)};
    ASSERT_GE(learned()->getProbability(pose), nowhere * (1 - 1e-5)) << pose.x << ' ' << pose.y;
  }
}

TEST(ContainerProduct, APoseOfOneBadFeatureDoesNotLoseAgainstOneThatTheFeatureDoesNotKnow) {
  // Two posts seen; at one pose the camera expects both and one is off, at the other nothing.
  SensorContainer container;
  const FieldRegion region = Room{}.region(0.25, 0.2);
  const auto addDistance = [&](const char* name, double postX, double reads) {
    SensorData& data = container.add(std::make_unique<ScalarData>(
        SensorId{"cam", "camera", name}, Pose2{},
        ScalarData::Config{.maxRange = 3.0, .model = {.sigma = 0.1, .outliers = 0.1}}));
    test::learnEverywhere(data, region, 0.1, [&](const Pose2& sensor) {
      return ScalarData::encode(std::hypot(postX - sensor.x, sensor.y));
    });
    data.setData(1, ScalarData::encode(reads));
  };
  addDistance("left", -1.0, 1.125);  // fits at (0.125, 0) ...
  addDistance("right", 3.5, 1.0);    // ... where the other one is out of its sight, at 3.375 m
  const Pose2 fitsLeft{0.125, 0.125, 0.0};
  const Pose2 fitsBothBadly{1.0, 0.125, 0.0};
  EXPECT_EQ(container.all()[1]->getProbability(fitsLeft), kNoExpectation);
  EXPECT_GE(container.all()[1]->getProbability(fitsBothBadly), 0.0999);
  // One feature's floor of 0.1 each: the fit decides, and nobody wins by what is not expected.
  EXPECT_NEAR(container.getProbability(fitsLeft), 0.1, 0.01);
  EXPECT_NEAR(container.getProbability(fitsBothBadly), 0.1 * 0.1, 0.001);
  EXPECT_NEAR(container.getProbability(kNowhere), 0.1 * 0.1, 1e-4);
}

TEST(ContainerProduct, HasNoExpectationOnlyIfNobodyCanWeigh) {
  SensorContainer container;
  EXPECT_EQ(container.getProbability({0, 0, 0}), kNoExpectation);
  container.add(std::make_unique<ScalarData>(SensorId{"cam", "camera", "unread"}, Pose2{},
                                             ScalarData::Config{}));
  EXPECT_EQ(container.getProbability({0, 0, 0}), kNoExpectation);
}

}  // namespace
}  // namespace ortung
