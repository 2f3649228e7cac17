#include "ortung/server/ServedRecord.hpp"

#include "ortung/motion/MotionModel.hpp"
#include "ortung/server/RobotPlugins.hpp"

namespace ortung {
namespace {

// A robot file names sensors and motion, too; for a record only the data plugins are made.
constexpr std::string_view kInterfaces[] = {SensorData::kInterface, MotionModel::kInterface};
constexpr Timestamp kPause = 100'000;  // pause between the end of a record and its repetition [us]

}  // namespace

struct ServedRecord::Guest {
  SensorContainer container;  ///< knows which features the robot has, and checks their words
  std::vector<Message> frame;
};

ServedRecord::ServedRecord(std::filesystem::path file, bool repeats)
    : file_(std::move(file)),
      repeats_(repeats),
      factory_(PluginFactory::standardFolders()),
      plugins_(robotPlugins(factory_, kInterfaces)) {
  open();
  if (isAtEnd_) throw std::runtime_error(file_.string() + ": has no readings");
}

ServedRecord::~ServedRecord() = default;

void ServedRecord::open() {
  source_ = std::make_unique<RecordSource>(file_);
  reader_ = std::make_unique<FrameReader>(*source_);
  isAtEnd_ = false;
  readAhead();
}

void ServedRecord::readAhead() {
  if (!reader_->next(ahead_)) {
    isAtEnd_ = true;
    return;
  }
  now_ = ahead_.front().stamp + shift_;
}

WorldDescription ServedRecord::describe() const {
  return {file_.stem().string(), source_->worldFingerprint(), "record"};
}

void ServedRecord::step() {
  hasBegun_ = true;
  for (auto& [id, guest] : guests_) {
    guest->frame.clear();
    for (Message& message : ahead_) {
      SensorData* data = guest->container.findExactly(message.id);
      if (data == nullptr) continue;
      try {
        data->setData(now_, message.words);
      } catch (const std::invalid_argument& error) {
        throw std::runtime_error(file_.string() + ": reading at " + std::to_string(now_) +
                                 " us: " + error.what());
      }
      guest->frame.push_back({now_, message.id, message.words});
    }
  }
  const Timestamp last = now_;
  readAhead();
  if (isAtEnd_ && repeats_) {
    shift_ = 0;
    open();
    shift_ = last + kPause - now_;
    now_ += shift_;
  }
}

ServedRobot ServedRecord::addRobot(RobotId robot, RobotWish wish) {
  auto guest = std::make_unique<Guest>();
  fillContainer(guest->container, wish.config, factory_);
  std::vector<ServedFeature> features = servedFeatures(guest->container);
  guests_[robot] = std::move(guest);
  return {std::move(features)};
}

void ServedRecord::removeRobot(RobotId robot) { guests_.erase(robot); }

void ServedRecord::check(RobotId robot) const {
  if (!guests_.contains(robot))
    throw ServeError("no-robot", "there is no robot " + std::to_string(robot));
}

RobotCommands& ServedRecord::commands(RobotId robot) {
  check(robot);
  return deaf_;
}

std::span<Message> ServedRecord::readings(RobotId robot) {
  check(robot);
  return guests_.at(robot)->frame;
}

void ServedRecord::reset(std::optional<std::uint64_t>) {
  shift_ = 0;
  hasBegun_ = false;
  open();
}

void ServedRecord::placeRobot(RobotId, const Pose2&) {
  throw ServeError("record", "what happened in a record can't be changed");
}

void ServedRecord::placeObject(const std::string&, const Pose2&) {
  throw ServeError("record", "what happened in a record can't be changed");
}

}  // namespace ortung
