#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "WorldModel.hpp"

namespace ortung {
namespace {

/// FNV-1a, 64 bits.
class Fnv {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) addByte(static_cast<std::uint8_t>(c));
  }
  void addByte(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001b3u; }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

std::string hex(std::uint64_t value) {
  std::string digits(16, '0');
  for (std::size_t i = 16; i-- > 0; value >>= 4) digits[i] = "0123456789abcdef"[value & 15u];
  return digits;
}

/// Words separated by blanks; numbers as whole millionths.
class Line {
 public:
  explicit Line(const char* what) : text_(what) {}
  Line& add(double value) {
    text_ += " " + std::to_string(std::llround(value * 1e6));
    return *this;
  }
  Line& add(const std::string& word) {
    text_ += " " + std::to_string(word.size()) + ":" + word;
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string describe(const Primitive& primitive) {
  static constexpr std::array kNames{"rectangle", "ellipse", "triangle"};
  Line line(kNames[static_cast<std::size_t>(primitive.shape)]);
  line.add(primitive.kind).add(primitive.colour);
  line.add(primitive.identity ? std::to_string(*primitive.identity) : "");
  line.add(primitive.zLow).add(primitive.zHigh);
  if (primitive.shape == Primitive::Shape::kTriangle) {
    for (const Point2& corner : primitive.corners) line.add(corner.x).add(corner.y);
    return line.text();
  }
  line.add(primitive.centre.x).add(primitive.centre.y).add(primitive.halfX).add(primitive.halfY);
  line.add(primitive.angle).add(primitive.stroke).add(primitive.arcFrom).add(primitive.arcTo);
  return line.text();
}

std::string describe(const GridBody& body) {
  Fnv cells;
  for (const GridCell cell : body.map.cells) cells.addByte(static_cast<std::uint8_t>(cell));
  Line line("grid");
  line.add(body.map.columns).add(body.map.rows).add(body.map.cell);
  line.add(body.map.originX).add(body.map.originY).add(body.zLow).add(body.zHigh);
  if (body.map.isTurned()) line.add("turned").add(body.map.yaw);
  if (body.surfaceDepth > 0.0) line.add(body.surfaceDepth);
  if (body.mapError > 0.0) line.add("error").add(body.mapError);
  return line.add(hex(cells.hash())).text();
}

std::string describe(const Landmark& mark) {
  return Line("landmark")
      .add(mark.kind)
      .add(std::to_string(mark.identity))
      .add(mark.x)
      .add(mark.y)
      .add(mark.z)
      .text();
}

}  // namespace

std::string fingerprintOf(const WorldModel& world) {
  std::vector<std::string> lines;
  for (const Primitive& primitive : world.primitives) lines.push_back(describe(primitive));
  for (const GridBody& body : world.grids) lines.push_back(describe(body));
  for (const Landmark& mark : world.landmarks) lines.push_back(describe(mark));
  const Box2& box = world.bounds;
  lines.push_back(Line("bounds").add(box.xLow).add(box.xHigh).add(box.yLow).add(box.yHigh).text());
  for (const Floor& floor : world.building.floors)
    lines.push_back(
        Line("floor").add(floor.name).add(floor.shift).add(floor.xLow).add(floor.xHigh).text());
  for (const Lift& lift : world.building.lifts) {
    Line line("lift");
    line.add(lift.radius);
    for (const LiftStop& stop : lift.stops)
      line.add(stop.pose.x).add(stop.pose.y).add(stop.pose.theta);
    lines.push_back(line.text());
  }
  std::sort(lines.begin(), lines.end());
  Fnv all;
  for (const std::string& line : lines) all.add(line + "\n");
  return hex(all.hash());
}

}  // namespace ortung
