#include "ortung/run/Robot.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "Console.hpp"
#include "DeviceTable.hpp"
#include "EstimatesText.hpp"
#include "Interrupt.hpp"
#include "LocalizationArguments.hpp"
#include "Localizing.hpp"
#include "Outputs.hpp"
#include "Robot.hpp"
#include "Serving.hpp"
#include "ServingArguments.hpp"
#include "SourceArguments.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/core/RobotCommands.hpp"
#include "ortung/devices/DeviceStatusData.hpp"
#include "ortung/devices/DevicesSource.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/mcl_served/LocalizationCommands.hpp"
#include "ortung/mcl_served/LocalizedRobot.hpp"
#include "ortung/records/RecordWriter.hpp"
#include "ortung/run/Feeder.hpp"
#include "ortung/server/RecordedWorld.hpp"
#include "ortung/server/ServedContainer.hpp"

namespace ortung::app {
namespace {

constexpr std::chrono::milliseconds kPatience{200};
constexpr std::chrono::milliseconds kBetweenStatus{500};
constexpr double kOdometryMissing = 1.0;  ///< age from which on users are told [s]
constexpr RobotId kRobot = 1;             // number of the robot for clients

/// The devices as a source that can be stopped, also by a signal.
class Readings : public Source {
 public:
  Readings(DevicesSource& devices, const std::atomic<bool>& isOver)
      : devices_(devices), isOver_(isOver) {}
  ~Readings() override = default;
  bool next(Message& message) override {
    while (true) {
      const bool isLast = isOver_ || interruptSignal() != 0 || devices_.isAtEnd();
      if (isLast) devices_.finish();
      if (auto reading = devices_.poll(kPatience)) {
        message = std::move(*reading);
        return true;
      }
      if (isLast) return false;
    }
  }
  bool isLive() const override { return true; }

 private:
  DevicesSource& devices_;
  const std::atomic<bool>& isOver_;
};

/// A robot that runs: its devices, its container and, if there are tables, its localization.
class RunningRobot {
 public:
  explicit RunningRobot(const RobotArguments& arguments)
      : arguments_(arguments),
        clientRecords_(arguments.serving),
        outputs_(arguments.localization.force),
        devices_({arguments.localization.robot, arguments.dev, arguments.duration}) {
    declareInputs(arguments.localization, outputs_);
    outputs_.writes("--record", arguments.record, OutputKind::kRecord);
    outputs_.writes("--out", arguments.out, OutputKind::kPoses);
    if (!arguments.localization.tables.empty()) {
      LocalizationArguments all = arguments.localization;
      all.publish = true;
      all.source = "devices:" + all.robot.string();
      localization_ = openLocalization(
          all, true, [this](Robot&) { return std::make_unique<Readings>(devices_, isOver_); });
      localized_ = std::make_unique<LocalizedRobot>(localization_);
    } else {
      robot_ = openRobot(arguments.localization.robot);
      readings_ = std::make_unique<Readings>(devices_, isOver_);
      feeder_ = std::make_unique<Feeder>("devices", *readings_, robot_->container);
    }
    addStatus();
    if (!arguments.record.empty()) {
      record_.emplace(outputs_.ready(arguments.record), "", RecordWriter::Pace::kLive);
      feeder().recordInto(*record_);
    }
    feeder().showTo([this](std::span<const Message> moment) {
      clientRecords_.recordings().write(kRobot, moment);
    });
    if (!arguments.out.empty()) poses_.emplace(outputs_.ready(arguments.out));
  }

  SensorContainer& container() {
    return localization_ ? localization_->container() : robot_->container;
  }
  DevicesSource& devices() { return devices_; }
  Recordings& recordings() { return clientRecords_.recordings(); }
  std::string name() const {
    return localization_ ? localization_->robot().config.name : robot_->config.name;
  }
  std::string fingerprint() const {
    return localization_ ? localization_->robot().tables.worldFingerprint : "";
  }

