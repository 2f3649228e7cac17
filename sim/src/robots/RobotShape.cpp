#include "ortung/sim/RobotShape.hpp"

#include <algorithm>
#include <numeric>

#include "PrimitiveFile.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostPieces = 64;
constexpr std::size_t kMostParts = 128;  ///< greatest number of convex parts at a time
constexpr std::size_t kMostManipulators = 16;
constexpr std::size_t kMostStates = 16;
constexpr Range kKickSpeed{0.0, 50.0};  ///< speed of a kicked ball [m/s]

Primitive readPiece(const Parameters& table, double height) {
  Primitive piece;
  const std::string shape =
      table.choiceOr("shape", "rectangle", {"rectangle", "ellipse", "triangle"});
  if (shape == "ellipse") piece.shape = Primitive::Shape::kEllipse;
  if (shape == "triangle") piece.shape = Primitive::Shape::kTriangle;
  piece.kind = "robot";
  piece.zHigh = height;
  piece.colour = readColour(table);
  readOutline(table, piece);
  readHeights(table, piece);
  if (table.has("friction")) piece.friction = table.number("friction", {0.0, 10.0});
  if (table.has("restitution")) piece.restitution = table.number("restitution", {0.0, 1.0});
  return piece;
}

std::vector<Primitive> readPieces(const std::vector<Parameters>& tables, double height) {
  std::vector<Primitive> pieces;
  for (const Parameters& table : tables) {
    if (pieces.size() == kMostPieces) table.fail("shape", "is one too many, expected at most 64");
    pieces.push_back(readPiece(table, height));
    table.refuseUnread();
  }
  return pieces;
}

std::string readWord(const Parameters& table) {
  const std::string name = table.text("name");
  if (!isWord(name)) table.fail("name", "is \"" + name + "\", expected [A-Za-z0-9_-]{1,64}");
  return name;
}

ManipulatorState readState(const Parameters& table, double height) {
  ManipulatorState state;
  state.name = readWord(table);
  state.pieces = readPieces(table.tables("body"), height);
  state.ballSpeed = table.numberOr("ball_speed_m_s", 0.0, kKickSpeed);
  state.direction = radians(table.numberOr("direction_deg", 0.0, {-360.0, 360.0}));
  if (table.has("returns_after_s"))
    state.returnsAfter = table.number("returns_after_s", {0.0, 3600.0});
  if (state.ballSpeed > 0.0 && state.pieces.empty())
    table.fail("ball_speed_m_s", "needs a [[manipulator.state.body]] that reaches the ball");
  table.refuseUnread();
  return state;
}

Manipulator readManipulator(const Parameters& table, double height) {
  Manipulator manipulator;
  manipulator.name = readWord(table);
  for (const Parameters& one : table.tables("state")) {
    ManipulatorState state = readState(one, height);
    if (manipulator.find(state.name)) one.fail("name", "is given twice: " + state.name);
    manipulator.states.push_back(std::move(state));
  }
  if (manipulator.states.empty() || manipulator.states.size() > kMostStates)
    table.fail("state", "is there " + std::to_string(manipulator.states.size()) +
                            " times, expected 1 to 16 [[manipulator.state]]");
  if (manipulator.states.front().returnsAfter)
    table.fail("state", "has returns_after_s in its first state, which the others return to");
  table.refuseUnread();
  return manipulator;
}

std::size_t partsOf(const std::vector<Primitive>& pieces) {
  std::size_t parts = 0;
  for (const Primitive& piece : pieces)
    parts += piece.shape == Primitive::Shape::kEllipse && !piece.isCircle() ? 8 : 1;
  return parts;
}

}  // namespace

std::optional<std::size_t> Manipulator::find(std::string_view state) const {
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i].name == state) return i;
  return std::nullopt;
}

RobotShape RobotShape::read(const RobotConfig& config) {
  RobotShape shape;
  shape.name = config.name;
  shape.mass = config.mass;
  shape.colour = readColour(config.about);
  shape.height = config.drive.numberOr("body_height_m", shape.height, {0.01, 10.0});
  shape.pieces = readPieces(config.body, shape.height);
  if (shape.pieces.empty()) {
    Primitive circle;
    circle.shape = Primitive::Shape::kEllipse;
    circle.kind = "robot";
    circle.halfX = circle.halfY = config.radius;
    circle.zHigh = shape.height;
    shape.pieces.push_back(circle);
  }
  if (shape.parts() > kMostParts)
    config.body.front().fail("shape", "is one of " + std::to_string(shape.parts()) +
                                          " pieces (an ellipse counts 8), expected at most " +
                                          std::to_string(kMostParts));
  for (const Parameters& table : config.manipulators) {
    Manipulator manipulator = readManipulator(table, shape.height);
    const auto same = std::find_if(shape.manipulators.begin(), shape.manipulators.end(),
                                   [&](const auto& m) { return m.name == manipulator.name; });
    if (same != shape.manipulators.end()) table.fail("name", "is given twice: " + same->name);
    if (shape.manipulators.size() == kMostManipulators)
      table.fail("name", "is one too many, expected at most 16 manipulators");
    shape.manipulators.push_back(std::move(manipulator));
    if (shape.parts() > kMostParts)
      table.fail("state", "brings the robot to " + std::to_string(shape.parts()) +
                              " pieces at a time (an ellipse counts 8), expected at most " +
                              std::to_string(kMostParts));
  }
  return shape;
}

std::size_t RobotShape::parts() const {
  std::size_t parts = partsOf(pieces);
  for (const Manipulator& manipulator : manipulators) {
    std::size_t most = 0;
    for (const ManipulatorState& state : manipulator.states)
      most = std::max(most, partsOf(state.pieces));
    parts += most;
  }
  return parts;
}

double RobotShape::top() const {
  double top = topOf(pieces);
  for (const Manipulator& manipulator : manipulators)
    for (const ManipulatorState& state : manipulator.states)
      top = std::max(top, topOf(state.pieces));
  return top;
}

RobotSize sizeOf(const RobotConfig& config) {
  return {config.radius, RobotShape::read(config).top()};
}

std::vector<Primitive> RobotShape::piecesWith(std::span<const std::size_t> states) const {
  std::vector<Primitive> all = pieces;
  for (std::size_t i = 0; i < manipulators.size(); ++i) {
    const std::vector<Primitive>& more = manipulators[i].states[states[i]].pieces;
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace ortung
