#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "WorldModel.hpp"
#include "ortung/config/TomlFile.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMaxPrimitives = 65536;
constexpr std::size_t kMaxGrids = 16;
constexpr std::size_t kMaxNameLength = 64;
constexpr double kDefaultMarkHeight = 0.5;  ///< [m]
constexpr Range kCoordinate{-1e4, 1e4};     ///< [m]
constexpr Range kSize{0.001, 2e4};          ///< [m]
constexpr Range kHeight{-100.0, 1000.0};    ///< [m]
constexpr Range kAngle{-3600.0, 3600.0};    ///< [degree]
constexpr Range kIdentity{0.0, 4294967295.0};
constexpr Range kMass{0.001, 1e5};  ///< [kg]
constexpr double kBallMass = 0.43;  ///< of a football of size 5 [kg]
constexpr std::size_t kMaxMovables = 256;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

bool isWord(const std::string& text) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !text.empty() && text.size() <= kMaxNameLength &&
         std::all_of(text.begin(), text.end(), fits);
}

void checkPrintable(const Parameters& table, const std::string& key, const std::string& text) {
  const bool printable = std::none_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
  if (text.size() > kMaxNameLength || !printable)
    table.fail(key, "must be a text of at most 64 printable characters");
}

struct Heights {
  double low, high;  ///< [m]
};

Heights readHeights(const Parameters& table) {
  const auto z = table.numbersOr("z_m", {0.0, 1.0}, 2, kHeight);
  if (!(z[1] - z[0] >= kSize.low))
    table.fail("z_m", "must be [low, high] with high at least 0.001 m above low");
  return {z[0], z[1]};
}

/// A kind that nothing here knows is most likely misspelt, unless it is that of a landmark.
std::string readKind(const Parameters& table, bool hasIdentity) {
  static constexpr std::array kKinds{"wall", "goal", "post", "line", "ball", "obstacle", "other"};
  const std::string kind = table.textOr("kind", "obstacle");
  const bool known = std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end();
  if (known || (hasIdentity && isWord(kind))) return kind;
  std::string choices;
  for (const char* choice : kKinds) choices += (choices.empty() ? "" : ", ") + std::string(choice);
  table.fail("kind", "is \"" + kind + "\", expected one of " + choices +
                         "; only a landmark (with an identity) may be of another kind, of "
                         "[A-Za-z0-9_-]{1,64}");
}

/// A ball rolls unless the file says otherwise; all else stands unless it says so.
void readMechanics(const Parameters& table, Primitive& primitive) {
  if (table.has("friction")) primitive.friction = table.number("friction", {0.0, 10.0});
  if (table.has("restitution")) primitive.restitution = table.number("restitution", {0.0, 1.0});
  const bool isBall = primitive.kind == "ball";
  primitive.isMovable = table.flagOr("movable", isBall);
  if (!primitive.isMovable) {
    if (table.has("mass_kg")) table.fail("mass_kg", "does not fit what is not movable");
    return;
  }
  if (primitive.identity)
    table.fail("identity", "does not fit what is movable: landmarks stay where they are");
  if (!isBall && !table.has("mass_kg"))
    table.fail("mass_kg", "is missing, which everything movable needs but a ball");
  primitive.mass =
      isBall ? table.numberOr("mass_kg", kBallMass, kMass) : table.number("mass_kg", kMass);
}

void readCommon(const Parameters& table, Primitive& primitive) {
  primitive.name = table.textOr("name", "");
  checkPrintable(table, "name", primitive.name);
  if (table.has("identity"))
    primitive.identity = static_cast<std::uint32_t>(table.integer("identity", kIdentity));
  primitive.kind = readKind(table, primitive.identity.has_value());
  primitive.colour = table.textOr("colour", "");
  if (!primitive.colour.empty() &&
      !isWord(primitive.colour[0] == '#' ? primitive.colour.substr(1) : primitive.colour))
    table.fail("colour", "is \"" + primitive.colour + "\", expected a name or \"#rrggbb\"");
  if (!primitive.isSolid()) {
    if (table.has("z_m")) table.fail("z_m", "does not fit a line, which is flat");
    primitive.zHigh = 0.0;
    return;
  }
  const Heights z = readHeights(table);
  primitive.zLow = z.low;
  primitive.zHigh = z.high;
  readMechanics(table, primitive);
}