  /// Runs until the end of the devices, a signal or stop().
  void run() {
    writePoses(std::string(kEstimatesHeader));
    std::string text;
    while (localization_ ? localization_->advance() : feeder_->next()) {
      if (!localization_) continue;
      localized_->obey();
      const auto estimate = localization_->update();
      if (!estimate) continue;
      {
        const std::lock_guard lock(mutex_);
        estimate_ = *estimate;
        ++updates_;
      }
      text.clear();
      appendEstimate(*estimate, text);
      writePoses(text);
    }
  }
  void stop() { isOver_ = true; }
  /// The localization for clients; null: it does not localize.
  LocalizedRobot* localized() { return localized_.get(); }

  void commit() {
    if (record_) record_->commit();
    if (poses_) poses_->commit();
  }

  /// Publishes the status of the devices for clients.
  void publishStatus(const std::vector<DeviceStatus>& all) {
    const Timestamp now = devices_.clock()();
    for (std::size_t i = 0; i < all.size(); ++i)
      container().set(DeviceStatusData::message(status_[i], now, all[i]));
  }
  std::optional<PoseEstimate> estimate() const {
    const std::lock_guard lock(mutex_);
    return estimate_;
  }
  /// Returns the time since the newest odometry [s]; nothing: it is not missing, or there was none.
  std::optional<double> withoutOdometry() const {
    if (!localization_) return std::nullopt;
    const SensorContainer& features = localization_->container();
    const SensorContainer::ReadLock lock = features.read();
    for (const auto& data : features.all()) {
      if (data->sequence() == 0 || !isOf(*data, formats::kOdometry)) continue;
      const double age = toSeconds(devices_.clock()() - data->stamp());
      return age > kOdometryMissing ? std::optional(age) : std::nullopt;
    }
    return std::nullopt;
  }
  /// Returns what MCL does without odometry.
  std::string motionWithoutOdometry() const {
    const MclConfig& mcl = localization_->mclConfig();
    return fmt::format("MCL assumes random motion of {:.3g} m and {:.3g} degrees in a second",
                       mcl.driftMetres, degrees(mcl.driftRadians));
  }
  void print() {
    fmt::print("{}", deviceTable(devices_.status(), estimate(), withoutOdometry()));
    if (record_)
      fmt::print("{}: {} readings\n", printable(arguments_.record.string()), record_->messages());
    if (localization_) fmt::print("{} updates of the pose\n", updates_);
  }
  /// @throws std::runtime_error if no device has given a reading, with the reasons
  void needReadings() const {
    std::string missing;
    for (const DeviceStatus& one : devices_.status()) {
      if (one.readings > 0) return;
      missing += fmt::format("{}{} ({}{})", missing.empty() ? "" : ", ", one.name,
                             toText(one.state), one.reason.empty() ? "" : ": " + one.reason);
    }
    throw std::runtime_error(fmt::format("{}: no device gave a reading: {}",
                                         arguments_.localization.robot.string(), missing));
  }
  void warn() const {
    warnOf("the devices", devices_, localization_ ? localization_->feeder() : *feeder_);
  }

 private:
  Feeder& feeder() { return localization_ ? localization_->feeder() : *feeder_; }
  void addStatus() {
    std::size_t number = 0;
    for (const DeviceStatus& one : devices_.status()) {
      const std::string plugin = one.name.substr(0, one.name.find(' '));
      status_.push_back(DeviceStatusData::idOf(number, plugin));
      container().add(std::make_unique<DeviceStatusData>(number++, plugin));
    }
  }
  void writePoses(const std::string& text) {
    if (!poses_) return;
    poses_->write(text);
    poses_->publish();
  }

  const RobotArguments& arguments_;
  ClientRecords clientRecords_;
  Outputs outputs_;
  std::atomic<bool> isOver_ = false;
  DevicesSource devices_;
  std::shared_ptr<Localization> localization_;  ///< localization; without, the next three
  std::unique_ptr<Robot> robot_;
  std::unique_ptr<Readings> readings_;
  std::unique_ptr<Feeder> feeder_;
  std::unique_ptr<LocalizedRobot> localized_;
  std::optional<RecordWriter> record_;
  std::optional<NewFile> poses_;
  std::vector<SensorId> status_;
  mutable std::mutex mutex_;  ///< guards the members that follow
  std::optional<PoseEstimate> estimate_;
  std::size_t updates_ = 0;
};

/// Shows the status of the devices to clients and on the terminal, as a table that is updated; if
/// stderr is not a terminal, as a line for each change.
class Watch {
 public:
  explicit Watch(RunningRobot& robot)
      : robot_(robot),
        isTerminal_(::isatty(STDERR_FILENO) == 1),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

