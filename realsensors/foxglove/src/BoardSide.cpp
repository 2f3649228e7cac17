// The part of a session that deals with the message board.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "FieldMap.hpp"
#include "SessionParts.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/core/BinaryReading.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/Words.hpp"

namespace ortung {
namespace {

constexpr Timestamp kListPeriod = 2'000'000;  // [us]
const SensorId kWorldTruth{"world", "truth", "robots"};
const SensorId kTruth{"reference", "groundTruth", "pose"};

}  // namespace

FoxgloveSession::Parts::Parts(FoxgloveSession& owner)
    : session(owner), board([this](const BoardReply& reply) { takeUnasked(reply); }) {}

void FoxgloveSession::Parts::greet(const std::string& token) {
  ask("HELLO ortung/1 name=" +
          (token.empty() ? "foxglove role=viewer" : "view role=operator token=" + token),
      [this](const BoardReply& reply) {
        if (!reply.isOk()) {
          tell(Level::kError, "the board refuses: " + reply.text());
          session.isOver = true;
          return;
        }
        now = reply.number("now", 0);
      });
  ask("DESCRIBE world", [this](const BoardReply& reply) { takeWorld(reply); });
}

void FoxgloveSession::Parts::takeWorld(const BoardReply& reply) {
  if (session.isOver) return;
  const BoardReply about = foxglove::parseBoardLine(reply.lines.empty() ? "" : reply.lines.front());
  const auto textOf = [&](const char* key) {
    const auto found = about.keys.find(key);
    return found == about.keys.end() ? std::string() : found->second;
  };
  kind = textOf("kind");
  if (about.keys.contains("start_us") && about.keys.contains("end_us")) {
    start = about.number("start_us", 0);
    end = about.number("end_us", 0);
  }
  sendInfo(textOf("world"));
  ask("DESCRIBE field", [this, about](const BoardReply& field) { takeField(about, field); });
  // These events, once a second, are the occasions on which new robots are found.
  ask("SUBSCRIBE robot=0 period_s=1 form=binary world/truth/robots",
      [this](const BoardReply& answer) { hasWorldTruth = answer.isOk(); });
  list();
}

/// Advertises the map. Clients expect a first advertisement even if there is no map.
void FoxgloveSession::Parts::takeField(const BoardReply& world, const BoardReply& reply) {
  const auto map = foxglove::mapOfField(world, reply.lines);
  if (!map) return advertise({});
  const std::uint32_t channel = channelFor({"/map", ros2::OccupancyGrid::kType, true, ""});
  channels[channel].latched[0] = ros2::toCdr(*map);
  ++channels[channel].users;
  advertise({channel});
}

void FoxgloveSession::Parts::list() {
  if (isListing) return;
  isListing = true;
  listed = now;
  ask("LIST robots", [this](const BoardReply& reply) { takeRobots(reply); });
}

void FoxgloveSession::Parts::takeRobots(const BoardReply& reply) {
  isListing = false;
  isCrowded = isCrowded || kind == "simulation" || reply.lines.size() > 1;
  std::set<std::int64_t> there;
  for (const std::string& line : reply.lines) {
    const BoardReply one = foxglove::parseBoardLine(line);
    const std::int64_t number = one.number("robot", 0);
    if (number <= 0) continue;
    there.insert(number);
    if (robots.contains(number)) continue;
    robots[number];
    const auto name = one.keys.find("name");
    ask("DESCRIBE robot robot=" + std::to_string(number),
        [this, number, text = name == one.keys.end() ? "" : name->second](
            const BoardReply& description) { takeRobot(number, text, description); });
  }
  for (auto robot = robots.begin(); robot != robots.end();) {
    const std::int64_t number = (robot++)->first;
    if (!there.contains(number)) removeRobot(number);
  }
}

void FoxgloveSession::Parts::takeRobot(std::int64_t number, const std::string& name,
                                       const BoardReply& reply) {
  const auto found = robots.find(number);
  if (found == robots.end() || !reply.isOk()) return;
  RobotPart& part = found->second;
  const std::string own = name.empty() ? "robot" + std::to_string(number) : name;
  part.robot = foxglove::describedRobot(reply.lines, {.robot = isCrowded ? own : ""});
  std::vector<std::uint32_t> fresh;
  for (const ros2::Topic& topic : part.robot->topics->topics()) {
    const std::uint32_t channel = channelFor(topic);
    part.channels.push_back(channel);
    if (channels[channel].users++ == 0) fresh.push_back(channel);
  }
  advertise(fresh);
  part.robot->topics->start(now, [&](std::size_t topic, Timestamp, std::string_view cdr) {
    Channel& channel = channels[part.channels[topic]];
    channel.latched[number] = cdr;
    if (channel.subscription)
      sendBinary(foxglove::messageFrame(
          *channel.subscription, static_cast<std::uint64_t>(std::max<Timestamp>(now, 0)) * 1000,
          cdr));
  });
  subscribeAtBoard();
}

void FoxgloveSession::Parts::removeRobot(std::int64_t number) {
  const auto found = robots.find(number);
  if (found == robots.end()) return;
  std::string gone;
  for (const std::uint32_t id : found->second.channels) {
    Channel& channel = channels[id];
    channel.latched.erase(number);
    if (--channel.users > 0) continue;
    gone += (gone.empty() ? "" : ",") + std::to_string(id);
    if (channel.subscription) subscriptions.erase(*channel.subscription);
    channelOf.erase(channel.topic);
    channels.erase(id);
  }
  robots.erase(found);
  if (!gone.empty()) sendText(R"({"op":"unadvertise","channelIds":[)" + gone + "]}");
}

void FoxgloveSession::Parts::takeUnasked(const BoardReply& reply) {
  const std::string verb = reply.words.size() > 1 ? reply.words[1] : "";
  now = reply.number("now", now);
  if (verb == "UPDATE") {
    takeReadings(reply.number("robot", 0), reply);
    if (std::abs(now - listed) >= kListPeriod) list();
    if (now >= 0) sendBinary(foxglove::timeFrame(static_cast<std::uint64_t>(now) * 1000));
    const bool isAtEnd = end && now >= *end;
    if (isAtEnd && !isEndTold && isPlaybackWatched)
      ask("STATUS", [this](const BoardReply& status) { tellPlayback(status, false, ""); });
    isEndTold = isAtEnd;
  } else if (verb == "REMOVE") {
    removeRobot(reply.number("robot", 0));
  } else if (verb == "BYE" || verb == "ERR") {
    session.isOver = true;
  }
}

void FoxgloveSession::Parts::takeReadings(std::int64_t number, const BoardReply& reply) {
  std::string_view bytes = reply.bytes;
  std::vector<Message> frame;
  while (auto message = parseBinary(bytes)) {
    if (message->id == kWorldTruth) {
      takeWorldTruth(*message);
      continue;
    }
    if (!frame.empty() && frame.front().stamp != message->stamp) give(number, frame);
    frame.push_back(std::move(*message));
  }
  give(number, frame);
}

/// Takes the world's truth, five words a robot: number, x, y, heading without an offset, states.
/// Robots with a feature for their ground truth are left out.
void FoxgloveSession::Parts::takeWorldTruth(const Message& message) {
  constexpr std::size_t kWords = 5;
  if (!isTruthAsked) return;
  for (std::size_t i = 0; i + kWords <= message.words.size(); i += kWords) {
    const std::uint32_t* words = &message.words[i];
    const auto part = robots.find(words[0]);
    if (part == robots.end() || !part->second.robot || part->second.robot->hasTruth) continue;
    const Pose2 pose{words::toSignedMetres(words[1]), words::toSignedMetres(words[2]),
                     wrapAngle(radians(words[3] % words::kAngles / 100.0))};
    std::vector<Message> frame{{message.stamp, kTruth, PoseData::encode(pose)}};
    give(words[0], frame);
  }
}

/// Sends those of the readings of one time to which the client has subscribed.
void FoxgloveSession::Parts::give(std::int64_t number, std::vector<Message>& frame) {
  const auto part = robots.find(number);
  const std::vector<Message> readings = std::move(frame);
  frame.clear();
  if (readings.empty() || part == robots.end() || !part->second.robot) return;
  const auto sink = [&](std::size_t topic, Timestamp stamp, std::string_view cdr) {
    if (topic >= part->second.channels.size())
      return;  // a topic of a feature that was not described
    const Channel& channel = channels[part->second.channels[topic]];
    if (channel.subscription)
      sendBinary(foxglove::messageFrame(*channel.subscription,
                                        static_cast<std::uint64_t>(stamp) * 1000, cdr));
  };
  try {
    part->second.robot->topics->take(readings, sink);
  } catch (const std::invalid_argument& error) {
    tell(Level::kWarning, error.what());
  }
}

bool FoxgloveSession::Parts::wantsWorldTruth() const {
  for (const auto& [number, part] : robots) {
    if (!part.robot || part.robot->hasTruth) continue;
    for (std::size_t topic = 0; topic < part.channels.size(); ++topic) {
      if (!channels.at(part.channels[topic]).subscription) continue;
      for (const std::string& feature : part.robot->topics->featuresOf(topic))
        if (feature == "*/groundTruth/*") return true;
    }
  }
  return false;
}

std::string FoxgloveSession::Parts::queriesOf(const RobotPart& part) const {
  constexpr std::size_t kMostQueries = 200;  // a line has 256 words at most
  std::set<std::string> features;
  for (std::size_t topic = 0; topic < part.channels.size(); ++topic) {
    if (!channels.at(part.channels[topic]).subscription) continue;
    for (const std::string& feature : part.robot->topics->featuresOf(topic))
      features.insert(feature);
  }
  if (features.size() > kMostQueries) return " */*/*";
  std::string text;
  for (const std::string& feature : features) text += " " + feature;
  return text;
}

/// Subscribes at the board to the features to which the client has subscribed.
void FoxgloveSession::Parts::subscribeAtBoard() {
  const auto heed = [this](const BoardReply& reply) {
    if (!reply.isOk()) tell(Level::kWarning, "the board refuses a subscription: " + reply.text());
  };
  for (auto& [number, part] : robots) {
    if (!part.robot) continue;
    const std::string queries = queriesOf(part);
    if (queries == part.asked) continue;
    part.asked = queries;
    const std::string robot = " robot=" + std::to_string(number);
    queries.empty() ? ask("UNSUBSCRIBE" + robot, [](const BoardReply&) {})
                    : ask("SUBSCRIBE" + robot + " form=binary" + queries, heed);
  }
  const bool isWanted = hasWorldTruth && wantsWorldTruth();
  if (isWanted == isTruthAsked) return;
  isTruthAsked = isWanted;
  ask(std::string("SUBSCRIBE robot=0") + (isWanted ? "" : " period_s=1") +
          " form=binary world/truth/robots",
      [](const BoardReply&) {});
}

}  // namespace ortung
