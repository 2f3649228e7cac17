#include "Init.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <system_error>

#include "Console.hpp"
#include "Outputs.hpp"
#include "SurveyedPlugins.hpp"
#include "Templates.hpp"
#include "TomlText.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;

std::string replaced(std::string text, const std::string& sign, const std::string& by) {
  for (std::size_t at = text.find(sign); at != text.npos; at = text.find(sign, at + by.size()))
    text.replace(at, sign.size(), by);
  return text;
}

/// Returns a name that is valid wherever files want one.
std::string wordOf(const fs::path& file) {
  std::string word = file.stem().string().substr(0, 64);
  std::replace_if(
      word.begin(), word.end(),
      [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_'; }, '_');
  return word.empty() ? "mine" : word;
}

/// A map's name as a TOML string. @throws UsageError for control characters, which no name needs
std::string quotedName(const std::string& name) {
  const bool isPlain = std::none_of(name.begin(), name.end(),
                                    [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (!isPlain) throw UsageError("--map: the name has control characters");
  return quotedToml(name);
}

void write(const fs::path& file, const std::string& text, bool force) {
  std::error_code error;
  if (!force && fs::exists(file, error))
    throw std::runtime_error(file.string() + ": is there already; --force overwrites it");
  writeFile(file, text);
  fmt::print("{}\n", printable(file.string()));
}

/// Returns a line for a key: one that is required with some value, another one commented out with
/// its default.
std::string keyLine(const std::string& key, const KeySurvey::Key& entry) {
  if (!entry.question) return "";
  std::string comment = textOf(*entry.question);
  if (entry.isRequired) comment += "; required";
  if (!entry.isRequired && !entry.question->fallback) comment += "; without it another key holds";
  return fmt::format("{:<33} # {}\n",
                     (entry.isRequired ? "" : "#") + key + " = " + exampleOf(*entry.question),
                     comment);
}

/// Returns a table in one line.
std::string inlineTable(const KeySurvey& survey) {
  std::string text;
  for (const auto& [key, entry] : survey.keys)
    if (entry.question)
      text += (text.empty() ? "" : ", ") + key + " = " + exampleOf(*entry.question);
  return "{ " + text + " }";
}

/// @param number how many sensors of that plugin there are with this one: further ones are other
///   models, since features have names of their own
std::string sensorText(PluginFactory& factory, const std::string& name, int number) {
  const KeySurvey survey = surveyPlugin(factory, PluginKind::kSensor, name);
  std::string text = fmt::format("\n[[sensor]]\nplugin = {}\n", quotedToml(name));
  for (const auto& [key, entry] : survey.keys) {
    if (key == "plugin") continue;
    if (key == "model" && number > 1) {
      std::string model = entry.question ? exampleOf(*entry.question) : quotedToml(name);
      if (model.size() > 1) model.insert(model.size() - 1, std::to_string(number));
      text += fmt::format("{:<33} # of that name there is one already\n", "model = " + model);
      continue;
    }
    const auto below = survey.tables.find(key);
    const bool isTable =
        below != survey.tables.end() && entry.question->kind == Question::Kind::kTable;
    const char* mark = entry.isRequired ? "" : "#";
    text += isTable ? fmt::format("{}{} = {}\n", mark, key, inlineTable(below->second))
                    : keyLine(key, entry);
  }
  return text;
}

/// Refuses the name of a sensor that is there: whichever library is found first would hide the
/// other one. @throws UsageError
void refuseShadow(const std::string& name) {
  PluginFactory factory(PluginFactory::standardFolders());
  for (const PluginFactory::Found& found : factory.list())
    for (const auto& entry : found.entries)
      if (entry.interface == SensorData::kInterface && entry.name == name)
        throw UsageError(
            fmt::format("there is a sensor '{}' already, in {}, and one would hide the "
                        "other; name it otherwise, as 'my_{}', or use --force",
                        name, found.file.string(), name));
}

}  // namespace

int runInitRobot(const InitRobotArguments& arguments) {
  std::string text = replaced(templates::kRobot, "@NAME@", wordOf(arguments.out));
  const auto& sensors = arguments.sensors;
  if (std::find(sensors.begin(), sensors.end(), "odometry") == sensors.end())
    text += templates::kOdometry;
  if (sensors.empty()) text += templates::kScanner;
  PluginFactory factory(PluginFactory::standardFolders());
  std::map<std::string, int> counts;
  for (const std::string& sensor : sensors) text += sensorText(factory, sensor, ++counts[sensor]);
  write(arguments.out, text, arguments.force);
  note("next: `ortung check " + arguments.out.string() + "`, `ortung init world`, `ortung learn`");
  return 0;
}

int runInitWorld(const InitWorldArguments& arguments) {
  const std::string name = wordOf(arguments.out);
  if (arguments.map.empty()) {
    write(arguments.out, replaced(templates::kWorld, "@NAME@", name), arguments.force);
    return 0;
  }
  // The map is named as seen from the world file.
  const fs::path folder = arguments.out.parent_path();
  const fs::path map = arguments.map.is_absolute()
                           ? arguments.map
                           : arguments.map.lexically_relative(folder.empty() ? "." : folder);
  const std::string text =
      replaced(replaced(templates::kMapWorld, "@NAME@", name), "@MAP@", quotedName(map.string()));
  write(arguments.out, text, arguments.force);
  return 0;
}

int runInitSensor(const InitSensorArguments& arguments) {
  const std::string& name = arguments.name;
  const bool isWord =
      !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
      });
  if (!isWord) throw UsageError("name is '" + name + "', expected 1 to 64 of a-z, 0-9, _");
  if (!arguments.force) refuseShadow(name);
  const fs::path folder = arguments.out.empty() ? fs::path(name) : arguments.out;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": can't be made: " + error.message());
  const auto put = [&](const std::string& file, const std::string& text) {
    write(folder / file, replaced(text, "@NAME@", name), arguments.force);
  };
  put("CMakeLists.txt", templates::kSensorBuild);
  put(name + ".cpp", templates::kSensor);
  put(name + ".toml", templates::kSensorRobot);
  return 0;
}

}  // namespace ortung::app
