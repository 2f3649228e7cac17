#include "ortung/sim/SimRobot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "CheckedDrive.hpp"
#include "CheckedSensor.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/PoseData.hpp"
#include "ortung/formats/TalkData.hpp"

namespace ortung {
namespace {

// Streams of a robot's random numbers. Sensors have those from kFirstSensor on, so that a further
// sensor does not change the readings of the others.
constexpr std::uint64_t kOdometryStream = 0;
constexpr std::uint64_t kSlipStream = 1;
constexpr std::uint64_t kFirstSensor = 16;

constexpr const char* kDefaultDrive = "differential";
constexpr std::size_t kMostProblems = 100;

bool isGroundTruth(const SensorData& data) { return data.id().type == "groundTruth"; }

/// Returns a velocity in the frame of a robot with this heading [rad].
Twist toRobot(const Twist& inField, double heading) {
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  return {c * inField.x + s * inField.y, c * inField.y - s * inField.x, inField.theta};
}

/// Returns the index of the state with this name, or else with this number.
std::optional<std::size_t> findState(const Manipulator& manipulator, std::string_view state) {
  if (const auto named = manipulator.find(state)) return named;
  for (std::size_t i = 0; i < manipulator.states.size(); ++i)
    if (state == std::to_string(i)) return i;
  return std::nullopt;
}

}  // namespace

struct SimRobot::Mounted {
  std::unique_ptr<Sensor> sensor;  ///< null once it has thrown
  std::vector<SensorData*> data;
  /// Sequence number of each feature's last reading that was sent.
  std::vector<std::uint64_t> seen;
  Random random;
  Timestamp period = 0;
  Timestamp due = 0;
  /// Time of a reading that is generated when somebody asks for it.
  std::optional<Timestamp> postponed = std::nullopt;
  bool isOnDemand = false;
  bool isInput = false;      ///< whether another feature is derived from its readings
  std::vector<char> wanted;  ///< whether each feature is wanted
  bool senses() const {
    return sensor && (!isOnDemand || isInput ||
                      std::find(wanted.begin(), wanted.end(), char{1}) != wanted.end());
  }
};

SimRobot::SimRobot(const RobotConfig& config, PluginFactory& factory, const Pose2& start,
                   const Random& random, bool noise)
    : config_(config),
      shape_(RobotShape::read(config_)),
      odometryRandom_(random.fork(kOdometryStream)),
      slipRandom_(random.fork(kSlipStream)),
      noise_(noise),
      manipulatorStates_(shape_.manipulators.size(), 0),
      wantedStates_(shape_.manipulators.size(), 0),
      enteredAt_(shape_.manipulators.size(), 0) {
  const std::string plugin = config_.drive.textOr("plugin", kDefaultDrive);
  drive_ = std::make_unique<CheckedDrive>(factory.make<Drive>(plugin, config_.drive), plugin,
                                          config_.name);
  state_.pose = start;
  const std::vector<Device> devices = fillContainer(container_, config_, factory);
  extracts_ = std::any_of(devices.begin(), devices.end(),
                          [](const Device& device) { return device.hasExtractor; });
  bool hasTruth = false;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const Device& device = devices[i];
    hasTruth = hasTruth || std::any_of(device.data.begin(), device.data.end(),
                                       [](SensorData* data) { return isGroundTruth(*data); });
    std::copy_if(device.data.begin(), device.data.end(), std::back_inserter(ears_),
                 [](SensorData* data) { return isOf(*data, formats::kTalk); });
    auto sensor = makeSensor(device, factory, config_.name);
    const Timestamp period = sensor ? fromSeconds(sensor->period()) : 0;
    const bool isOnDemand = sensor && sensor->isOnDemand();
    sensors_.push_back({std::move(sensor), device.data,
                        std::vector<std::uint64_t>(device.data.size(), 0),
                        random.fork(kFirstSensor + i), period, 0, std::nullopt, isOnDemand, false,
                        std::vector<char>(device.data.size(), 0)});
  }
  markInputs();
  if (!hasTruth) truth_ = container_.find(SensorQuery{.type = "groundTruth"});
}

