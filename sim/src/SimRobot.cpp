#include "ortung/sim/SimRobot.hpp"

#include <algorithm>

#include "ortung/container/Formats.hpp"

namespace ortung {
namespace {

// Streams of a robot's random numbers; sensors have those from kFirstSensor on, so that a sensor
// more does not change what the others measure.
constexpr std::uint64_t kOdometryStream = 0;
constexpr std::uint64_t kSlipStream = 1;
constexpr std::uint64_t kFirstSensor = 16;

constexpr const char* kDefaultDrive = "differential";

bool isGroundTruth(const SensorData& data) { return data.id().type == "groundTruth"; }

}  // namespace

struct SimRobot::Mounted {
  std::unique_ptr<Sensor> sensor;
  std::vector<SensorData*> data;
  std::vector<std::uint64_t> seen;  ///< by data: sequence number of the last reading sent
  Random random;
  Timestamp period = 0;
  Timestamp due = 0;
};

SimRobot::SimRobot(const RobotConfig& config, PluginFactory& factory, const Pose2& start,
                   const Random& random, bool noise)
    : config_(config),
      bodyHeight_(config_.drive.numberOr("body_height_m", 0.5, {0.01, 10.0})),
      drive_(factory.make<Drive>(config_.drive.textOr("plugin", kDefaultDrive), config_.drive)),
      odometryRandom_(random.fork(kOdometryStream)),
      slipRandom_(random.fork(kSlipStream)),
      noise_(noise) {
  state_.pose = start;
  const std::vector<Device> devices = fillContainer(container_, config_, factory);
  bool hasTruth = false;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const Device& device = devices[i];
    hasTruth = hasTruth || std::any_of(device.data.begin(), device.data.end(),
                                       [](SensorData* data) { return isGroundTruth(*data); });
    auto sensor = factory.make<Sensor>(device.config->plugin, device.config->parameters);
    const Timestamp period = fromSeconds(sensor->period());
    sensors_.push_back({std::move(sensor), device.data,
                        std::vector<std::uint64_t>(device.data.size(), 0),
                        random.fork(kFirstSensor + i), period, 0});
  }
  if (!hasTruth) truth_ = container_.find(SensorQuery{.type = "groundTruth"});
}

SimRobot::~SimRobot() = default;

std::span<const Message> SimRobot::sense(const World& world, Timestamp now) {
  frame_.clear();
  for (Mounted& mounted : sensors_) {
    if (now < mounted.due) continue;
    // Keeps the rhythm when a period is no multiple of the cycle; one reading a cycle at most.
    mounted.due = std::max(mounted.due + mounted.period, now + 1);
    generate(mounted, world, now);
  }
  if (!frame_.empty()) addGroundTruth(now);
  return frame_;
}

void SimRobot::generate(Mounted& mounted, const World& world, Timestamp now) {
  mounted.sensor->generateData(world, state_, noise_ ? &mounted.random : nullptr, now,
                               mounted.data);
  for (std::size_t i = 0; i < mounted.data.size(); ++i) {
    const SensorData& data = *mounted.data[i];
    if (data.sequence() == mounted.seen[i]) continue;
    mounted.seen[i] = data.sequence();
    const std::span<const std::uint32_t> words = data.getData();
    frame_.push_back({now, data.id(), {words.begin(), words.end()}});
  }
}

void SimRobot::addGroundTruth(Timestamp now) {
  if (truth_ == nullptr) return;
  const std::vector<std::uint32_t> words = PoseData::encode(state_.pose);
  truth_->setData(now, words);
  frame_.push_back({now, truth_->id(), words});
}

Pose2 SimRobot::plan(Timestamp now, double dt) {
  if (driver_) driver_->command(state_.pose, now, *drive_);
  change_ = drive_->relocate(dt, noise_ ? &slipRandom_ : nullptr);
  return state_.pose * change_;
}

void SimRobot::move() {
  state_.pose = state_.pose * change_;
  state_.odometry = state_.odometry * drive_->measure(change_, noise_ ? &odometryRandom_ : nullptr);
  const Twist measured = drive_->measuredVelocity(noise_);
  state_.translationalVelocity = measured.x;
  state_.rotationalVelocity = measured.theta;
  state_.motionData = drive_->motionData();
}

void SimRobot::block() {
  drive_->setVelocity({0.0, 0.0, drive_->velocity().theta});
  change_ = {0.0, 0.0, change_.theta};  // a round body can always turn
  move();
}

}  // namespace ortung
