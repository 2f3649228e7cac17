#include "ortung/robot/TableInfo.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "BuildingJson.hpp"
#include "FieldModelJson.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/robot/RobotTables.hpp"

namespace ortung {
namespace {

constexpr int kFormat = 1;
/// Most cells of a region, as many as the learner makes.
constexpr std::size_t kMostCells = std::size_t{1} << 26;
constexpr std::size_t kMostMeta = std::size_t{64} << 20;  ///< bytes
constexpr int kDeepest = 8;
constexpr const char* kMeta = "meta.json";
using Json = nlohmann::json;

/// Returns the member @p key of kind T, or throws an error that names the file and the key.
template <class T>
T take(const TableFile& file, const Json& json, const char* key) {
  try {
    return json.at(key).get<T>();
  } catch (const Json::exception&) {
    throw TableError(file.path().string() + ": " + kMeta + ": '" + key +
                     "' is missing or of the wrong kind");
  }
}

/// Parses with a limit of depth: nested brackets take a hundred times their size in the file as
/// memory.
Json parseMeta(const TableFile& file, const std::string& text) {
  const auto look = [&](int depth, Json::parse_event_t, const Json&) {
    if (depth <= kDeepest) return true;
    throw TableError(file.path().string() + ": " + kMeta + " is nested deeper than " +
                     std::to_string(kDeepest));
  };
  return Json::parse(text, look, false);
}

FieldRegion readRegion(const TableFile& file, const Json& meta) {
  FieldRegion region;
  FieldGrid& grid = region.grid;
  grid.originX = take<double>(file, meta, "origin_x_m");
  grid.originY = take<double>(file, meta, "origin_y_m");
  grid.cell = take<double>(file, meta, "cell_m");
  const TableArray& open = file.array("open");
  if (open.shape.size() != 2 || open.bytes.size() > kMostCells || open.shape[0] > kMostCells ||
      open.shape[1] > kMostCells) {
    throw TableError(file.path().string() + ": table open has an impossible shape");
  }
  grid.rows = static_cast<int>(open.shape[0]);
  grid.columns = static_cast<int>(open.shape[1]);
  for (const auto& [name, mask] :
       {std::pair("open", &region.open), {"standable", &region.standable}}) {
    const auto cells = file.get<std::uint8_t>(name, open.shape);
    mask->assign(cells.begin(), cells.end());
  }
  try {
    region.check();
  } catch (const std::invalid_argument& error) {
    throw TableError(file.path().string() + ": " + error.what());
  }
  return region;
}

}  // namespace

std::uintmax_t writeTables(const std::filesystem::path& file, const SensorContainer& container,
                           const TableInfo& info) {
  TableWriter writer(file);
  Json meta;
  meta["format"] = "ortung tables";
  meta["version"] = kFormat;
  meta["world"] = info.world;
  meta["world_fingerprint"] = info.worldFingerprint;
  meta["robot"] = info.robot;
  meta["heading_step_rad"] = info.headingStep;
  const FieldGrid& grid = info.region.grid;
  meta["origin_x_m"] = grid.originX;
  meta["origin_y_m"] = grid.originY;
  meta["cell_m"] = grid.cell;
  if (!info.field.isEmpty()) meta["field"] = toJson(info.field);
  if (!info.region.building.isEmpty()) meta["building"] = toJson(info.region.building);
  if (!info.robotToml.empty()) meta["robot_file"] = info.robotToml;
  meta["features"] = Json::array();
  const std::vector<std::size_t> shape = {static_cast<std::size_t>(grid.rows),
                                          static_cast<std::size_t>(grid.columns)};
  writer.add<std::uint8_t>("open", shape, info.region.open);
  writer.add<std::uint8_t>("standable", shape, info.region.standable);
  std::set<std::string> prefixes;
  for (const auto& data : container.all()) {
    if (!data->isLearned()) continue;
    std::string prefix = data->id().model + "." + data->id().type + "." + data->id().feature + ".";
    // "a.b/c/d" and "a/b.c/d" look alike here.
    while (!prefixes.insert(prefix).second) prefix = "_" + prefix;
    data->saveTables(writer, prefix);
    meta["features"].push_back(
        {{"id", toText(data->id())}, {"key", data->learningKey()}, {"prefix", prefix}});
  }
  writer.addText(kMeta, meta.dump(1) + "\n");
  return writer.commit();
}

TableInfo readTableInfo(const TableFile& file) {
  const std::string text = file.text(kMeta);
  if (text.size() > kMostMeta) {
    throw TableError(file.path().string() + ": " + kMeta + " has " + std::to_string(text.size()) +
                     " bytes, expected at most " + std::to_string(kMostMeta));
  }
  const Json meta = parseMeta(file, text);
  if (meta.is_discarded() || !meta.is_object()) {
    throw TableError(file.path().string() + ": " + kMeta + " is no JSON object");
  }
  const int version = take<int>(file, meta, "version");
  if (take<std::string>(file, meta, "format") != "ortung tables" || version != kFormat) {
    throw TableError(file.path().string() + ": has format version " + std::to_string(version) +
                     ", this program reads " + std::to_string(kFormat) +
                     "; learn the tables again");
  }
  TableInfo info;
  info.world = take<std::string>(file, meta, "world");
  info.worldFingerprint = take<std::string>(file, meta, "world_fingerprint");
  info.robot = take<std::string>(file, meta, "robot");
  info.headingStep = take<double>(file, meta, "heading_step_rad");
  if (!(info.headingStep > 1e-4 && info.headingStep <= kTurn)) {
    throw TableError(file.path().string() + ": the heading step is not in (0.0001, 2 pi]");
  }
  info.region = readRegion(file, meta);
  const auto takePart = [&](const char* key, const auto& read) {
    if (!meta.contains(key)) return;
    try {
      read(meta[key]);
    } catch (const std::exception& error) {
      throw TableError(file.path().string() + ": " + kMeta + ": " + key + ": " + error.what());
    }
  };
  takePart("field", [&](const Json& field) { info.field = fieldModelOf(field); });
  takePart("building", [&](const Json& building) { info.region.building = buildingOf(building); });
  if (meta.contains("robot_file")) info.robotToml = take<std::string>(file, meta, "robot_file");
  for (const Json& feature : take<std::vector<Json>>(file, meta, "features")) {
    info.features.push_back({take<std::string>(file, feature, "id"),
                             take<std::string>(file, feature, "key"),
                             take<std::string>(file, feature, "prefix")});
  }
  return info;
}

namespace {

void giveTables(const std::shared_ptr<const TableFile>& file, const TableInfo& info,
                SensorContainer& container) {
  for (const auto& data : container.all()) {
    if (!data->localizes()) continue;
    const std::string id = toText(data->id());
    const auto it = std::find_if(info.features.begin(), info.features.end(),
                                 [&](const TableInfo::Feature& f) { return f.id == id; });
    if (it == info.features.end()) {
      throw TableError(file->path().string() + ": has no tables of " + id +
                       ", so it was learned for another robot ('" + info.robot +
                       "') or before this sensor was there; learn again");
    }
    if (it->key != data->learningKey()) {
      throw TableError(file->path().string() + ": the tables of " + id +
                       " were learned for another sensor: found '" + it->key +
                       "', the robot file says '" + data->learningKey() + "'; learn again");
    }
    data->loadTables(file, it->prefix, info.region.grid);
  }
}

}  // namespace

TableInfo loadTables(const std::shared_ptr<const TableFile>& file, SensorContainer& container) {
  TableInfo info = readTableInfo(*file);
  giveTables(file, info, container);
  container.setField(std::make_shared<FieldModel>(info.field));
  return info;
}

RobotTables::RobotTables(const std::filesystem::path& file)
    : file_(std::make_shared<const TableFile>(file)),
      info_(std::make_shared<const TableInfo>(readTableInfo(*file_))) {}

void RobotTables::giveTo(SensorContainer& container) const {
  giveTables(file_, *info_, container);
  container.setField({info_, &info_->field});
}

}  // namespace ortung