SimRobot::~SimRobot() = default;

void SimRobot::report(Timestamp now, const std::string& what) {
  if (problems_.size() < kMostProblems)
    problems_.push_back("at " + std::to_string(toSeconds(now)) + " s: " + what);
}

/// Marks the sensors from whose readings other features are derived.
void SimRobot::markInputs() {
  for (const auto& made : container_.all())
    for (const SensorData* input : container_.inputsOf(*made))
      for (Mounted& mounted : sensors_)
        mounted.isInput = mounted.isInput || std::find(mounted.data.begin(), mounted.data.end(),
                                                       input) != mounted.data.end();
}

void SimRobot::setWanted(const SensorQuery& query, bool wanted) {
  for (Mounted& mounted : sensors_)
    for (std::size_t i = 0; i < mounted.data.size(); ++i)
      if (matches(query, mounted.data[i]->id())) mounted.wanted[i] = wanted ? 1 : 0;
}

double SimRobot::raysPerSecond(double cycle) const {
  double sum = 0.0;
  for (const Mounted& mounted : sensors_)
    if (mounted.sensor) sum += mounted.sensor->rays() / std::max(toSeconds(mounted.period), cycle);
  return sum;
}

double SimRobot::raysAtOnce() const {
  double sum = 0.0;
  for (const Mounted& mounted : sensors_)
    if (mounted.sensor) sum += mounted.sensor->rays();
  return sum;
}

/// Returns whether a sensor has to sense now.
bool SimRobot::takeDue(Mounted& mounted, Timestamp now) {
  if (!mounted.sensor) return false;
  const bool isDue = now >= mounted.due;
  // Keeps the rate even if the period is not a multiple of the cycle; at most one reading per
  // cycle.
  if (isDue) mounted.due = std::max(mounted.due + mounted.period, now + 1);
  nextDue_ = std::min(nextDue_, mounted.due);
  return isDue && mounted.senses();
}

std::span<Message> SimRobot::sense(const World& world, Timestamp now) {
  inFrame_ = 0;
  if (now < nextDue_ && !hasHeard_) return {};
  nextDue_ = std::numeric_limits<Timestamp>::max();
  for (Mounted& mounted : sensors_)
    if (takeDue(mounted, now)) generate(mounted, world, now);
  return frame(now);
}

std::span<Message> SimRobot::postpone(const World& world, Timestamp now) {
  inFrame_ = 0;
  if (now >= nextDue_) {
    nextDue_ = std::numeric_limits<Timestamp>::max();
    for (Mounted& mounted : sensors_)
      if (takeDue(mounted, now)) mounted.postponed = now;
  }
  return hasHeard_ ? sensePostponed(world, now) : std::span<Message>{};
}

bool SimRobot::hasPostponed(Timestamp time) const {
  return std::any_of(sensors_.begin(), sensors_.end(),
                     [&](const Mounted& mounted) { return mounted.postponed == time; });
}

std::optional<Timestamp> SimRobot::firstPostponed() const {
  std::optional<Timestamp> first;
  for (const Mounted& mounted : sensors_)
    if (mounted.postponed && (!first || *mounted.postponed < *first)) first = mounted.postponed;
  return first;
}

std::span<Message> SimRobot::sensePostponed(const World& world, Timestamp time) {
  inFrame_ = 0;
  for (Mounted& mounted : sensors_) {
    if (mounted.postponed != time) continue;
    mounted.postponed.reset();
    if (mounted.sensor) generate(mounted, world, time);
  }
  return frame(time);
}

SensorContainer& SimRobot::container() {
  if (whenRead_) std::exchange(whenRead_, nullptr)();
  return container_;
}
const SensorContainer& SimRobot::container() const {
  if (whenRead_) std::exchange(whenRead_, nullptr)();
  return container_;
}

/// Completes the messages of a moment.
std::span<Message> SimRobot::frame(Timestamp now) {
  if (std::exchange(hasHeard_, false))
    for (Mounted& mounted : sensors_) collect(mounted, now);
  extract(now);
  if (inFrame_ > 0) addGroundTruth(now);
  return {frame_.data(), inFrame_};
}

