#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "FakeRoom.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/ScanData.hpp"

// What is read without noise fits the pose where it was read, wherever in a cell and between the
// table's directions that is, and fits the less the farther a pose is from there.
namespace ortung {
namespace {

using test::kPi;
using Words = std::vector<std::uint32_t>;

constexpr double kSigma = 0.02;  ///< much less than the tables' cells [m]
constexpr int kPoses = 400;

class TruePose : public ::testing::Test {
 protected:
  /// Has a feature learn the room with cells of 0.1 m and directions of 2 degrees.
  void learn(SensorData& data, const std::function<Words(const Pose2&)>& words) {
    test::learnEverywhere(data, region_, kPi / 90, words);
  }
  /// Returns p at poses that are @p away from those where the reading was made, in rising order.
  std::vector<double> probabilities(SensorData& data,
                                    const std::function<Words(const Pose2&)>& words, double away) {
    Random random(5);
    std::vector<double> p;
    while (p.size() < kPoses) {
      const Pose2 pose{room_.width * (random.uniform() - 0.5),
                       room_.height * (random.uniform() - 0.5), 2 * kPi * random.uniform()};
      const double towards = 2 * kPi * random.uniform();
      const Pose2 other{pose.x + away * std::cos(towards), pose.y + away * std::sin(towards),
                        pose.theta};
      if (!room_.contains(pose.x, pose.y, 0.1) || !room_.contains(other.x, other.y, 0.1)) continue;
      data.setData(1, words(pose));
      p.push_back(data.getProbability(other));
    }
    std::sort(p.begin(), p.end());
    return p;
  }
  static double share(const std::vector<double>& p, double quantile) {
    return p[static_cast<std::size_t>(quantile * (static_cast<double>(p.size()) - 1))];
  }

  const test::Room room_;
  const FieldRegion region_ = room_.region(0.1, 0.2);
};

TEST_F(TruePose, OfACone) {
  ConeData data({"M", "T", "F"}, {},
                {.maxRange = 10.0, .model = {.sigma = kSigma, .sigmaPerMetre = 0.0}});
  const auto words = [&](const Pose2& s) {
    double nearest = 10.0;
    for (double off = -kPi / 18; off <= kPi / 18; off += kPi / 360)
      nearest = std::min(nearest, room_.range(s.x, s.y, s.theta + off));
    return Words{ConeData::encode(nearest, 10.0)};
  };
  learn(data, words);
  const std::vector<double> there = probabilities(data, words, 0.0);
  EXPECT_GT(share(there, 0.5), 0.97);
  EXPECT_GT(share(there, 0.05), 0.7);
  EXPECT_LT(share(probabilities(data, words, 0.1), 0.5), 0.5);
}

TEST_F(TruePose, OfAScan) {
  const ScanData::Config config{.beams = 180,
                                .firstAngle = -kPi / 2,
                                .angleStep = kPi / 180,
                                .maxRange = 10.0,
                                .model = {.sigma = kSigma, .sigmaPerMetre = 0.0, .exponent = 0.06}};
  ScanData data({"M", "T", "F"}, {}, config);
  const auto words = [&](const Pose2& s) { return test::scanWords(room_, s, config); };
  learn(data, words);
  const std::vector<double> there = probabilities(data, words, 0.0);
  // Each of 91 beams is up to half a level off, and some hit the wall beyond a corner.
  EXPECT_GT(share(there, 0.5), 0.55);
  EXPECT_GT(share(there, 0.05), 0.35);
  EXPECT_LT(share(probabilities(data, words, 0.05), 0.5), 0.2);
  EXPECT_LT(share(probabilities(data, words, 0.1), 0.5), 0.05);
}

TEST_F(TruePose, ARunThatBeginsWithTheLastDirectionIsWhole) {
  // All around: every heading has a beam between the last direction and the first.
  const ScanData::Config config{.beams = 90,
                                .firstAngle = 0.0,
                                .angleStep = kPi / 45,
                                .maxRange = 10.0,
                                .model = {.sigma = kSigma, .exponent = 0.06}};
  ScanData data({"M", "T", "F"}, {}, config);
  const auto words = [&](const Pose2& s) { return test::scanWords(room_, s, config); };
  test::learnEverywhere(data, region_, kPi / 45, words);
  const double last = 89.5 * kPi / 45;  // between the last direction and the first
  for (const double theta : {last, last - kPi / 45, last - 2 * kPi, 0.0, kPi / 90}) {
    const Pose2 pose{0.55, -0.85, theta};
    data.setData(1, words(pose));
    const double p = data.getProbability(pose);
    EXPECT_GT(p, 0.5) << theta;
    // The same scan as seen by a robot that is turned by one beam, whose run begins elsewhere.
    Words turned = words(pose);
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    data.setData(2, turned);
    EXPECT_NEAR(data.getProbability({pose.x, pose.y, theta + kPi / 45}), p, 1e-6) << theta;
  }
}

}  // namespace
}  // namespace ortung
