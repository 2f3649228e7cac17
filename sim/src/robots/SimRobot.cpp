#include "ortung/sim/SimRobot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "CheckedDrive.hpp"
#include "MakeSensor.hpp"
#include "ortung/formats/PoseData.hpp"

namespace ortung {
namespace {

// Streams of a robot's random numbers; sensors have those from kFirstSensor on, so that a sensor
// more does not change what the others measure.
constexpr std::uint64_t kOdometryStream = 0;
constexpr std::uint64_t kSlipStream = 1;
constexpr std::uint64_t kFirstSensor = 16;

constexpr const char* kDefaultDrive = "differential";
constexpr std::size_t kMostProblems = 100;

bool isGroundTruth(const SensorData& data) { return data.id().type == "groundTruth"; }

bool isFinite(const Twist& velocity) {
  return std::isfinite(velocity.x) && std::isfinite(velocity.y) && std::isfinite(velocity.theta);
}

/// Whether a drive's change of pose within @p dt [s] is one that the physics can count with.
bool isSane(const Pose2& change, double dt) {
  constexpr double kFastest = 1000.0;  // [m/s], [rad/s]
  return std::abs(change.x) <= kFastest * dt && std::abs(change.y) <= kFastest * dt &&
         std::abs(change.theta) <= kFastest * dt;  // false for NaN
}

/// A velocity in the frame of a robot that faces @p heading.
Twist toRobot(const Twist& inField, double heading) {
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  return {c * inField.x + s * inField.y, c * inField.y - s * inField.x, inField.theta};
}

/// Place of the state that has this name, or else this number.
std::optional<std::size_t> findState(const Manipulator& manipulator, std::string_view state) {
  if (const auto named = manipulator.find(state)) return named;
  for (std::size_t i = 0; i < manipulator.states.size(); ++i)
    if (state == std::to_string(i)) return i;
  return std::nullopt;
}

}  // namespace

struct SimRobot::Mounted {
  std::string plugin;
  std::unique_ptr<Sensor> sensor;  ///< null once it has thrown
  std::vector<SensorData*> data;
  std::vector<std::uint64_t> seen;  ///< by data: sequence number of the last reading sent
  Random random;
  Timestamp period = 0;
  Timestamp due = 0;
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
  drive_ = std::make_unique<CheckedDrive>(factory.make<Drive>(plugin, config_.drive), config_.name);
  state_.pose = start;
  const std::vector<Device> devices = fillContainer(container_, config_, factory);
  extracts_ = std::any_of(devices.begin(), devices.end(),
                          [](const Device& device) { return device.hasExtractor; });
  bool hasTruth = false;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const Device& device = devices[i];
    hasTruth = hasTruth || std::any_of(device.data.begin(), device.data.end(),
                                       [](SensorData* data) { return isGroundTruth(*data); });
    auto sensor = makeSensor(device, factory);
    const Timestamp period = sensor ? fromSeconds(sensor->period()) : 0;
    sensors_.push_back({device.config->plugin, std::move(sensor), device.data,
                        std::vector<std::uint64_t>(device.data.size(), 0),
                        random.fork(kFirstSensor + i), period, 0});
  }
  if (!hasTruth) truth_ = container_.find(SensorQuery{.type = "groundTruth"});
}

SimRobot::~SimRobot() = default;

