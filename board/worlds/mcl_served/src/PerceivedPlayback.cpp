#include "ortung/mcl_served/PerceivedPlayback.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

namespace ortung {
namespace {

/// What a jump on the time line finds, too; a reading that is older says nothing of now.
constexpr Timestamp kLast = 3'000'000;  // [us]

/// The newest readings of one robot.
struct Moment {
  struct Newest {
    Message message;
    std::uint64_t number = 0;  ///< which reading it is, of all that were taken
  };
  std::vector<Newest> readings;
  std::uint64_t turn = 0;  ///< raised when a feature is left without a reading
};

/// The robot that perceives them.
struct Perceiver {
  std::shared_ptr<Robot> robot;
  std::uint64_t turn = 0;
  std::uint64_t number = 0;  ///< newest reading that it has
};

}  // namespace

struct PerceivedPlayback::Parts {
  Config config;
  std::vector<SensorId> features;  ///< features of the robot file
  std::size_t robots = 0;

  std::mutex mutex;  ///< guards moments
  std::vector<Moment> moments;
  std::uint64_t taken = 0;

  std::mutex perceiverMutex;
  std::vector<Perceiver> perceivers;

  std::mutex tableMutex;
  std::shared_ptr<const RobotTables> tables;
  std::string failure;
  std::atomic<double> share{0.0};
  std::atomic<bool> isLearning{false};
  std::jthread learning;  ///< last member: it ends before what it uses

  void check(RobotId robot) const {
    if (robot == 0 || robot > robots)
      throw ServeError("no-robot", "there is no robot " + std::to_string(robot));
  }

  bool has(const SensorId& id) const {
    return std::find(features.begin(), features.end(), id) != features.end();
  }

  void take(Moment& moment, std::span<const Message> frame, Timestamp now) {
    for (const Message& message : frame) {
      if (!has(message.id)) continue;
      auto place =
          std::find_if(moment.readings.begin(), moment.readings.end(),
                       [&](const Moment::Newest& one) { return one.message.id == message.id; });
      if (place == moment.readings.end()) place = moment.readings.emplace(place);
      *place = {message, ++taken};
    }
    if (std::erase_if(moment.readings, [&](const Moment::Newest& one) {
          return one.message.stamp < now - kLast;
        }) > 0)
      ++moment.turn;
  }

  /// What the perceiver does not have yet, oldest first.
  std::vector<Message> news(RobotId robot, Perceiver& its) {
    const std::lock_guard lock(mutex);
    const Moment& moment = moments[robot - 1];
    if (!its.robot || its.turn != moment.turn) its = {nullptr, moment.turn, 0};
    std::vector<Message> frame;
    for (const Moment::Newest& one : moment.readings)
      if (one.number > its.number) frame.push_back(one.message);
    its.number = taken;
    std::stable_sort(frame.begin(), frame.end(),
                     [](const Message& a, const Message& b) { return a.stamp < b.stamp; });
    return frame;
  }

  std::shared_ptr<const RobotTables> learn(const std::function<bool(double)>& goOn) {
    return config.tables(*openRobot(config.robot), [&](double done) {
      share = done;
      return goOn(done);
    });
  }

  void learnBeside() {
    learning = std::jthread([this](const std::stop_token& stop) {
      try {
        const auto found = learn([&](double) { return !stop.stop_requested(); });
        const std::lock_guard lock(tableMutex);
        tables = found;
      } catch (const std::exception& error) {
        const std::lock_guard lock(tableMutex);
        failure = error.what();
      }
    });
  }

  /// @throws ServeError while there are none
  std::shared_ptr<const RobotTables> readyTables() {
    const std::lock_guard lock(tableMutex);
    if (tables) return tables;
    if (!failure.empty()) throw ServeError("state", "there are no tables: " + failure);
    if (!isLearning.exchange(true)) learnBeside();
    throw ServeError("state", "tables are being learned, " +
                                  std::to_string(std::lround(100.0 * share)) + " % are done");
  }
};

PerceivedPlayback::PerceivedPlayback(ServedWorld& playback, Config config)
    : ForwardedWorld(playback), parts_(std::make_unique<Parts>()) {
  parts_->config = std::move(config);
  const std::unique_ptr<Robot> robot = openRobot(parts_->config.robot);
  for (const auto& data : robot->container.all()) parts_->features.push_back(data->id());
  parts_->robots = playback.residents().size();
  parts_->moments.resize(parts_->robots);
  parts_->perceivers.resize(parts_->robots);
  seek(now());
}

PerceivedPlayback::~PerceivedPlayback() = default;

bool PerceivedPlayback::fetchTables(const std::function<bool(double)>& goOn) {
  const auto found = parts_->learn(goOn);
  const std::lock_guard lock(parts_->tableMutex);
  parts_->tables = found;
  return found != nullptr;
}

std::optional<RobotId> PerceivedPlayback::usual() const {
  return parts_->robots == 1 ? std::optional<RobotId>(1) : std::nullopt;
}

std::shared_ptr<const Robot> PerceivedPlayback::perceiver(RobotId robot) const {
  parts_->check(robot);
  const std::shared_ptr<const RobotTables> tables = parts_->readyTables();
  const std::lock_guard lock(parts_->perceiverMutex);
  Perceiver& its = parts_->perceivers[robot - 1];
  const std::vector<Message> news = parts_->news(robot, its);
  try {
    if (!its.robot) its.robot = openRobot(parts_->config.robot, *tables);
    its.robot->container.set(news);
  } catch (const std::invalid_argument& error) {
    its = {};
    throw ServeError("record", error.what());
  }
  return its.robot;
}

void PerceivedPlayback::step() {
  world().step();
  const std::lock_guard lock(parts_->mutex);
  for (RobotId robot = 1; robot <= parts_->robots; ++robot)
    parts_->take(parts_->moments[robot - 1], world().readings(robot), now());
}

void PerceivedPlayback::seek(Timestamp stamp) {
  world().seek(stamp);
  const std::lock_guard lock(parts_->mutex);
  for (RobotId robot = 1; robot <= parts_->robots; ++robot) {
    Moment& moment = parts_->moments[robot - 1];
    moment.readings.clear();
    ++moment.turn;
    parts_->take(moment, world().readings(robot), now());
  }
}

void PerceivedPlayback::reset(std::optional<std::uint64_t>) { seek(0); }

}  // namespace ortung