Message& SimRobot::nextMessage() {
  if (inFrame_ == frame_.size()) frame_.emplace_back();
  return frame_[inFrame_++];
}

void SimRobot::generate(Mounted& mounted, const World& world, Timestamp now) {
  std::optional<Random> ofNow;
  if (noiseByTime_) ofNow = mounted.random.fork(static_cast<std::uint64_t>(now));
  Random* noise = ofNow ? &*ofNow : &mounted.random;
  try {
    mounted.sensor->generateData(world, state_, noise_ ? noise : nullptr, now, mounted.data);
    collect(mounted, now);
  } catch (const PluginFailure& failure) {
    mounted.sensor.reset();
    report(now, std::string(failure.what()) + "; it is switched off");
  }
}

void SimRobot::hear(Timestamp now, std::span<const Heard> said) {
  if (ears_.empty() || said.empty()) return;
  TalkData::Reading reading{config_.name, {}};
  for (const Heard& one : said.last(std::min(said.size(), TalkData::kMostMessages)))
    reading.messages.push_back({toSeconds(now - one.stamp), one.from, one.text});
  const std::vector<std::uint32_t> words = TalkData::encode(reading);
  for (SensorData* ear : ears_) ear->setData(now, words);
  hasHeard_ = true;
}

/// Extracts derived features, after all sensors have sensed, in any order of the file.
void SimRobot::extract(Timestamp now) {
  if (!extracts_ || inFrame_ == 0) return;
  try {
    container_.extract();
  } catch (const ExtractorError& error) {
    extracts_ = false;
    report(now, "robot " + config_.name + ": " + error.what() +
                    "; derived features are no longer extracted");
  }
  for (Mounted& mounted : sensors_) collect(mounted, now);
}

/// Appends messages for new readings.
void SimRobot::collect(Mounted& mounted, Timestamp now) {
  for (std::size_t i = 0; i < mounted.data.size(); ++i) {
    const SensorData& data = *mounted.data[i];
    if (data.sequence() == mounted.seen[i]) continue;
    mounted.seen[i] = data.sequence();
    Message& message = nextMessage();
    message.stamp = now;
    message.id = data.id();
    const std::span<const std::uint32_t> words = data.getData();
    message.words.assign(words.begin(), words.end());
  }
}

void SimRobot::addGroundTruth(Timestamp now) {
  if (truth_ == nullptr) return;
  PoseData::encode(state_.pose, truthWords_);
  truth_->setData(now, truthWords_);
  Message& message = nextMessage();
  message.stamp = now;
  message.id = truth_->id();
  message.words = truthWords_;
}

/// Passes a command to the drive. A failure of the drive is thrown to the caller and added to
/// problems().
template <class Command>
void SimRobot::command(const Command& command) {
  if (!driveWorks_)
    throw PluginFailure("robot " + config_.name + ": its drive has failed and is switched off");
  try {
    command();
  } catch (const PluginFailure& failure) {
    switchDriveOff(failure);
    throw;
  }
}

void SimRobot::setTranslationalVelocity(double metresPerSecond) {
  command([&] { drive_->setTranslationalVelocity(metresPerSecond); });
  ++orders_;
}

void SimRobot::setRotationalVelocity(double radiansPerSecond) {
  command([&] { drive_->setRotationalVelocity(radiansPerSecond); });
  ++orders_;
}

void SimRobot::setMotion(std::span<const double> numbers) {
  command([&] { drive_->setCommand(numbers); });
  ++orders_;
}

template <class Command>
void SimRobot::Voice::command(const Command& command) {
  if (!robot_.driveWorks_) return;
  try {
    robot_.command(command);
  } catch (const PluginFailure&) {
    return;  // the drive is switched off, which problems() reports
  }
}

void SimRobot::Voice::setTranslationalVelocity(double metresPerSecond) {
  command([&] { robot_.drive_->setTranslationalVelocity(metresPerSecond); });
}

void SimRobot::Voice::setRotationalVelocity(double radiansPerSecond) {
  command([&] { robot_.drive_->setRotationalVelocity(radiansPerSecond); });
}

