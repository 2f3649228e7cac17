#include "RobotSettings.hpp"

#include <algorithm>
#include <string_view>

#include "Console.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::app {
namespace {

/// Returns what an error "FILE:LINE: KEY ..." says of the last word of a setting's key, or "".
std::string saidOf(const std::string& setting, const std::string& file, std::string_view error) {
  if (!error.starts_with(file + ":")) return "";
  error.remove_prefix(file.size() + 1);
  const std::size_t line = std::min(error.find_first_not_of("0123456789"), error.size());
  error.remove_prefix(line);
  error.remove_prefix(std::min(error.find_first_not_of(": "), error.size()));
  const std::string key = setting.substr(0, setting.find('='));
  const std::size_t dot = key.rfind('.');
  const std::string word = dot == key.npos ? key : key.substr(dot + 1);
  return error.starts_with(word + " ") ? std::string(error) : "";
}

}  // namespace

void applySettings(const std::filesystem::path& robot, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == setting.npos)
      throw UsageError("--set is '" + setting + "', expected KEY=VALUE, e.g. mcl.particles=500");
    try {
      changeToml(robot, setting.substr(0, equals), setting.substr(equals + 1));
    } catch (const ConfigError& error) {
      throw UsageError("--set " + setting + ": " + error.what());
    }
  }
}

int withSettings(const std::filesystem::path& robot, const std::vector<std::string>& settings,
                 const std::function<int()>& work) {
  applySettings(robot, settings);
  try {
    return work();
  } catch (const ConfigError& error) {
    for (auto setting = settings.rbegin(); setting != settings.rend(); ++setting)
      if (const std::string said = saidOf(*setting, robot.string(), error.what()); !said.empty())
        throw UsageError("--set " + *setting + ": " + said);
    throw;
  }
}

}  // namespace ortung::app
