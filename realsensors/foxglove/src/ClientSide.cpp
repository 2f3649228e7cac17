// The part of a session that deals with the client.
#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "SessionParts.hpp"

namespace ortung {
namespace {

using nlohmann::json;

constexpr std::int64_t kSecond = 1'000'000'000;  // [ns]
constexpr std::size_t kMostTold = 8;             // about one message

std::string textOf(const json& value) {
  return value.dump(-1, ' ', true, json::error_handler_t::replace);
}

/// The members of an advertised channel that are the same for all of a type.
std::string schemaPart(std::string_view type) {
  return R"("encoding":"cdr","schemaEncoding":"ros2msg","schemaName":)" + textOf(type) +
         R"(,"schema":)" + textOf(ros2::schemaText(type));
}

/// The same from a table: each client is told some dozen of them, and escaping the schemas' texts
/// is most of the work of a new one.
std::string knownSchemaPart(std::string_view type) {
  static const std::map<std::string, std::string, std::less<>> kParts = [] {
    std::map<std::string, std::string, std::less<>> parts;
    for (const std::string_view one :
         {ros2::LaserScan::kType, ros2::Odometry::kType, ros2::TfMessage::kType,
          ros2::PoseStamped::kType, ros2::PoseWithCovarianceStamped::kType, ros2::PoseArray::kType,
          ros2::OccupancyGrid::kType, ros2::Range::kType, ros2::Image::kType,
          ros2::PointCloud::kType, ros2::DiagnosticArray::kType, ros2::Words::kType})
      parts.emplace(one, schemaPart(one));
    return parts;
  }();
  const auto found = kParts.find(type);
  return found == kParts.end() ? schemaPart(type) : found->second;
}

/// [ns since 1970]
std::uint64_t nanoseconds(Timestamp stamp) {
  return static_cast<std::uint64_t>(std::max<Timestamp>(stamp, 0)) * 1000;
}

json timeOf(Timestamp stamp) {
  const auto time = static_cast<std::int64_t>(nanoseconds(stamp));
  return {{"sec", time / kSecond}, {"nsec", time % kSecond}};
}

/// Returns a number that a client may choose, or nothing.
std::optional<std::uint32_t> numberIn(const json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0xFFFFFFFFU) return std::nullopt;
  return value.get<std::uint32_t>();
}

/// Returns the list of a key; empty if there is none.
const json& listIn(const json& message, const char* key) {
  static const json kNone = json::array();
  const auto found = message.find(key);
  return found != message.end() && found->is_array() ? *found : kNone;
}

}  // namespace