void SimRobot::Voice::setMotion(std::span<const double> numbers) {
  command([&] { robot_.drive_->setCommand(numbers); });
}

void SimRobot::Voice::setManipulator(std::string_view manipulator, std::string_view state) {
  robot_.setManipulator(manipulator, state);
}

SimRobot::WantedState SimRobot::findManipulator(std::string_view manipulator,
                                                std::string_view state) const {
  std::string known;
  for (std::size_t i = 0; i < shape_.manipulators.size(); ++i) {
    const Manipulator& one = shape_.manipulators[i];
    known += (known.empty() ? "" : ", ") + one.name;
    if (one.name != manipulator) continue;
    if (const auto found = findState(one, state)) return {i, *found};
    std::string states;
    for (const ManipulatorState& each : one.states)
      states += (states.empty() ? "" : ", ") + each.name;
    throw std::invalid_argument("robot " + config_.name + ": its manipulator " + one.name +
                                " has no state '" + std::string(state) + "'; it has " + states);
  }
  throw std::invalid_argument("robot " + config_.name + " has no manipulator '" +
                              std::string(manipulator) + "'; it has " +
                              (known.empty() ? "none" : known));
}

void SimRobot::setManipulator(std::string_view manipulator, std::string_view state) {
  const WantedState wanted = findManipulator(manipulator, state);
  wantedStates_[wanted.manipulator] = wanted.state;
}

std::optional<std::size_t> SimRobot::nextState(std::size_t manipulator, Timestamp now) {
  const std::size_t is = manipulatorStates_[manipulator];
  std::size_t& wanted = wantedStates_[manipulator];
  const auto& returnsAfter = shape_.manipulators[manipulator].states[is].returnsAfter;
  if (returnsAfter && wanted == is && now - enteredAt_[manipulator] >= fromSeconds(*returnsAfter))
    wanted = 0;
  if (wanted == is) return std::nullopt;
  return wanted;
}

void SimRobot::enterState(std::size_t manipulator, std::size_t state, Timestamp now) {
  manipulatorStates_[manipulator] = state;
  enteredAt_[manipulator] = now;
}

Pose2 SimRobot::plan(Timestamp now, double dt) {
  now_ = now;
  if (!driveWorks_) return {};
  try {
    if (isHeld_) {
      drive_->setTranslationalVelocity(0.0);
      drive_->setRotationalVelocity(0.0);
    }
    const Pose2 change = drive_->relocate(dt, noise_ ? &slipRandom_ : nullptr);
    drive_->velocity();  // called for its check: odometry may be derived from it
    return planned_ = change;
  } catch (const std::exception& error) {
    switchDriveOff(error);
  }
  return planned_ = {};
}

void SimRobot::move(const Pose2& pose, const Twist& velocity, bool wasDisturbed) {
  const Pose2 change = wasDisturbed ? inverse(state_.pose) * pose : planned_;
  state_.pose = pose;
  state_.velocity = velocity;
  if (!driveWorks_) return;
  try {
    if (wasDisturbed) drive_->setVelocity(toRobot(velocity, pose.theta));
    const Pose2 measured = drive_->measure(change, noise_ ? &odometryRandom_ : nullptr);
    const Twist told = drive_->measuredVelocity(noise_);
    const std::span<const std::uint32_t> motionData = drive_->motionData();
    state_.odometry = state_.odometry * measured;
    state_.translationalVelocity = told.x;
    state_.rotationalVelocity = told.theta;
    state_.lateralVelocity = told.y;
    state_.motionData = motionData;
  } catch (const PluginFailure& failure) {
    switchDriveOff(failure);
  }
}

/// Switches the drive off. The robot is stationary from now on unless it is pushed, and odometry
/// reports so.
void SimRobot::switchDriveOff(const std::exception& why) {
  report(now_, std::string(why.what()) + "; it is switched off");
  driveWorks_ = false;
  state_.translationalVelocity = state_.rotationalVelocity = state_.lateralVelocity = 0.0;
  state_.motionData = {};
}

void SimRobot::place(const Pose2& pose) {
  state_.pose = pose;
  state_.velocity = {};
}

}  // namespace ortung
