#include "Schema.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "KeySurvey.hpp"
#include "ScratchFolder.hpp"
#include "SurveyedPlugins.hpp"
#include "ortung/core/ShippedFiles.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/robot/RobotFile.hpp"
#include "ortung/robot/TomlFile.hpp"
#include "ortung/sim/RobotShape.hpp"
#include "ortung/sim/Scene.hpp"
#include "ortung/sim/SimWorld.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// One table of each kind, since those that no file has are asked nothing.
constexpr const char* kWorld = R"(
[[rectangle]]
center_m = [0.0, 0.0]
size_m = [4.0, 0.1]
kind = "wall"
[[rectangle]]
center_m = [0.0, 1.0]
size_m = [0.2, 0.2]
kind = "crate"
mass_kg = 1.0
[[ellipse]]
center_m = [1.0, 2.0]
size_m = [0.2, 0.2]
kind = "post"
identity = 1
[[ellipse]]
center_m = [1.0, 1.0]
size_m = [1.0, 1.0]
kind = "line"
[[triangle]]
corners_m = [0.0, 3.0, 1.0, 3.0, 0.0, 4.0]
[[landmark]]
kind = "tag"
identity = 2
position_m = [2.0, 2.0]
[[grid]]
map = "map.yaml"
)";
constexpr const char* kMap =
    "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";
constexpr const char* kPicture = "P2\n2 2\n255\n0 254 254 254\n";

/// Returns the shipped files of a kind, in the order of their names.
std::vector<fs::path> shippedFiles(const std::string& kind, const std::string& one) {
  const fs::path folder = shippedFile(kind, one).parent_path();
  std::vector<fs::path> files;
  if (!folder.empty())
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (files.empty()) throw std::runtime_error("the shipped " + kind + " are not installed");
  std::sort(files.begin(), files.end());
  return files;
}

Parameters surveyed(const fs::path& file) {
  Parameters toml = readToml(file);
  toml.survey();
  return toml;
}

/// Reads a robot as the simulator does and as a localization does.
void readWhole(const Parameters& toml, PluginFactory& factory) {
  const RobotConfig robot = readRobot(toml);
  SensorContainer container;
  fillContainer(container, robot, factory);
  MclConfig::read(robot.mcl);
  robot.motion.textOr("plugin", "odometry");
  robot.drive.textOr("plugin", "differential");
  RobotShape::read(robot);
}

/// Takes back what is required, where files that can be read do without it: with another `model`,
/// a camera needs other keys.
void excuse(KeySurvey& survey, const KeySurvey& files) {
  for (auto& [key, entry] : survey.keys)
    if (const auto in = files.keys.find(key); in != files.keys.end())
      entry.isRequired = entry.isRequired && in->second.isRequired;
  for (auto& [name, table] : survey.tables)
    if (const auto in = files.tables.find(name); in != files.tables.end())
      excuse(table, in->second);
}

KeySurvey surveyRobots() {
  KeySurvey all;
  PluginFactory factory(PluginFactory::standardFolders());
  for (const fs::path& file : shippedFiles("robots", "pioneer.toml")) {
    const Parameters toml = surveyed(file);
    readWhole(toml, factory);
    all.addTables(surveyOf(toml));
  }
  // Its plugins' keys are those that the plugins themselves read.
  // What [device] holds is read on real robots alone.
  KeySurvey& sensors = all.tables["sensor"];
  sensors.tables.erase("device");
  // Of all sensors alike only these are read; the others are of their plugins.
  std::erase_if(sensors.keys,
                [](const auto& one) { return one.first != "plugin" && one.first != "device"; });
  for (auto& [name, variant] : sensors.variants) variant.tables.erase("device");
  const std::pair<const char*, PluginKind> plugins[] = {{"sensor", PluginKind::kSensor},
                                                        {"drive", PluginKind::kDrive},
                                                        {"motion", PluginKind::kMotion}};
  for (const auto& [table, kind] : plugins)
    for (const auto& [name, survey] : surveyPlugins(kind)) {
      KeySurvey& variant = all.tables[table].variants[name];
      const KeySurvey files = variant;
      variant.addReader(survey);
      excuse(variant, files);
    }
  return all;
}

KeySurvey surveyWorlds() {
  KeySurvey all;
  for (const fs::path& file : shippedFiles("fields", "f2000.toml")) {
    const Parameters toml = surveyed(file);
    readWorld(toml, "world", file.parent_path());
    all.addTables(surveyOf(toml));
  }
  const ScratchFolder folder;
  std::ofstream(folder.path() / "map.yaml") << kMap;
  std::ofstream(folder.path() / "map.pgm") << kPicture;
  Parameters toml = parseToml(kWorld, "world");
  toml.survey();
  readWorld(toml, "world", folder.path());
  all.addTables(surveyOf(toml));
  return all;
}

