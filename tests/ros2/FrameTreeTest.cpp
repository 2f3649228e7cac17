/// Poses of frames in others: chains by hand, and what of /tf counts.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "FrameTree.hpp"

namespace ortung::ros2 {
namespace {

const double kHalf = std::sqrt(0.5);
const Quaternion kQuarterLeft{0, 0, kHalf, kHalf};

TransformStamped at(const std::string& parent, const std::string& child, const Vector3& place,
                    const Quaternion& turn = {}) {
  return {{0, parent}, child, {place, turn}};
}

void expectPlace(const std::optional<Eigen::Isometry3d>& pose, double x, double y, double z) {
  ASSERT_TRUE(pose.has_value());
  EXPECT_NEAR(pose->translation().x(), x, 1e-9);
  EXPECT_NEAR(pose->translation().y(), y, 1e-9);
  EXPECT_NEAR(pose->translation().z(), z, 1e-9);
}

// base -> arm: 1 m ahead, turned to the left; arm -> laser: 2 m ahead of that, which is to the
// left.
TEST(FrameTree, ChainsTransforms) {
  FrameTree tree;
  tree.add(at("base", "arm", {1, 0, 0.5}, kQuarterLeft), true);
  tree.add(at("arm", "laser", {2, 0, 0.25}), true);
  const auto laser = tree.find("laser", "base");
  expectPlace(laser, 1, 2, 0.75);
  EXPECT_NEAR(std::atan2(laser->linear()(1, 0), laser->linear()(0, 0)), M_PI / 2, 1e-9);
  expectPlace(tree.find("base", "laser"), -2, 1, -0.75);
  expectPlace(tree.find("base", "base"), 0, 0, 0);
  EXPECT_EQ(tree.size(), 2u);
  EXPECT_TRUE(tree.hasFrame("arm"));
  EXPECT_FALSE(tree.hasFrame("base")) << "it is a parent only";
}

TEST(FrameTree, SiblingsAreFoundByTheirCommonParent) {
  FrameTree tree;
  tree.add(at("chassis", "base", {0, 0, 0.25}, kQuarterLeft), true);
  tree.add(at("chassis", "laser", {1, 0, 1}), true);
  expectPlace(tree.find("laser", "base"), 0, -1, 0.75);  // ahead of the chassis: right of the base
}

// Where the robot is in the world does not matter for where its sensors are on it.
TEST(FrameTree, TheRobotsOwnWayIsNoPartOfAMount) {
  FrameTree tree;
  tree.add(at("odom", "base", {5, 5, 0}), false);
  tree.add(at("base", "laser", {0.5, 0, 0}), true);
  expectPlace(tree.find("laser", "base"), 0.5, 0, 0);
  EXPECT_FALSE(tree.find("laser", "map"));
  EXPECT_FALSE(tree.find("camera", "base"));
}

// A scanner on a turntable, whose frame moves: its newest place counts, if no static one does.
TEST(FrameTree, MovingFramesAreTakenWhereStaticOnesDoNotLeadThere) {
  FrameTree tree;
  tree.add(at("base", "table", {0.1, 0, 0}), false);
  tree.add(at("base", "table", {0.2, 0, 0}), false);
  tree.add(at("table", "laser", {0.5, 0, 0}), true);
  expectPlace(tree.find("laser", "base"), 0.7, 0, 0);
  tree.add(at("base", "table", {0.3, 0, 0}), true);
  expectPlace(tree.find("laser", "base"), 0.8, 0, 0);
  tree.add(at("base", "table", {9, 0, 0}), false);  // static ones stay
  expectPlace(tree.find("laser", "base"), 0.8, 0, 0);
  tree.add(at("base", "table", {0.4, 0, 0}), true);  // but for newer static ones
  expectPlace(tree.find("laser", "base"), 0.9, 0, 0);
}

TEST(FrameTree, QuaternionsAreMadeOfLengthOne) {
  FrameTree tree;
  tree.add(at("base", "arm", {0, 0, 0}, {0, 0, 3 * kHalf, 3 * kHalf}), true);
  tree.add(at("arm", "laser", {2, 0, 0}), true);
  expectPlace(tree.find("laser", "base"), 0, 2, 0);
}

TEST(FrameTree, TransformsThatAreNoneAreIgnored) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  FrameTree tree;
  tree.add(at("a", "b", {nan, 0, 0}), true);
  tree.add(at("a", "b", {0, endless, 0}), true);
  tree.add(at("a", "b", {0, 0, 1.1e6}), true);
  tree.add(at("a", "b", {0, 0, 0}, {0, 0, 0, 0}), true);
  tree.add(at("a", "b", {0, 0, 0}, {0, 0, 0, 5e-4}), true);
  tree.add(at("a", "b", {0, 0, 0}, {nan, 0, 0, 1}), true);
  tree.add(at("a", "b", {0, 0, 0}, {endless, 0, 0, 1}), true);
  EXPECT_EQ(tree.size(), 0u);
  tree.add(at("a", "b", {0, 0, 0.9e6}), true);
  EXPECT_EQ(tree.size(), 1u);
}

TEST(FrameTree, CirclesAndCountlessFramesEnd) {
  FrameTree tree;
  tree.add(at("a", "b", {1, 0, 0}), true);
  tree.add(at("b", "a", {1, 0, 0}), true);
  EXPECT_FALSE(tree.find("a", "c"));
  for (int i = 0; i < 5000; ++i) tree.add(at("root", "f" + std::to_string(i), {0, 0, 0}), true);
  EXPECT_EQ(tree.size(), 4096u);
  tree.add(at("a", "b", {2, 0, 0}), true);  // those that are known may still change
  EXPECT_EQ(tree.size(), 4096u);
}

}  // namespace
}  // namespace ortung::ros2