void readBox(const Parameters& table, Primitive& primitive) {
  const auto centre = table.numbers("center_m", 2, kCoordinate);
  const auto size = table.numbers("size_m", 2, kSize);
  primitive.centre = {centre[0], centre[1]};
  primitive.halfX = 0.5 * size[0];
  primitive.halfY = 0.5 * size[1];
  primitive.angle = radians(table.numberOr("angle_deg", 0.0, kAngle));
}

Primitive readRectangle(const Parameters& table) {
  Primitive rectangle;
  readCommon(table, rectangle);
  readBox(table, rectangle);
  return rectangle;
}

Primitive readEllipse(const Parameters& table) {
  Primitive ellipse;
  ellipse.shape = Primitive::Shape::ellipse;
  readCommon(table, ellipse);
  readBox(table, ellipse);
  if (ellipse.isSolid()) return ellipse;  // what follows is for circles painted on the floor
  ellipse.stroke = table.numberOr("stroke_m", 0.0, {0.0, 10.0});
  const auto arc = table.numbersOr("arc_deg", {0.0, 360.0}, 2, {-360.0, 720.0});
  if (!(arc[0] < arc[1] && arc[1] - arc[0] <= 360.0))
    table.fail("arc_deg", "must be [from, to] with from below to by at most 360");
  ellipse.arcFrom = radians(arc[0]);
  ellipse.arcTo = radians(arc[1]);
  return ellipse;
}

Primitive readTriangle(const Parameters& table) {
  Primitive triangle;
  triangle.shape = Primitive::Shape::triangle;
  readCommon(table, triangle);
  const auto c = table.numbers("corners_m", 6, kCoordinate);
  triangle.corners = {Point2{c[0], c[1]}, Point2{c[2], c[3]}, Point2{c[4], c[5]}};
  triangle.centre = {(c[0] + c[2] + c[4]) / 3.0, (c[1] + c[3] + c[5]) / 3.0};
  const double twiceArea = (c[2] - c[0]) * (c[5] - c[1]) - (c[4] - c[0]) * (c[3] - c[1]);
  if (std::abs(twiceArea) < kSize.low * kSize.low)
    table.fail("corners_m", "are on one line, expected x1, y1, x2, y2, x3, y3 of a triangle");
  return triangle;
}

GridBody readGrid(const Parameters& table, const std::filesystem::path& folder) {
  GridBody body;
  const Heights z = readHeights(table);
  body.zLow = z.low;
  body.zHigh = z.high;
  const double margin = table.numberOr("unknown_margin_m", 0.5, {0.0, 100.0});
  const double depthInCells = table.numberOr("surface_depth_cells", 0.0, {0.0, 1.0});
  checkPrintable(table, "name", table.textOr("name", ""));
  const std::string map = table.text("map");
  if (map.empty() || map.find('\0') != std::string::npos) table.fail("map", "names no file");
  try {
    body.map = readGridMap(folder / map);
  } catch (const MapError& error) {
    table.fail("map", error.what());
  }
  body.surfaceDepth = depthInCells * body.map.cell;
  markUnknownNearFree(body.map, margin);
  return body;
}

Landmark readLandmark(const Parameters& table) {
  Landmark mark;
  checkPrintable(table, "name", table.textOr("name", ""));
  mark.identity = static_cast<std::uint32_t>(table.integer("identity", kIdentity));
  mark.kind = table.text("kind");
  if (!isWord(mark.kind)) table.fail("kind", "must be of [A-Za-z0-9_-]{1,64}");
  const auto position = table.numbers("position_m", -1, kCoordinate);
  if (position.size() != 2 && position.size() != 3)
    table.fail("position_m", "must be [x, y] or [x, y, z]");
  mark.x = position[0];
  mark.y = position[1];
  mark.z = position.size() == 3 ? position[2] : kDefaultMarkHeight;
  return mark;
}

/// The tables of an array, unless there are too many.
std::vector<Parameters> readTables(const Parameters& file, const char* key, std::size_t most) {
  auto tables = file.tables(key);
  if (tables.size() > most)
    file.fail(key, "there are " + std::to_string(tables.size()) + ", expected at most " +
                       std::to_string(most));
  return tables;
}