void FoxgloveSession::Parts::tell(Level level, const std::string& text) {
  if (++faultsTold > kMostTold) {
    ++faultsUntold;
    return;
  }
  sendText(textOf({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", text}}));
}

/// Ends what is told about a message.
void FoxgloveSession::Parts::tellRest() {
  const std::size_t rest = std::exchange(faultsUntold, 0);
  faultsTold = 0;
  if (rest > 0)
    tell(Level::kError, "the same message has " + std::to_string(rest) + " more such faults");
  faultsTold = 0;
}

void FoxgloveSession::Parts::sendInfo(const std::string& world) {
  json info{{"op", "serverInfo"},
            {"name", "ortung: " + world},
            {"capabilities", json::array({"time", "clientPublish"})},
            {"supportedEncodings", json::array({"json", "cdr"})},
            {"metadata", {{"kind", kind}}}};
  if (start && end) {
    for (const char* name :
         {"playbackControl", "rangedPlayback"})  // in later and in earlier versions
      info["capabilities"].push_back(name);
    info["dataStartTime"] = timeOf(*start);
    info["dataEndTime"] = timeOf(*end);
  }
  sendText(textOf(info));
}

std::uint32_t FoxgloveSession::Parts::channelFor(const ros2::Topic& topic) {
  const auto known = channelOf.find(topic.name);
  if (known != channelOf.end()) return known->second;
  const std::uint32_t id = nextChannel++;
  channelOf[topic.name] = id;
  Channel& channel = channels[id];
  channel.topic = topic.name;
  channel.type = topic.type;
  return id;
}

void FoxgloveSession::Parts::advertise(const std::vector<std::uint32_t>& fresh) {
  std::string text = R"({"op":"advertise","channels":[)";
  bool isFirst = true;
  for (const std::uint32_t id : fresh) {
    const Channel& channel = channels[id];
    if (channel.topic == "/map" && channel.latched.empty()) continue;
    text += isFirst ? "" : ",";
    isFirst = false;
    text += R"({"id":)" + std::to_string(id) + R"(,"topic":)" + textOf(channel.topic) + ',' +
            knownSchemaPart(channel.type) + '}';
  }
  sendText(text + "]}");
}

void FoxgloveSession::Parts::takeText(std::string_view text) {
  const json message = json::parse(text, nullptr, false);
  const auto op = message.is_object() ? message.find("op") : message.end();
  if (!message.is_object() || op == message.end() || !op->is_string())
    return tell(Level::kError,
                "found a message that is not a JSON object with an op, expected one");
  const std::string name = op->get<std::string>();
  if (name == "subscribe") {
    for (const json& one : listIn(message, "subscriptions")) {
      const auto id = one.is_object() ? numberIn(one.value("id", json())) : std::nullopt;
      const auto channel =
          one.is_object() ? numberIn(one.value("channelId", json())) : std::nullopt;
      if (!id || !channel)
        tell(Level::kError, "found a subscription without id and channelId, expected both");
      else
        subscribe(*id, *channel);
    }
    subscribeAtBoard();
  } else if (name == "unsubscribe") {
    for (const json& one : listIn(message, "subscriptionIds"))
      if (const auto id = numberIn(one)) unsubscribe(*id);
    subscribeAtBoard();
  } else if (name == "advertise") {
    for (const json& one : listIn(message, "channels")) takeClientChannel(one);
  } else if (name == "unadvertise") {
    for (const json& one : listIn(message, "channelIds"))
      if (const auto id = numberIn(one)) removeClientChannel(*id);
  } else {
    constexpr std::size_t kShown = 40;
    tell(Level::kWarning, "found the operation '" + name.substr(0, kShown) +
                              "', expected subscribe, unsubscribe, advertise or unadvertise: this "
                              "server has no other");
  }
}

void FoxgloveSession::Parts::subscribe(std::uint32_t subscription, std::uint32_t id) {
  const auto channel = channels.find(id);
  if (channel == channels.end())
    return tell(Level::kError, "there is no channel " + std::to_string(id));
  if (channel->second.subscription || subscriptions.contains(subscription))
    return tell(Level::kError, "channel " + std::to_string(id) + " or subscription " +
                                   std::to_string(subscription) + " is in use already");
  channel->second.subscription = subscription;
  subscriptions[subscription] = id;
  for (const auto& [robot, message] : channel->second.latched)
    sendBinary(foxglove::messageFrame(subscription, nanoseconds(now), message));
}

void FoxgloveSession::Parts::unsubscribe(std::uint32_t subscription) {
  const auto found = subscriptions.find(subscription);
  if (found == subscriptions.end())
    return tell(Level::kWarning, "there is no subscription " + std::to_string(subscription));
  channels[found->second].subscription.reset();
  subscriptions.erase(found);
}

void FoxgloveSession::Parts::takeBinary(std::string_view message) {
  if (foxglove::isPublished(message)) return takePublished(message);
  const auto request = foxglove::parsePlaybackRequest(message);
  if (!request)
    return tell(Level::kError,
                "found a binary message that is neither a publication nor a request to play");
  if (!start || !end)
    return tell(Level::kError, "only a record can be played and sought in; this is not a record");
  control(*request);
}

void FoxgloveSession::Parts::control(const foxglove::PlaybackRequest& request) {
  isPlaybackWatched = true;
  const auto heed = [this](const BoardReply& reply) {
    if (!reply.isOk()) tell(Level::kWarning, "the board refuses: " + reply.text());
  };
  ask("SPEED " + std::to_string(request.speed), heed);
  if (request.seek) {
    const double first = toSeconds(*start);
    const double wanted = static_cast<double>(*request.seek) / static_cast<double>(kSecond) - first;
    ask("SEEK time_s=" + std::to_string(std::clamp(wanted, 0.0, toSeconds(*end) - first)), heed);
  }
  ask(request.isPlay ? "RESUME" : "PAUSE", heed);
  ask("STATUS", [this, hasSought = request.seek.has_value(), id = request.id](
                    const BoardReply& status) { tellPlayback(status, hasSought, id); });
}

void FoxgloveSession::Parts::tellPlayback(const BoardReply& status, bool hasSought,
                                          const std::string& request) {
  if (!status.isOk()) return;
  now = status.number("now", now);
  const auto textIn = [&](const char* key) {
    const auto found = status.keys.find(key);
    return found == status.keys.end() ? std::string() : found->second;
  };
  foxglove::PlaybackState state;
  const std::string told = textIn("state");
  if (told == "ended")
    state.status = foxglove::PlaybackStatus::kEnded;
  else if (told == "running")
    state.status = foxglove::PlaybackStatus::kPlaying;
  state.time = nanoseconds(now);
  const float speed = std::strtof(textIn("speed").c_str(), nullptr);
  state.speed = speed > 0.0F ? speed : 1.0F;
  state.hasSought = hasSought;
  state.request = request;
  sendBinary(foxglove::playbackFrame(state));
}

}  // namespace ortung
