#include <gtest/gtest.h>

#include <cmath>

#include "MadeSource.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung::test {
namespace {

const SensorId kPostsId{"omni", "camera", "posts"};

/// Lists of three landmarks within 10 m and half a turn.
class FalseSightings : public testing::Test {
 protected:
  FalseSightings() {
    LandmarksData::Config config{.identities = {4, 7, 9}, .maxRange = 10.0, .fieldOfView = M_PI};
    robot.container.add(std::make_unique<LandmarksData>(kPostsId, Pose2{}, config));
    for (int i = 0; i < 2000; ++i)
      messages.push_back({i * 100'000, kPostsId, LandmarksData::encode({{1, 30, 3}, {2, 30, 3}})});
  }
  MadeRobot robot;
  std::vector<Message> messages;
};

TEST_F(FalseSightings, AreUniformOverLandmarksRangesAndTheFieldOfView) {
  double changed = 0.0;
  double known[3] = {};
  double range = 0.0;
  double bearing = 0.0;
  for (const Message& m : robot.disturb(messages, {"readings=random:0.5"}, 3)) {
    ASSERT_EQ(m.words.size(), 6u);
    for (std::size_t k = 0; k < 6; k += 3) {
      if (m.words[k] < 4) {
        EXPECT_EQ(m.words[k], 1 + k / 3) << "what is not hit stays";
        EXPECT_EQ(m.words[k + 1], 30000u);
        continue;
      }
      changed += 1.0;
      ASSERT_TRUE(m.words[k] == 4 || m.words[k] == 7 || m.words[k] == 9);
      known[m.words[k] == 4 ? 0 : m.words[k] == 7 ? 1 : 2] += 1.0;
      EXPECT_LE(m.words[k + 1], 10000u);
      EXPECT_LE(std::abs(words::toAngle(m.words[k + 2])), M_PI / 2 + 1e-3);
      range += words::toMetres(m.words[k + 1]);
      bearing += words::toAngle(m.words[k + 2]);
    }
  }
  EXPECT_NEAR(changed / 4000, 0.5, 0.032);  // 4 sigma each
  for (const double count : known) EXPECT_NEAR(count / changed, 1.0 / 3, 0.043);
  EXPECT_NEAR(range / changed, 5.0, 0.26);
  EXPECT_NEAR(bearing / changed, 0.0, 0.082);
}

TEST_F(FalseSightings, AreTheSameForTheSameSeedAndOnlyWhileTheFaultIs) {
  const auto given = robot.disturb(messages, {"omni/camera/posts=random:1@50-100"}, 3);
  EXPECT_EQ(given, robot.disturb(messages, {"omni/camera/posts=random:1@50-100"}, 3));
  EXPECT_EQ(given[499], messages[499]);
  EXPECT_NE(given[500], messages[500]);
  EXPECT_EQ(given[1000], messages[1000]);
}

}  // namespace
}  // namespace ortung::test
