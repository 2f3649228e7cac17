#include "BagTopics.hpp"

#include "ortung/realsensors/LogFile.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

std::string featureOf(const McapChannel& channel) {
  const auto found = channel.metadata.find("ortung_feature");
  return found == channel.metadata.end() ? "" : found->second;
}

std::string typeOf(const McapChannel& channel) {
  const std::string& name = channel.schema.name;
  const std::size_t slash = name.find('/');
  if (channel.encoding != kRos1Encoding || slash == name.npos) return name;
  if (name == "tf/tfMessage") return std::string(TfMessage::kType);
  return name.find('/', slash + 1) != name.npos
             ? name
             : name.substr(0, slash) + "/msg" + name.substr(slash);
}

bool isLevelledByTopic(const std::string& level) { return level != "odometry" && level != "none"; }

std::string listOf(const std::set<std::string>& names) {
  constexpr std::size_t kMost = 32;
  std::string text;
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (++count > kMost) return text + " and " + std::to_string(names.size() - kMost) + " more";
    text += (text.empty() ? "" : ", ") + inQuotes(name);
  }
  return text.empty() ? "there is none" : text;
}

}  // namespace ortung::ros2
