// A robot's geometry is what its file says, key by key (docs/simulation.md, docs/robots.md).
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/RobotShape.hpp"

namespace ortung {
namespace {

using Shape = Primitive::Shape;

RobotShape shapeOf(const std::string& text) {
  return RobotShape::read(
      readRobot(parseToml("[[sensor]]\nplugin = \"odometry\"\n" + text, "robot.toml")));
}

TEST(RobotShape, WithoutAnyKeyIsACylinder) {
  const RobotShape shape = shapeOf("[robot]\nradius_m = 0.3\n");
  EXPECT_EQ(shape.height, 0.5);
  EXPECT_EQ(shape.colour, "");
  EXPECT_TRUE(shape.manipulators.empty());
  ASSERT_EQ(shape.pieces.size(), 1U);
  const Primitive& piece = shape.pieces[0];
  EXPECT_TRUE(piece.isCircle());
  EXPECT_EQ(piece.kind, "robot");
  EXPECT_EQ(piece.halfX, 0.3);
  EXPECT_EQ(piece.zLow, 0.0);
  EXPECT_EQ(piece.zHigh, 0.5);
  EXPECT_EQ(shape.parts(), 1U);
}

TEST(RobotShape, HasThePiecesOfItsFile) {
  const RobotShape shape = shapeOf(R"(
[robot]
name = "boxer"
colour = "blue"
mass_kg = 7.5
[drive]
body_height_m = 0.8
[[body]]
center_m = [0.1, -0.2]
size_m = [0.4, 0.3]
angle_deg = 90
colour = "red"
z_m = [0.1, 0.35]
friction = 0.25
restitution = 0.75
[[body]]
shape = "ellipse"
center_m = [-0.1, 0.2]
size_m = [0.2, 0.1]
[[body]]
shape = "triangle"
corners_m = [0.0, 0.0, 0.3, 0.0, 0.0, 0.6]
)");
  EXPECT_EQ(shape.name, "boxer");
  EXPECT_EQ(shape.colour, "blue");
  EXPECT_EQ(shape.mass, 7.5);
  EXPECT_EQ(shape.height, 0.8);
  ASSERT_EQ(shape.pieces.size(), 3U);
  const Primitive& box = shape.pieces[0];
  EXPECT_EQ(box.shape, Shape::kRectangle);
  EXPECT_EQ(box.colour, "red");
  EXPECT_EQ(box.centre.x, 0.1);
  EXPECT_EQ(box.centre.y, -0.2);
  EXPECT_EQ(box.halfX, 0.2);
  EXPECT_EQ(box.halfY, 0.15);
  EXPECT_NEAR(box.angle, std::numbers::pi / 2.0, 1e-12);
  EXPECT_EQ(box.zLow, 0.1);
  EXPECT_EQ(box.zHigh, 0.35);
  EXPECT_EQ(box.friction, 0.25);
  EXPECT_EQ(box.restitution, 0.75);
  const Primitive& egg = shape.pieces[1];
  EXPECT_EQ(egg.shape, Shape::kEllipse);
  EXPECT_EQ(egg.colour, "");
  EXPECT_EQ(egg.halfX, 0.1);
  EXPECT_EQ(egg.halfY, 0.05);
  EXPECT_FALSE(egg.friction || egg.restitution) << "those of the world";
  const Primitive& wedge = shape.pieces[2];
  EXPECT_EQ(wedge.shape, Shape::kTriangle);
  EXPECT_EQ(wedge.corners[2].y, 0.6);
  EXPECT_NEAR(wedge.centre.x, 0.1, 1e-12);
  EXPECT_NEAR(wedge.centre.y, 0.2, 1e-12);
  for (const Primitive* one : {&egg, &wedge}) {
    EXPECT_EQ(one->kind, "robot");
    EXPECT_EQ(one->zLow, 0.0);
    EXPECT_EQ(one->zHigh, 0.8) << "body_height_m";
  }
  EXPECT_EQ(shape.top(), 0.8);
  EXPECT_EQ(shape.parts(), 1U + 8U + 1U);
}

TEST(RobotShape, HasThePiecesOfItsManipulatorsStates) {
  const RobotShape shape = shapeOf(R"(
[[body]]
center_m = [0, 0]
size_m = [0.4, 0.4]
[[manipulator]]
name = "kicker"
[[manipulator.state]]
name = "in"
[[manipulator.state]]
name = "out"
ball_speed_m_s = 4.5
direction_deg = -30
returns_after_s = 0.2
[[manipulator.state.body]]
center_m = [0.25, 0]
size_m = [0.1, 0.2]
z_m = [0.05, 0.9]
[[manipulator.state.body]]
shape = "ellipse"
center_m = [0.3, 0]
size_m = [0.1, 0.1]
[[manipulator]]
name = "flap"
[[manipulator.state]]
name = "open"
[[manipulator.state.body]]
center_m = [0, 0.25]
size_m = [0.2, 0.05]
)");
  ASSERT_EQ(shape.manipulators.size(), 2U);
  const Manipulator& kicker = shape.manipulators[0];
  EXPECT_EQ(kicker.name, "kicker");
  EXPECT_EQ(kicker.find("in"), 0U);
  EXPECT_EQ(kicker.find("out"), 1U);
  EXPECT_FALSE(kicker.find("open")) << "another one's";
  const ManipulatorState& in = kicker.states[0];
  EXPECT_TRUE(in.pieces.empty());
  EXPECT_EQ(in.ballSpeed, 0.0);
  EXPECT_EQ(in.direction, 0.0);
  EXPECT_FALSE(in.returnsAfter);
  const ManipulatorState& out = kicker.states[1];
  EXPECT_EQ(out.ballSpeed, 4.5);
  EXPECT_NEAR(out.direction, -std::numbers::pi / 6.0, 1e-12);
  EXPECT_EQ(out.returnsAfter, 0.2);
  ASSERT_EQ(out.pieces.size(), 2U);
  EXPECT_EQ(out.pieces[0].zLow, 0.05);
  EXPECT_EQ(out.pieces[0].zHigh, 0.9);
  EXPECT_EQ(out.pieces[1].zHigh, 0.5) << "the robot's";
  EXPECT_EQ(shape.top(), 0.9) << "of any state";
  EXPECT_EQ(shape.parts(), 1U + 2U + 1U) << "of those with the most";
  const std::size_t atFirst[] = {0, 0};
  const std::size_t kicking[] = {1, 0};
  EXPECT_EQ(shape.piecesWith(atFirst).size(), 2U);
  const std::vector<Primitive> all = shape.piecesWith(kicking);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].centre.x, 0.0) << "the body's come first";
  EXPECT_EQ(all[1].centre.x, 0.25);
  EXPECT_EQ(all[2].centre.x, 0.3);
  EXPECT_EQ(all[3].centre.y, 0.25) << "in the manipulators' order";
}

TEST(RobotShape, OfStatesThatMakeNoSenseIsRefused) {
  const std::string arm = "[[manipulator]]\nname = \"arm\"\n";
  const auto state = [](const std::string& name) {
    return "[[manipulator.state]]\nname = \"" + name + "\"\n";
  };
  const std::pair<std::string, std::string> wrong[] = {
      {arm, "is there 0 times, expected 1 to 16"},
      {arm + state("in") + state("in"), "is given twice: in"},
      {arm + state("in") + arm + state("in"), "is given twice: arm"},
      {arm + state("a b"), "is \"a b\", expected [A-Za-z0-9_-]{1,64}"},
      {arm + state("in") + "returns_after_s = 1\n",
       "has returns_after_s in its first state, which the others return to"},
      {arm + state("in") + "ball_speed_m_s = 1\n",
       "needs a [[manipulator.state.body]] that reaches the ball"},
      {"[[body]]\nshape = \"star\"\ncenter_m = [0, 0]\nsize_m = [1, 1]\n", "star"}};
  for (const auto& [text, why] : wrong) {
    try {
      shapeOf(text);
      ADD_FAILURE() << "was taken: " << text;
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace ortung
