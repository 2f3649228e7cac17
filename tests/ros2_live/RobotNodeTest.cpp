/// Names of a robot's topics in namespaces, and what is offered of what a board describes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "RobotNode.hpp"

namespace ortung::ros2 {
namespace {

const BoardText kBoard{
    {"odometry/odometry/pose of wheels", "format odometry/odometry/pose odometry",
     "laser/LRF/front 3 ranges",
     "format laser/LRF/front scan beams=3 first_deg=-90 step_deg=90 max_m=5",
     "mount laser/LRF/front x_m=0.1 y_m=0 theta_rad=0"},
    {"world=hall kind=simulation fingerprint=1 x_min_m=0 y_min_m=0 x_max_m=4 y_max_m=3"},
    {"wall x0_m=0 y0_m=0 x1_m=4 y1_m=0 z0_m=0 z1_m=1"}};

class RobotNodeTest : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "Fast DDS 2.9 frees memory as another type than it was, and knows no sanitizer";
#endif
  }
  static std::vector<std::string> topics(const RobotNode::Options& options) {
    Participant::Options node;
    node.isLocal = true;
    node.domain = 1 + static_cast<std::uint32_t>(getpid()) % 40;
    Participant participant(node);
    std::vector<std::string> names = RobotNode(options, kBoard, participant).topics();
    std::sort(names.begin(), names.end());
    return names;
  }
};
using Names = std::vector<std::string>;

TEST_F(RobotNodeTest, OffersWhatTheRobotHas) {
  EXPECT_EQ(topics({}), (Names{"map", "odom", "scan", "tf", "tf_static"}));
  EXPECT_EQ(topics({.tellsTruth = true, .tellsMap = false}),
            (Names{"ground_truth", "odom", "scan", "tf", "tf_static"}));
}

TEST_F(RobotNodeTest, OffersTheFeaturesThatAreAskedFor) {
  EXPECT_EQ(topics({.features = {"laser/*/*"}, .tellsMap = false}),
            (Names{"scan", "tf", "tf_static"}));
  EXPECT_THROW(topics({.features = {"laser"}}), std::invalid_argument);
}

TEST_F(RobotNodeTest, SharesFramesOnlyWhereTheirNamesTellRobotsApart) {
  EXPECT_EQ(topics({.framePrefix = "a/"}), (Names{"/map", "/tf", "/tf_static", "odom", "scan"}));
}

}  // namespace
}  // namespace ortung::ros2