 private:
  void run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      look();
      wake_.wait_for(lock, stop, kBetweenStatus, [] { return false; });
    }
  }
  void look() {
    const std::vector<DeviceStatus> all = robot_.devices().status();
    robot_.publishStatus(all);
    if (isTerminal_) {
      const std::string table = deviceTable(all, robot_.estimate(), robot_.withoutOdometry());
      const std::string up = lines_ == 0 ? "" : fmt::format("\033[{}A", lines_);
      lines_ = static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n'));
      fmt::print(stderr, "{}\033[J{}", up, table);
      return;
    }
    noteOdometry();
    states_.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (states_[i] == all[i].state) continue;
      states_[i] = all[i].state;
      note(fmt::format("{}: {}{}", printable(all[i].name), toText(all[i].state),
                       all[i].reason.empty() ? "" : ", " + printable(all[i].reason)));
    }
  }

  /// Says when odometry begins to be missing, and when it is back.
  void noteOdometry() {
    const std::optional<double> missing = robot_.withoutOdometry();
    if (missing && !missing_)
      note(fmt::format("no odometry for {:.1f} s; {}", *missing, robot_.motionWithoutOdometry()));
    if (!missing && missing_) note(fmt::format("odometry is back after {:.1f} s", *missing_));
    missing_ = missing;
  }

  RunningRobot& robot_;
  bool isTerminal_;
  std::optional<double> missing_;  ///< time without odometry that was said last [s]
  std::size_t lines_ = 0;          ///< number of lines of the table that is shown
  std::vector<std::optional<DeviceState>> states_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  ///< last member: it ends before what it uses
};

void serveRobot(RunningRobot& robot, const ServingArguments& arguments,
                const std::atomic<bool>& isDone) {
  ServedContainer::Config config;
  config.robot = robot.name();
  config.fingerprint = robot.fingerprint();
  config.period = 0.02;
  RobotCommands* const commands = robot.devices().commands();
  if (commands != nullptr)
    config.abilities = {"drive [translational velocity m/s, rotational velocity rad/s]",
                        "motion kind=" + std::string(motion::kVelocities) + " numbers=2"};
  std::vector<BoardCommand> added;
  if (LocalizedRobot* const localized = robot.localized()) {
    added = localizationCommands(*localized);
    config.onWant = [localized](std::span<const SensorId> features) { localized->want(features); };
  }
  ServedContainer world(robot.container(), robot.devices().clock(), config, commands);
  RecordedWorld recorded(world, robot.recordings(), {.takesReadings = false});
  added.push_back(recordCommand(recorded));
  serve(recorded, arguments, std::move(added), [&] { return !isDone; });
}

}  // namespace

int runRobot(const RobotArguments& arguments) {
  const ServingArguments& serving = arguments.serving;
  if (!serving.isServing() && (!serving.control.empty() || !serving.tokens.empty()))
    throw UsageError("--allow-control and --token-file are for --listen and --view");
  if (arguments.localization.tables.empty() && !arguments.out.empty())
    throw UsageError("--out needs --tables: without them there are no poses");
  RunningRobot robot(arguments);
  std::exception_ptr problem;
  std::atomic<bool> isDone = false;
  {
    const Watch watch(robot);
    const std::jthread work([&] {
      try {
        robot.run();
      } catch (...) {
        problem = std::current_exception();
      }
      isDone = true;
    });
    try {
      if (serving.isServing()) serveRobot(robot, serving, isDone);
    } catch (...) {
      robot.stop();
      throw;
    }
  }
  robot.commit();
  if (problem) std::rethrow_exception(problem);
  robot.warn();
  robot.print();
  robot.needReadings();
  return 0;
}

}  // namespace ortung::app