void SimRobot::report(Timestamp now, const std::string& what) {
  if (problems_.size() < kMostProblems)
    problems_.push_back("robot " + config_.name + " at " + std::to_string(toSeconds(now)) +
                        " s: " + what);
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

std::span<const Message> SimRobot::sense(const World& world, Timestamp now) {
  inFrame_ = 0;
  if (now < nextDue_) return {};
  nextDue_ = std::numeric_limits<Timestamp>::max();
  for (Mounted& mounted : sensors_) {
    if (!mounted.sensor) continue;
    const bool isDue = now >= mounted.due;
    // Keeps the rhythm when a period is no multiple of the cycle; one reading a cycle at most.
    if (isDue) mounted.due = std::max(mounted.due + mounted.period, now + 1);
    nextDue_ = std::min(nextDue_, mounted.due);
    if (!isDue) continue;
    try {
      generate(mounted, world, now);
    } catch (const std::exception& error) {
      mounted.sensor.reset();
      report(now, "the sensor plugin '" + mounted.plugin +
                      "' failed in generateData and is switched off: " + error.what());
    } catch (...) {
      mounted.sensor.reset();
      report(now, "the sensor plugin '" + mounted.plugin +
                      "' failed in generateData and is switched off: it threw no std::exception");
    }
  }
  extract(now);
  if (inFrame_ > 0) addGroundTruth(now);
  return {frame_.data(), inFrame_};
}

Message& SimRobot::nextMessage() {
  if (inFrame_ == frame_.size()) frame_.emplace_back();
  return frame_[inFrame_++];
}

void SimRobot::generate(Mounted& mounted, const World& world, Timestamp now) {
  mounted.sensor->generateData(world, state_, noise_ ? &mounted.random : nullptr, now,
                               mounted.data);
  collect(mounted, now);
}

/// Features that are made of others: after all sensors, whichever order they have.
void SimRobot::extract(Timestamp now) {
  if (!extracts_ || inFrame_ == 0) return;
  try {
    container_.extract();
  } catch (const ExtractorError& error) {
    extracts_ = false;
    report(now, std::string(error.what()) + "; nothing is made of other features any more");
  }
  for (Mounted& mounted : sensors_) collect(mounted, now);
}

/// Messages of what is new.
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

void SimRobot::setTranslationalVelocity(double metresPerSecond) {
  drive_->setTranslationalVelocity(metresPerSecond);
  driver_.reset();
}

void SimRobot::setRotationalVelocity(double radiansPerSecond) {
  drive_->setRotationalVelocity(radiansPerSecond);
  driver_.reset();
}

void SimRobot::setMotion(std::span<const double> command) {
  drive_->setCommand(command);
  driver_.reset();
}

void SimRobot::setManipulator(std::string_view manipulator, std::string_view state) {
  std::string known;
  for (std::size_t i = 0; i < shape_.manipulators.size(); ++i) {
    const Manipulator& one = shape_.manipulators[i];
    known += (known.empty() ? "" : ", ") + one.name;
    if (one.name != manipulator) continue;
    const auto found = findState(one, state);
    if (found) {
      wantedStates_[i] = *found;
      return;
    }
    std::string states;
    for (const ManipulatorState& each : one.states)
      states += (states.empty() ? "" : ", ") + each.name;
    throw std::invalid_argument("robot " + config_.name + ": its manipulator " + one.name +
                                " has no state '" + std::string(state) + "', but " + states);
  }
  throw std::invalid_argument("robot " + config_.name + " has no manipulator '" +
                              std::string(manipulator) + "', but " +
                              (known.empty() ? "none" : known));
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
  if (!driveWorks_) return {};
  try {
    if (driver_) driver_->command(state_.pose, now, *drive_);
    const Pose2 change = drive_->relocate(dt, noise_ ? &slipRandom_ : nullptr);
    if (isSane(change, dt) && isFinite(drive_->velocity())) return planned_ = change;
    report(
        now,
        "its drive gave a motion that is not finite, or faster than 1000 m/s, and is switched off");
  } catch (const std::exception& error) {
    report(now, std::string("its drive failed and is switched off: ") + error.what());
  }
  driveWorks_ = false;
  return planned_ = {};
}

void SimRobot::move(const Pose2& pose, const Twist& velocity, bool wasDisturbed) {
  const Pose2 change = wasDisturbed ? inverse(state_.pose) * pose : planned_;
  state_.pose = pose;
  state_.velocity = velocity;
  if (!driveWorks_) return;
  if (wasDisturbed) drive_->setVelocity(toRobot(velocity, pose.theta));
  const Pose2 measured = drive_->measure(change, noise_ ? &odometryRandom_ : nullptr);
  if (ortung::isFinite(measured)) state_.odometry = state_.odometry * measured;
  const Twist told = drive_->measuredVelocity(noise_);
  state_.translationalVelocity = told.x;
  state_.rotationalVelocity = told.theta;
  state_.lateralVelocity = told.y;
  state_.motionData = drive_->motionData();
}

void SimRobot::place(const Pose2& pose) {
  state_.pose = pose;
  state_.velocity = {};
}

}  // namespace ortung
