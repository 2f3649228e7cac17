#include <algorithm>
#include <cmath>
#include <set>

#include "BuildingFile.hpp"
#include "PrimitiveFile.hpp"
#include "ReadTables.hpp"
#include "WorldModel.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/FileKind.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/MapWorld.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMaxPrimitives = 65536;
constexpr std::size_t kMaxGrids = 16;
constexpr double kDefaultMarkHeight = 0.5;  ///< default height of a landmark [m]
constexpr Range kIdentity{0.0, 4294967295.0};
constexpr double kBallMass = 0.43;  ///< mass of a football of size 5 [kg]
constexpr std::size_t kMaxMovables = 256;

/// Reads a kind. An unknown kind is most likely misspelt, unless it is that of a landmark.
std::string readKind(const Parameters& table, bool hasIdentity) {
  static constexpr std::array kKinds{"wall", "goal",  "post",     "line",
                                     "ball", "crate", "obstacle", "other"};
  const std::string kind = table.textOr("kind", "obstacle");
  const bool known = std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end();
  if (known || (hasIdentity && isWord(kind))) return kind;
  std::string choices;
  for (const char* choice : kKinds) choices += (choices.empty() ? "" : ", ") + std::string(choice);
  table.fail("kind", "is \"" + kind + "\", expected one of " + choices +
                         "; only a landmark (with an identity) may be of another kind, of "
                         "[A-Za-z0-9_-]{1,64}");
}

/// Reads whether a primitive is movable, and its mass. By default balls and crates are movable.
void readMechanics(const Parameters& table, Primitive& primitive) {
  if (table.has("friction")) primitive.friction = table.number("friction", {0.0, 10.0});
  if (table.has("restitution")) primitive.restitution = table.number("restitution", {0.0, 1.0});
  const bool isBall = primitive.kind == "ball";
  primitive.isMovable = table.flagOr("movable", isBall || primitive.kind == "crate");
  if (!primitive.isMovable) {
    if (table.has("mass_kg")) table.fail("mass_kg", "does not fit something that is not movable");
    return;
  }
  if (primitive.identity)
    table.fail("identity", "does not fit something movable: landmarks must not move");
  if (!isBall && !table.has("mass_kg"))
    table.fail("mass_kg", "is missing; everything movable except a ball needs it");
  primitive.mass =
      isBall ? table.numberOr("mass_kg", kBallMass, kMass) : table.number("mass_kg", kMass);
}

void readCommon(const Parameters& table, Primitive& primitive) {
  primitive.name = table.textOr("name", "");
  checkPrintable(table, "name", primitive.name);
  if (table.has("identity"))
    primitive.identity = static_cast<std::uint32_t>(table.integer("identity", kIdentity));
  primitive.kind = readKind(table, primitive.identity.has_value());
  primitive.colour = readColour(table);
  if (!primitive.isSolid()) {
    if (table.has("z_m")) table.fail("z_m", "does not fit a line, which is flat");
    primitive.zHigh = 0.0;
    return;
  }
  readHeights(table, primitive);
  primitive.isNet = table.choiceOr("look", "solid", {"solid", "net"}) == "net";
  readMechanics(table, primitive);
}

Primitive readPrimitive(const Parameters& table, Primitive::Shape shape) {
  Primitive primitive;
  primitive.shape = shape;
  readCommon(table, primitive);
  readOutline(table, primitive);
  if (primitive.isSolid() || shape != Primitive::Shape::kEllipse) return primitive;
  // Circles and arcs painted on the floor.
  primitive.stroke = table.numberOr("stroke_m", 0.0, {0.0, 10.0});
  const auto arc = table.numbersOr("arc_deg", {0.0, 360.0}, 2, {-360.0, 720.0});
  if (!(arc[0] < arc[1] && arc[1] - arc[0] <= 360.0))
    table.fail("arc_deg", "must be [from, to] with from below to by at most 360");
  primitive.arcFrom = radians(arc[0]);
  primitive.arcTo = radians(arc[1]);
  return primitive;
}

