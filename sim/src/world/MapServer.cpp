#include <yaml-cpp/yaml.h>

#include <cmath>
#include <sstream>

#include "BoundedFile.hpp"
#include "GridMap.hpp"
#include "MapImage.hpp"
#include "MapServerCells.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMaxYamlBytes = std::size_t{64} << 10;
constexpr std::size_t kMaxImageBytes = std::size_t{256} << 20;

/// The content of a map_server YAML file.
struct MapDescription {
  std::string image;
  double resolution = 0.0;  ///< edge length of a cell [m]
  double originX = 0.0;     ///< x of the lower left corner [m]
  double originY = 0.0;     ///< y of the lower left corner [m]
  double yaw = 0.0;         ///< by which the map is turned about that corner [rad]
  MapServerCells cells;
};

class YamlMap {
 public:
  explicit YamlMap(const std::filesystem::path& file) : file_(file) {
    const std::string text = readBounded(file, kMaxYamlBytes);
    root_ = YAML::Load(text);
    if (!root_.IsMap())
      throw MapError(file.string() + ": expected keys and values of a map_server map");
  }

  MapDescription read() const {
    MapDescription map;
    map.image = text("image");
    map.resolution = number(need("resolution"), "resolution", 0.001, 100.0);
    readOrigin(map);
    MapServerCells& cells = map.cells;
    cells.negate = flag("negate");
    if (has("occupied_thresh"))
      cells.occupiedAbove = number(root_["occupied_thresh"], "occupied_thresh", 0.0, 1.0);
    if (has("free_thresh")) cells.freeBelow = number(root_["free_thresh"], "free_thresh", 0.0, 1.0);
    if (cells.freeBelow > cells.occupiedAbove)
      refuse(root_, "free_thresh is above occupied_thresh, expected at most as large");
    if (has("mode")) cells.mode = mode(text("mode"));
    return map;
  }

 private:
  bool has(const char* key) const { return root_[key].IsDefined(); }

  [[noreturn]] void refuse(const YAML::Node& node, const std::string& what) const {
    const int line = node.IsDefined() ? node.Mark().line : -1;
    throw MapError(file_.string() + (line >= 0 ? ":" + std::to_string(line + 1) : "") + ": " +
                   what);
  }

  YAML::Node need(const char* key) const {
    if (!has(key)) throw MapError(file_.string() + ": has no " + key);
    return root_[key];
  }

  std::string text(const char* key) const {
    const YAML::Node node = need(key);
    if (!node.IsScalar() || node.Scalar().empty() || node.Scalar().find('\0') != std::string::npos)
      refuse(node, std::string(key) + " is not a text");
    return node.Scalar();
  }

  double number(const YAML::Node& node, const std::string& name, double low, double high) const {
    double value = 0.0;
    const bool isNumber = node.IsScalar() && YAML::convert<double>::decode(node, value);
    if (isNumber && value >= low && value <= high) return value;
    std::ostringstream message;
    message << name << " is " << (node.IsScalar() ? node.Scalar().substr(0, 40) : "no number")
            << ", expected a number in [" << low << ", " << high << "]";
    refuse(node, message.str());
  }

  bool flag(const char* key) const {
    if (!has(key)) return false;
    const YAML::Node node = root_[key];
    const std::string value = node.IsScalar() ? node.Scalar() : "";
    if (value == "1" || value == "true") return true;
    if (value != "0" && value != "false") refuse(node, std::string(key) + " must be 0 or 1");
    return false;
  }

  MapServerCells::Mode mode(const std::string& name) const {
    if (name == "trinary") return MapServerCells::Mode::kTrinary;
    if (name == "scale") return MapServerCells::Mode::kScale;
    if (name != "raw")
      refuse(root_["mode"], "mode is \"" + name + "\", expected trinary, scale or raw");
    return MapServerCells::Mode::kRaw;
  }

  void readOrigin(MapDescription& map) const {
    const YAML::Node origin = need("origin");
    if (!origin.IsSequence() || origin.size() != 3)
      refuse(origin, "origin must be [x, y, yaw] of the lower left corner");
    map.originX = number(origin[0], "x of origin", -1e4, 1e4);
    map.originY = number(origin[1], "y of origin", -1e4, 1e4);
    map.yaw = number(origin[2], "yaw of origin", -1e4, 1e4);
  }

  std::filesystem::path file_;
  YAML::Node root_;
};

MapDescription describe(const std::filesystem::path& yaml) {
  try {
    return YamlMap(yaml).read();
  } catch (const YAML::Exception& error) {
    throw MapError(yaml.string() + ": is not the YAML of a map_server map: " + error.what());
  }
}

std::filesystem::path findImage(const std::filesystem::path& yaml, const std::string& name) {
  const std::filesystem::path plain = yaml.parent_path() / name;
  for (const char* end : {"", ".gz", ".xz"}) {
    std::filesystem::path file = plain;
    file += end;
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) return file;
  }
  throw MapError(yaml.string() + ": the image " + plain.string() +
                 " does not exist, nor with .gz or .xz added");
}

}  // namespace

GridMap readMapServer(const std::filesystem::path& yaml) {
  const MapDescription about = describe(yaml);
  const std::filesystem::path file = findImage(yaml, about.image);
  const MapImage image =
      decodeImage(file, readUnpacked(file, kMaxImageBytes), [&](const MapPixel& pixel) {
        return static_cast<std::uint8_t>(cellOf(about.cells.occupancyOf(pixel)));
      });
  GridMap map;
  map.columns = image.width;
  map.rows = image.height;
  map.cell = about.resolution;
  map.originX = about.originX;
  map.originY = about.originY;
  map.turnTo(about.yaw);
  checkGrid(yaml, map.columns, map.rows, map.cell, 0.0, 0.0);
  checkPlace(yaml, map);
  map.cells.resize(image.meanings.size());
  for (int row = 0; row < map.rows; ++row)  // the image's bottom row is the grid's first
    for (int column = 0; column < map.columns; ++column)
      map.cells[map.index(column, row)] =
          static_cast<GridCell>(image.meanings[map.index(column, map.rows - 1 - row)]);
  return map;
}

}  // namespace ortung
