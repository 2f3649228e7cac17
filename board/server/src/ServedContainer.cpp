#include "ortung/server/ServedContainer.hpp"

#include "Request.hpp"

namespace ortung {
namespace {

constexpr RobotId kRobot = 1;
constexpr double kShortestPeriod = 0.001;  // [s]
constexpr double kLongestPeriod = 10.0;    // [s]

[[noreturn]] void refuse(const std::string& what) {
  throw ServeError("live", "this is a running robot: " + what);
}

}  // namespace

void ServedContainer::Config::check() const {
  if (!server::isName(robot))
    throw std::invalid_argument("the robot's name is '" + robot +
                                "', expected 1 to 32 of [A-Za-z0-9_-]");
  if (!(period >= kShortestPeriod && period <= kLongestPeriod))
    throw std::invalid_argument("the period of looks is " + std::to_string(period) +
                                " s, must be in [0.001, 10]");
}

ServedContainer::ServedContainer(const SensorContainer& container, std::function<Timestamp()> clock,
                                 const Config& config, RobotCommands* commands)
    : container_(container),
      clock_(std::move(clock)),
      config_(config),
      commands_(commands),
      seen_(container.all().size(), 0) {
  config_.check();
  if (!clock_) throw std::invalid_argument("a served robot needs the clock of its readings");
}

ServedContainer::~ServedContainer() = default;

WorldDescription ServedContainer::describe() const {
  return {config_.robot, config_.fingerprint, "robot"};
}

void ServedContainer::step() {
  frame_.clear();
  const SensorContainer::ReadLock lock = container_.read();
  const auto features = container_.all();
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const SensorData& data = *features[i];
    if (data.sequence() == seen_[i]) continue;
    seen_[i] = data.sequence();
    const std::span<const std::uint32_t> words = data.getData();
    frame_.push_back({data.stamp(), data.id(), {words.begin(), words.end()}});
  }
}

std::vector<Resident> ServedContainer::residents() const {
  return {{kRobot, config_.robot, servedFeatures(container_)}};
}

void ServedContainer::check(RobotId robot) {
  if (robot != kRobot) throw ServeError("no-robot", "there is no robot " + std::to_string(robot));
}

std::vector<std::string> ServedContainer::abilities(RobotId robot) const {
  check(robot);
  return config_.abilities;
}

void ServedContainer::want(RobotId robot, std::span<const SensorId> features) {
  if (robot == kRobot && config_.onWant) config_.onWant(features);
}

std::span<Message> ServedContainer::readings(RobotId robot) {
  check(robot);
  return frame_;
}

RobotCommands& ServedContainer::commands(RobotId robot) {
  check(robot);
  if (commands_ == nullptr) refuse("it takes no commands from clients");
  return *commands_;
}

ServedRobot ServedContainer::addRobot(RobotId, RobotWish) { refuse("no other can join it"); }

void ServedContainer::removeRobot(RobotId robot) {
  check(robot);
  refuse("it can't be removed");
}

void ServedContainer::reset(std::optional<std::uint64_t>) {
  refuse("its time does not start over");
}

void ServedContainer::placeRobot(RobotId robot, const Pose2&) {
  check(robot);
  refuse("it goes where it drives");
}

void ServedContainer::placeObject(const std::string&, const Pose2&) {
  refuse("what is around it can't be placed");
}

}  // namespace ortung