KeySurvey surveyScenes() {
  KeySurvey all;
  for (const fs::path& file : shippedFiles("scenes", "kick.toml")) {
    const Parameters toml = surveyed(file);
    Scene::read(toml, file.parent_path());
    all.addTables(surveyOf(toml));
  }
  // What [options] holds is read by the plugins.
  for (const char* table : {"player", "referee"}) {
    all.tables[table].tables.erase("options");
    for (auto& [name, variant] : all.tables[table].variants) variant.tables.erase("options");
  }
  return all;
}

Json schemaOf(const KeySurvey& survey);

Json schemaOf(const Question& question) {
  using Kind = Question::Kind;
  Json number = {{"type", question.kind == Kind::kInteger ? "integer" : "number"}};
  if (std::isfinite(question.range.low)) number["minimum"] = question.range.low;
  if (std::isfinite(question.range.high)) number["maximum"] = question.range.high;
  switch (question.kind) {
    case Kind::kFlag:
      return {{"type", "boolean"}};
    case Kind::kInteger:
    case Kind::kNumber:
      return number;
    case Kind::kText: {
      Json text = {{"type", "string"}};
      if (!question.choices.empty()) text["enum"] = question.choices;
      return text;
    }
    case Kind::kNumbers: {
      Json list = {{"type", "array"}, {"items", number}};
      if (question.count >= 0) list["minItems"] = list["maxItems"] = question.count;
      return list;
    }
    case Kind::kTexts:
      return {{"type", "array"}, {"items", {{"type", "string"}}}};
    case Kind::kTable:
      return {{"type", "object"}};
    case Kind::kTables:
      return {{"type", "array"}, {"items", {{"type", "object"}}}};
  }
  return Json::object();
}

/// Adds the schema of the tables under a key to that of the key.
void addTables(Json& schema, const Question& question, const KeySurvey& tables) {
  if (question.kind == Question::Kind::kTable) schema = schemaOf(tables);
  if (question.kind == Question::Kind::kTables) schema["items"] = schemaOf(tables);
}

Json schemaOfKey(const KeySurvey& survey, const std::string& key) {
  const std::optional<Question>& question = survey.keys.at(key).question;
  if (!question) return Json::object();
  Json schema = schemaOf(*question);
  if (const auto below = survey.tables.find(key); below != survey.tables.end())
    addTables(schema, *question, below->second);
  std::string help = textOf(*question);
  if (question->fallback && question->fallback != "{}" && question->fallback != "[]")
    help += "; default: " + *question->fallback;
  schema["description"] = help;
  return schema;
}

Json properties(const KeySurvey& survey) {
  Json all = Json::object();
  for (const auto& [key, entry] : survey.keys) all[key] = schemaOfKey(survey, key);
  return all;
}

Json required(const KeySurvey& survey) {
  Json keys = Json::array();
  for (const auto& [key, entry] : survey.keys)
    if (entry.isRequired && key != "plugin") keys.push_back(key);
  return keys;
}

/// A table whose keys depend on its key `plugin`.
Json schemaOfPlugins(const KeySurvey& survey) {
  Json names = Json::array(), cases = Json::array();
  const auto plugin = survey.keys.find("plugin");
  const bool hasUsual = plugin != survey.keys.end() && plugin->second.question &&
                        plugin->second.question->fallback.has_value();
  const std::string quoted = hasUsual ? *plugin->second.question->fallback : "\"\"";
  const std::string usual = quoted.substr(1, quoted.size() - 2);
  for (const auto& [name, variant] : survey.variants) {
    names.push_back(name);
    Json keys = properties(survey);  // what all of them have
    keys.update(properties(variant));
    keys["plugin"] = Json::object();
    const Json then = {
        {"properties", keys}, {"required", required(variant)}, {"additionalProperties", false}};
    Json condition = {{"properties", {{"plugin", {{"const", name}}}}}};
    // Without the key it is the default plugin.
    if (name != usual) condition["required"] = {"plugin"};
    cases.push_back({{"if", condition}, {"then", then}});
  }
  Json schema = {
      {"type", "object"}, {"properties", {{"plugin", {{"enum", names}}}}}, {"allOf", cases}};
  if (usual.empty()) schema["required"] = {"plugin"};
  return schema;
}

Json schemaOf(const KeySurvey& survey) {
  if (!survey.variants.empty()) return schemaOfPlugins(survey);
  Json schema = {{"type", "object"}, {"properties", properties(survey)}};
  if (const Json keys = required(survey); !keys.empty()) schema["required"] = keys;
  schema["additionalProperties"] = false;
  return schema;
}

}  // namespace

std::string schemaOf(const std::string& kind) {
  KeySurvey survey;
  if (kind == "robot")
    survey = surveyRobots();
  else if (kind == "world")
    survey = surveyWorlds();
  else if (kind == "scene")
    survey = surveyScenes();
  else
    throw std::invalid_argument("there is no schema of '" + kind +
                                "', expected robot, world or scene");
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "A " + kind + " file of Ortung"}};
  schema.update(schemaOf(survey));
  return schema.dump(2, ' ', true, Json::error_handler_t::replace);
}

}  // namespace ortung::app
