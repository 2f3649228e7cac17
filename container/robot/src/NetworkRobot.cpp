#include "ortung/robot/NetworkRobot.hpp"

#include <algorithm>

#include "TomlLibrary.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

// Sections that only the client's own half reads, to track the robot.
constexpr std::string_view kSectionsOfTheClient[] = {"motion", "mcl"};

/// Most pieces of the robot's geometry, of all states together. Their cost in the physics grows
/// with the square of their number.
constexpr int kMostParts = 32;
constexpr int kPartsOfAnEllipse = 8;

/// Checks every value of a robot file for what a remote client must not set.
class Inspection {
 public:
  Inspection(const std::string& name, std::span<const std::string> plugins)
      : name_(name), plugins_(plugins) {}

  void inspect(const toml::table& table) {
    for (const auto& [key, node] : table) inspect(key.str(), node);
  }

 private:
  void countPart(const toml::table& body) {
    const auto* sizes = body["size_m"].as_array();
    const bool isCircle = sizes != nullptr && sizes->size() == 2 &&
                          (*sizes)[0].value<double>() == (*sizes)[1].value<double>();
    const bool isEllipse = body["shape"].value<std::string_view>() == "ellipse" && !isCircle;
    parts_ += isEllipse ? kPartsOfAnEllipse : 1;
    if (parts_ > kMostParts)
      refuse("body", body,
             "is one too many: a robot from the network has at most " + std::to_string(kMostParts) +
                 " pieces in all its states (an ellipse counts " +
                 std::to_string(kPartsOfAnEllipse) + ")");
  }

  void inspect(std::string_view key, const toml::node& node) {
    if (key == "path" || key == "file" || key.ends_with("_file") || key.ends_with("_path"))
      refuse(key, node, "names a file, which a configuration from the network must not");
    if (const auto* text = node.as_string()) inspectText(key, *text);
    if (const auto* table = node.as_table()) inspect(*table);
    if (const auto* list = node.as_array()) {
      for (const toml::node& entry : *list) {
        inspect(key, entry);
        if (const auto* body = entry.as_table(); body != nullptr && key == "body") countPart(*body);
      }
    }
  }

  void inspectText(std::string_view key, const toml::value<std::string>& value) const {
    const std::string& text = value.get();
    const bool strange = std::any_of(text.begin(), text.end(), [](char c) {
      return c == '/' || c == '\\' || (c >= 0 && c < 0x20) || c == 0x7F;
    });
    if (strange)
      refuse(key, value,
             "has a slash or a control character, which a configuration from the "
             "network must not");
    if (key == "plugin" && std::find(plugins_.begin(), plugins_.end(), text) == plugins_.end())
      refuse(key, value, "is not one of the plugins of this server:" + list());
  }

  std::string list() const {
    std::string text;
    for (const std::string& plugin : plugins_) text += " " + plugin;
    return text;
  }

  [[noreturn]] void refuse(std::string_view key, const toml::node& node,
                           const std::string& what) const {
    throw ConfigError(name_ + ":" + std::to_string(node.source().begin.line) + ": " +
                      std::string(key) + " " + what);
  }

  const std::string& name_;
  std::span<const std::string> plugins_;
  int parts_ = 0;
};

}  // namespace

RobotConfig readNetworkRobot(std::string_view toml, const std::string& name,
                             std::span<const std::string> plugins) {
  const Parameters parameters = parseToml(toml, name, kMaxNetworkConfigBytes);
  toml::table table = toml::parse(toml, name);  // it has passed parseToml's bounds
  for (const std::string_view section : kSectionsOfTheClient) table.erase(section);
  Inspection(name, plugins).inspect(table);
  RobotConfig robot = readRobot(parameters);
  robot.motion = robot.mcl = Parameters(name);
  return robot;
}

}  // namespace ortung