class Extent {
 public:
  void add(const Box2& box) {
    if (isEmpty_) box_ = box;
    isEmpty_ = false;
    box_ = {std::min(box_.xLow, box.xLow), std::max(box_.xHigh, box.xHigh),
            std::min(box_.yLow, box.yLow), std::max(box_.yHigh, box.yHigh)};
  }
  bool isEmpty() const { return isEmpty_; }
  const Box2& box() const { return box_; }

 private:
  bool isEmpty_ = true;
  Box2 box_;
};

Extent extentOf(const WorldModel& world) {
  Extent extent;
  for (const Primitive& primitive : world.primitives) extent.add(boundsOf(primitive));
  for (const GridBody& body : world.grids) {
    const GridMap& map = body.map;
    extent.add({map.originX, map.originX + map.columns * map.cell, map.originY,
                map.originY + map.rows * map.cell});
  }
  for (const Landmark& mark : world.landmarks) extent.add({mark.x, mark.x, mark.y, mark.y});
  return extent;
}

void readBounds(const Parameters& file, const Parameters& table, WorldModel& world) {
  const Extent extent = extentOf(world);
  if (extent.isEmpty())
    throw ConfigError(file.where() +
                      ": the world is empty, expected at least one [[rectangle]], "
                      "[[ellipse]], [[triangle]], [[grid]] or [[landmark]]");
  const Box2& box = extent.box();
  const auto x = table.numbersOr("x_m", {box.xLow, box.xHigh}, 2, kCoordinate);
  const auto y = table.numbersOr("y_m", {box.yLow, box.yHigh}, 2, kCoordinate);
  if (!(x[1] - x[0] >= kSize.low)) table.fail("x_m", "must be [low, high] with low below high");
  if (!(y[1] - y[0] >= kSize.low)) table.fail("y_m", "must be [low, high] with low below high");
  world.bounds = {x[0], x[1], y[0], y[1]};
}

void addLandmarks(const Parameters& file, WorldModel& world) {
  for (const Primitive& primitive : world.primitives) {
    if (!primitive.identity) continue;
    world.landmarks.push_back({*primitive.identity, primitive.kind, primitive.centre.x,
                               primitive.centre.y, 0.5 * (primitive.zLow + primitive.zHigh)});
  }
  std::set<std::pair<std::string, std::uint32_t>> seen;
  for (const Landmark& mark : world.landmarks)
    if (!seen.emplace(mark.kind, mark.identity).second)
      throw ConfigError(file.where() + ": two landmarks are " + mark.kind + " " +
                        std::to_string(mark.identity) + ", expected one of each kind and identity");
  std::sort(world.landmarks.begin(), world.landmarks.end(), [](const auto& a, const auto& b) {
    return std::tie(a.kind, a.identity) < std::tie(b.kind, b.identity);
  });
}

}  // namespace

WorldModel readWorldModel(const std::filesystem::path& file) {
  const Parameters toml = readToml(file);
  const Parameters about = toml.table("world");
  WorldModel world;
  world.name = about.textOr("name", file.stem().string());
  checkPrintable(about, "name", world.name);
  for (const auto& table : readTables(toml, "rectangle", kMaxPrimitives))
    world.primitives.push_back(readRectangle(table));
  for (const auto& table : readTables(toml, "ellipse", kMaxPrimitives))
    world.primitives.push_back(readEllipse(table));
  for (const auto& table : readTables(toml, "triangle", kMaxPrimitives))
    world.primitives.push_back(readTriangle(table));
  for (const auto& table : readTables(toml, "landmark", kMaxPrimitives))
    world.landmarks.push_back(readLandmark(table));
  const auto grids = readTables(toml, "grid", kMaxGrids);
  for (const auto& table : grids) world.grids.push_back(readGrid(table, file.parent_path()));
  const auto fixed = std::stable_partition(world.primitives.begin(), world.primitives.end(),
                                           [](const Primitive& p) { return !p.isMovable; });
  world.movables.assign(std::make_move_iterator(fixed),
                        std::make_move_iterator(world.primitives.end()));
  world.primitives.erase(fixed, world.primitives.end());
  if (world.movables.size() > kMaxMovables)
    throw ConfigError(file.string() + ": " + std::to_string(world.movables.size()) +
                      " primitives are movable, expected at most 256");
  world.physics = PhysicsConfig::read(toml.table("physics"));
  addLandmarks(toml, world);
  readBounds(toml, about, world);
  toml.refuseUnread();
  return world;
}

}  // namespace ortung
