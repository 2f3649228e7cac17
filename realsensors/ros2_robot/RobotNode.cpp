#include "RobotNode.hpp"

#include <algorithm>
#include <stdexcept>

#include "BoardReplies.hpp"
#include "FieldMap.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::size_t kMostMapCells = std::size_t{1} << 22;
constexpr std::size_t kMostReasons = 64;
constexpr std::string_view kTruth = "/ground_truth";
constexpr std::string_view kMap = "/map";

bool isFrames(const Topic& topic) { return topic.type == TfMessage::kType; }

/// Topics of no feature that the robot is known to have, such as those of a localization; words.
bool isOfferedLater(const Topic& topic) {
  const bool isShared = isFrames(topic) || topic.name == kMap || topic.name == kTruth;
  return !isShared && (topic.format.empty() || topic.type == Words::kType);
}

}  // namespace

RobotNode::RobotNode(const Options& options, const BoardText& board, Participant& node)
    : options_(options), node_(node) {
  robot_ = foxglove::describedRobot(board.robot, {.mapFrame = options_.mapFrame,
                                                  .base = options_.base,
                                                  .odom = options_.odom,
                                                  .framePrefix = options_.framePrefix});
  if (options_.tellsMap && !board.world.empty())
    map_ = foxglove::mapOfField(
        foxglove::parseBoardLine(board.world.front()), board.field,
        {.mostCells = kMostMapCells, .height = options_.mapHeight, .isBehindSurfaces = true});
  if (options_.tellsClock) clock_ = node_.publish("/clock", RosClock::kType, Qos::kDefault);
  for (std::size_t i = 0; i < robot_->topics->topics().size(); ++i)
    if (const Topic& topic = robot_->topics->topics()[i]; isWanted(topic) && !isOfferedLater(topic))
      offer(i);
}

std::string RobotNode::nameOf(const Topic& topic) const {
  const bool isShared = isFrames(topic) || topic.name == kMap;
  if (isShared && !options_.framePrefix.empty()) return topic.name;
  return topic.name.substr(1);
}

bool RobotNode::isWanted(const Topic& topic) const {
  if (topic.name == kTruth) return options_.tellsTruth;
  if (topic.name == kMap) return map_.has_value();
  if (topic.feature.empty()) return true;
  return std::any_of(options_.features.begin(), options_.features.end(),
                     [&](const std::string& query) {
                       return matches(parseSensorQuery(query), parseSensorId(topic.feature));
                     });
}

void RobotNode::offer(std::size_t topic) {
  const Topic& one = robot_->topics->topics()[topic];
  names_[topic] = nameOf(one);
  senders_[topic] =
      node_.publish(names_[topic], one.type, one.isLatched ? Qos::kLatched : Qos::kDefault);
}

std::string RobotNode::queries() const {
  std::string text;
  for (const std::string& query : options_.features) text += query + " ";
  const bool isLocalized = options_.mapFrame == RobotTopics::MapFrame::kBest;
  const bool needsTruth = options_.mapFrame == RobotTopics::MapFrame::kTruth;
  if (isLocalized) text += "mcl/LOCALIZATION/* ";
  if (options_.tellsTruth || needsTruth || isLocalized) text += "*/groundTruth/* ";
  text.pop_back();
  return text;
}

std::vector<std::string> RobotNode::topics() const {
  std::vector<std::string> names;
  for (const auto& [topic, name] : names_) names.push_back(name);
  return names;
}

RobotTopics::Sink RobotNode::collector() {
  return [this](std::size_t topic, Timestamp, std::string_view cdr) {
    told_.push_back({topic, std::string(cdr)});
  };
}

/// Sends what was collected, frames first: a subscriber may look up a reading's pose at once.
void RobotNode::send() {
  const std::vector<Topic>& topics = robot_->topics->topics();
  std::stable_partition(told_.begin(), told_.end(),
                        [&](const Told& one) { return isFrames(topics[one.topic]); });
  for (Told& one : told_) {
    const Topic& topic = topics[one.topic];
    if (!isWanted(topic)) continue;
    if (!senders_.contains(one.topic)) offer(one.topic);
    // Since Iron a range ends with its variance; 0: not known.
    if (topic.type == Range::kType && options_.distro != Distro::kHumble)
      one.cdr.append(sizeof(float), '\0');
    senders_[one.topic](one.cdr);
  }
  told_.clear();
}

void RobotNode::start(Timestamp now) {
  robot_->topics->start(now, collector());
  if (map_) robot_->topics->show(*map_, now, collector());
  send();
}

void RobotNode::tellReadings(std::span<const Message> moment) {
  try {
    robot_->topics->take(moment, collector());
  } catch (const std::invalid_argument& error) {
    if (leftOut_.size() < kMostReasons || leftOut_.contains(error.what())) ++leftOut_[error.what()];
  }
  send();
}

void RobotNode::tell(Timestamp now, const std::vector<Message>& readings) {
  Timestamp newest = now;
  for (const Message& reading : readings) newest = std::max(newest, reading.stamp);
  if (clock_ && newest >= 0 && toldClock_ != newest) {
    clock_(toCdr(RosClock{newest * 1000}));
    toldClock_ = newest;
  }
  for (auto first = readings.begin(); first != readings.end();) {
    const auto end = std::find_if(first, readings.end(),
                                  [&](const Message& one) { return one.stamp != first->stamp; });
    tellReadings({first, end});
    first = end;
  }
}

}  // namespace ortung::ros2
