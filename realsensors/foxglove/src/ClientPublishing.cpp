// What a client publishes, and the robots that are told it.
#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "SessionParts.hpp"

namespace ortung {
namespace {

using nlohmann::json;

constexpr std::size_t kMostChannels = 64;

std::string textIn(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Whether the topics of a robot are behind a name.
bool hasTopicsOf(const foxglove::DescribedRobot& robot, const std::string& name) {
  const auto& topics = robot.topics->topics();
  return std::any_of(topics.begin(), topics.end(), [start = "/" + name + "/"](const auto& topic) {
    return topic.name.starts_with(start);
  });
}

}  // namespace

void FoxgloveSession::Parts::takeClientChannel(const nlohmann::json& one) {
  if (!one.is_object() || !one.contains("id") || !one["id"].is_number_unsigned() ||
      one["id"].get<std::uint64_t>() > 0xFFFFFFFFU)
    return tell(Level::kError, "found a channel without an id, expected one");
  const foxglove::ClientChannel channel{textIn(one, "topic"), textIn(one, "encoding"),
                                        textIn(one, "schemaName")};
  if (const std::string fault = foxglove::faultOf(channel); !fault.empty())
    return tell(Level::kError, fault);
  if (published.size() >= kMostChannels)
    return tell(Level::kError, "there are 64 channels of this client already");
  published[one["id"].get<std::uint32_t>()] = channel;
}

void FoxgloveSession::Parts::removeClientChannel(std::uint32_t id) {
  const auto found = published.find(id);
  if (found == published.end()) return;
  // Nobody would tell it to stop any more.
  if (foxglove::wishOf(found->second.topic) == foxglove::ClientWish::kVelocity)
    if (const auto robot = robotFor(found->second.topic))
      order("VELOCITY v_m_s=0 w_rad_s=0", *robot);
  published.erase(found);
}

/// Returns the robot that a topic is for; nothing, and tells it, if that is not clear.
std::optional<std::int64_t> FoxgloveSession::Parts::robotFor(const std::string& topic) {
  const std::string name = foxglove::robotOf(topic);
  std::optional<std::int64_t> found;
  for (const auto& [number, part] : robots) {
    if (!part.robot) continue;
    if (!name.empty() && !hasTopicsOf(*part.robot, name)) continue;
    if (found) {
      tell(Level::kError, "there are several robots, expected a topic behind the name of one");
      return std::nullopt;
    }
    found = number;
  }
  if (!found) tell(Level::kError, "there is no robot '" + name.substr(0, 80) + "'");
  return found;
}

void FoxgloveSession::Parts::takePublished(std::string_view message) {
  std::uint32_t id = 0;
  if (message.size() < 1 + sizeof id)
    return tell(Level::kError, "found a message without a channel, expected one");
  std::memcpy(&id, message.data() + 1, sizeof id);
  const auto channel = published.find(id);
  if (channel == published.end())
    return tell(Level::kError, "there is no channel " + std::to_string(id) + " of this client");
  std::string why;
  const auto request = foxglove::requestOf(channel->second, message.substr(1 + sizeof id), why);
  if (!request) return tell(Level::kError, channel->second.topic + ": " + why);
  if (const auto robot = robotFor(channel->second.topic)) order(*request, *robot);
}

/// Tells a robot something, and the client if that is refused: of velocities, which come many times
/// a second, once.
void FoxgloveSession::Parts::order(const std::string& request, std::int64_t robot) {
  const bool isVelocity = request.starts_with("VELOCITY");
  ask(request + " robot=" + std::to_string(robot), [this, isVelocity](const BoardReply& reply) {
    if (reply.isOk()) {
      if (isVelocity) isRefusalTold = false;
      return;
    }
    if (isVelocity && std::exchange(isRefusalTold, true)) return;
    tell(Level::kError, "the board refuses: " + reply.text() +
                            "; robots obey operators: add ?token=T to the address");
  });
}

}  // namespace ortung
