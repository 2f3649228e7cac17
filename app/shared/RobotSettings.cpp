#include "RobotSettings.hpp"

#include "Console.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::app {

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

}  // namespace ortung::app