GridBody readGrid(const Parameters& table, const std::filesystem::path& folder) {
  GridBody body;
  Primitive heights;
  readHeights(table, heights);
  body.zLow = heights.zLow;
  body.zHigh = heights.zHigh;
  const double margin = table.numberOr("unknown_margin_m", 0.5, {0.0, 100.0});
  const double depthInCells = table.numberOr("surface_depth_cells", 0.0, {0.0, 1.0});
  body.mapError = table.numberOr("map_error_m", 0.0, {0.0, 1.0});
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

void readBounds(const Parameters& file, const Parameters& table, WorldModel& world) {
  const std::optional<Box2> extent = extentOf(world);
  if (!extent) {
    for (const char* key : {"x_m", "y_m"})
      if (table.has(key)) table.numbers(key, 2, kCoordinate);
    file.refuseUnread();  // an unread table is most likely a misspelt [[rectangle]]
    throw ConfigError(file.where() +
                      ": the world is empty, expected at least one [[rectangle]], "
                      "[[ellipse]], [[triangle]], [[grid]] or [[landmark]]");
  }
  const Box2& box = *extent;
  if (!world.building.isEmpty()) {
    for (const char* key : {"x_m", "y_m"})
      if (table.has(key)) table.fail(key, "does not fit a building, whose floors tell its bounds");
  }
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

/// Returns what a world file would say that names nothing but a map.
Parameters worldOf(const std::filesystem::path& map) {
  Parameters grid(map.string());
  grid.set("map", map.filename().string());
  grid.set("surface_depth_cells", kMapSurfaceDepth);
  grid.set("map_error_m", kMapError);
  Parameters world(map.string());
  world.set("grid", Parameters::Node{Parameters::List{{grid}}});
  return world;
}

}  // namespace

WorldModel readWorldModel(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  const std::string name = file.stem().string();
  if (isGridMap(file)) return readWorldModel(worldOf(file), name, folder);
  const std::string other = whatItIs(file, {FileKind::kWorld, FileKind::kMotion});
  if (!other.empty()) throw ConfigError(file.string() + ": is no world file" + other);
  return readWorldModel(readToml(file), name, folder);
}

WorldModel readWorldModel(const Parameters& toml, const std::string& name,
                          const std::filesystem::path& folder) {
  const Parameters about = toml.table("world");
  WorldModel world;
  world.name = about.textOr("name", name);
  checkPrintable(about, "name", world.name);
  const std::array<std::pair<const char*, Primitive::Shape>, 3> shapes{
      {{"rectangle", Primitive::Shape::kRectangle},
       {"ellipse", Primitive::Shape::kEllipse},
       {"triangle", Primitive::Shape::kTriangle}}};
  BuildingFile building(toml);
  for (const auto& [key, shape] : shapes)
    for (const auto& table : readTables(toml, key, kMaxPrimitives))
      building.floorOf(table).primitives.push_back(readPrimitive(table, shape));
  for (const auto& table : readTables(toml, "landmark", kMaxPrimitives))
    building.floorOf(table).landmarks.push_back(readLandmark(table));
  const auto grids = readTables(toml, "grid", kMaxGrids);
  for (const auto& table : grids) building.floorOf(table).grids.push_back(readGrid(table, folder));
  for (std::size_t i = 0; i < building.tables().size(); ++i) {
    const Parameters& table = building.tables()[i];
    if (table.has("map")) building.floor(i).grids.push_back(readGrid(table, folder));
  }
  building.moveInto(world);
  const auto fixed = std::stable_partition(world.primitives.begin(), world.primitives.end(),
                                           [](const Primitive& p) { return !p.isMovable; });
  world.movables.assign(std::make_move_iterator(fixed),
                        std::make_move_iterator(world.primitives.end()));
  world.primitives.erase(fixed, world.primitives.end());
  if (world.movables.size() > kMaxMovables)
    throw ConfigError(toml.where() + ": " + std::to_string(world.movables.size()) +
                      " primitives are movable, expected at most 256");
  world.physics = PhysicsConfig::read(toml.table("physics"));
  addLandmarks(toml, world);
  readBounds(toml, about, world);
  toml.refuseUnread();
  return world;
}

}  // namespace ortung
