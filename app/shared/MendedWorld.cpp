#include "MendedWorld.hpp"

#include <fmt/format.h>

#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/MapWorld.hpp"

namespace ortung::app {
namespace {

bool isMovable(const Parameters& primitive) {
  const std::string kind = primitive.textOr("kind", "obstacle");
  return primitive.flagOr("movable", kind == "ball" || kind == "crate");
}

bool isInMap(const std::string& array, const Parameters& table) {
  if (array == "grid" || array == "landmark") return true;
  if (array != "rectangle" && array != "ellipse" && array != "triangle") return false;
  return table.textOr("kind", "obstacle") != "line" && !isMovable(table);
}

}  // namespace

std::string mendedWorld(const std::filesystem::path& file, const SimWorld& world,
                        const std::string& map) {
  std::string text = withoutTables(readTomlText(file), file.string(), isInMap);
  text += fmt::format("\n[[grid]]\nmap = \"{}\"\nsurface_depth_cells = {}\nmap_error_m = {}\n", map,
                      kMapSurfaceDepth, kMapError);
  // Posts with an identity are in the map now, but they stay landmarks.
  for (const Landmark& mark : fieldModelOf(world).landmarks)
    text += fmt::format("\n[[landmark]]\nkind = \"{}\"\nidentity = {}\nposition_m = [{}, {}, {}]\n",
                        mark.kind, mark.identity, mark.x, mark.y, mark.z);
  return text;
}

}  // namespace ortung::app
