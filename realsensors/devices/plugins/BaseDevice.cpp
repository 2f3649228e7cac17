#include <atomic>
#include <cstdlib>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "ortung/core/Plugin.hpp"
#include "ortung/devices/BaseLines.hpp"
#include "ortung/devices/DeviceClock.hpp"
#include "ortung/devices/DeviceDriver.hpp"
#include "ortung/devices/Port.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"

namespace ortung {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kAnswering{300};
constexpr std::chrono::milliseconds kBetweenCommands{200};
constexpr int kQuestions = 10;
constexpr std::size_t kAtOnce = 1U << 16;  ///< greatest number of bytes of one read()
constexpr double kFastest = 10.0;          ///< greatest velocity that is taken [m/s]
constexpr double kFastestTurn = 20.0;      ///< greatest turn rate that is taken [rad/s]
constexpr std::int64_t kFarthestTime = DeviceClock::kFarthest / 1000;  ///< [ms]

/// What the robot is told, from whatever thread, until the base hears of it.
class BaseVoice : public RobotCommands {
 public:
  void setTranslationalVelocity(double metresPerSecond) override {
    const std::lock_guard lock(mutex_);
    velocity_.translational = checked(metresPerSecond, kFastest);
    isTold_ = true;
  }
  void setRotationalVelocity(double radiansPerSecond) override {
    const std::lock_guard lock(mutex_);
    velocity_.rotational = checked(radiansPerSecond, kFastestTurn);
    isTold_ = true;
  }
  /// Takes a command vector of the kind motion::kVelocities.
  void setMotion(std::span<const double> command) override {
    if (command.size() != 2)
      throw std::invalid_argument("found " + std::to_string(command.size()) +
                                  " numbers, expected the base's translational and rotational "
                                  "velocity");
    const base_lines::Velocity velocity{checked(command[0], kFastest),
                                        checked(command[1], kFastestTurn)};
    const std::lock_guard lock(mutex_);
    velocity_ = velocity;
    isTold_ = true;
  }
  void setManipulator(std::string_view, std::string_view) override {
    throw std::invalid_argument("the base has no manipulator");
  }
  /// Nothing before the first command.
  std::optional<base_lines::Velocity> velocity() const {
    const std::lock_guard lock(mutex_);
    if (!isTold_) return std::nullopt;
    return velocity_;
  }

 private:
  static double checked(double value, double most) {
    if (value >= -most && value <= most) return value;
    throw std::invalid_argument("the base takes velocities of at most " + std::to_string(most));
  }
  mutable std::mutex mutex_;
  base_lines::Velocity velocity_;
  bool isTold_ = false;
};

/// Wheels and sonars behind one line (BaseLines.hpp).
class BaseDevice : public DeviceDriver {
 public:
  explicit BaseDevice(const Parameters& p)
      : name_(p.text("port")),
        baud_(static_cast<int>(p.integerOr("baud", 115200, {1200, 1'000'000}))),
        lines_(base_lines::kLongest) {
    if (!isLineSpeed(baud_)) p.fail("baud", "is no speed of a serial line");
  }

  void serve(std::span<const SensorData* const> features) override {
    for (std::size_t i = 0; i < features.size(); ++i) {
      const Format format = features[i]->format();
      if (format.name() == formats::kCone) {
        sonars_.push_back({i, format.number("max_m")});
      } else if (format.name() == formats::kOdometry && !odometry_) {
        odometry_ = i;
      } else {
        throw std::invalid_argument(toText(features[i]->id()) +
                                    " is neither a sonar nor the only odometry");
      }
    }
  }

  void open() override {
    port_ = Port::open(name_, baud_);
    lines_.clear();
    time_.reset();
    for (int i = 0; i < kQuestions; ++i) {
      port_->write(base_lines::encode(base_lines::Question{}));
      if (const auto identity = answer()) {
        check(*identity);
        return;
      }
    }
    throw DeviceAbsent(name_ + ": nobody who speaks the lines of a base answers at " +
                       std::to_string(baud_) + " baud; " + std::to_string(refused()) +
                       " damaged lines so far");
  }

  void read(std::chrono::milliseconds patience, std::vector<DeviceReading>& readings) override {
    tell();
    std::string bytes;
    if (!port_->read(bytes, patience, kAtOnce)) return;
    lines_.add(bytes);
    while (const auto line = lines_.next()) {
      const auto telegram = base_lines::decode(*line);
      if (!telegram || line->rfind('$') != 0) ++damaged_;  // or something stood before it
      if (!telegram) continue;
      if (const auto* wheels = std::get_if<base_lines::Odometry>(&*telegram)) {
        take(*wheels, readings);
      } else if (const auto* ring = std::get_if<base_lines::Sonars>(&*telegram)) {
        take(*ring, readings);
      }
    }
  }

  /// A base that is asked drops what it has not sent yet. Its answer is not waited for: one that
  /// drops nothing answers behind all of that.
  void refresh() override {
    port_->drop();
    lines_.clear();
    port_->write(base_lines::encode(base_lines::Question{}));
  }
  void close() noexcept override { port_.reset(); }
  std::uint64_t refused() const override { return damaged_ + lines_.refused(); }
  RobotCommands* commands() override { return &voice_; }

 private:
  struct Sonar {
    std::size_t feature;
    double maxRange;
  };

  std::optional<base_lines::Identity> answer() {
    const Clock::time_point end = Clock::now() + kAnswering;
    std::string bytes;
    while (Clock::now() < end) {
      bytes.clear();
      if (!port_->read(bytes, kAnswering)) continue;
      lines_.add(bytes);
      while (const auto line = lines_.next()) {
        const auto telegram = base_lines::decode(*line);
        if (!telegram)
          ++damaged_;
        else if (const auto* identity = std::get_if<base_lines::Identity>(&*telegram))
          return *identity;
      }
    }
    return std::nullopt;
  }

  void check(const base_lines::Identity& identity) const {
    if (identity.version != 1)
      throw DeviceMisfit(name_ + ": speaks version " + std::to_string(identity.version) +
                         " of the lines, expected 1");
    if (identity.sonars < sonars_.size())
      throw DeviceMisfit(name_ + ": has " + std::to_string(identity.sonars) +
                         " sonars, the robot file " + std::to_string(sonars_.size()));
  }

  /// A base that hears nothing stops, so it is told again and again.
  void tell() {
    const auto velocity = voice_.velocity();
    if (!velocity || Clock::now() < nextCommand_) return;
    nextCommand_ = Clock::now() + kBetweenCommands;
    port_->write(base_lines::encode(*velocity));
  }

  /// Of the base's clock, whose 32 bits of milliseconds begin again after 49 days [us].
  Timestamp timeOf(std::uint32_t milliseconds) {
    if (!time_) time_ = milliseconds;
    const auto ahead = static_cast<std::int32_t>(milliseconds - static_cast<std::uint32_t>(*time_));
    time_ = *time_ + ahead;
    // A clock that jumps ahead by weeks, over and over, would count beyond every number.
    if (std::abs(*time_) > kFarthestTime) time_ = milliseconds;
    return *time_ * 1000;
  }

  void take(const base_lines::Odometry& wheels, std::vector<DeviceReading>& readings) {
    if (!odometry_) return;
    OdometryData::Reading reading;
    reading.pose = wheels.pose;
    reading.translationalVelocity = wheels.translationalVelocity;
    reading.rotationalVelocity = wheels.rotationalVelocity;
    reading.lateralVelocity = wheels.lateralVelocity;
    reading.motionData = wheels.motionData;
    readings.push_back({*odometry_, OdometryData::encode(reading), timeOf(wheels.time)});
  }

  void take(const base_lines::Sonars& ring, std::vector<DeviceReading>& readings) {
    const Timestamp time = timeOf(ring.time);
    for (std::size_t i = 0; i < ring.echoes.size(); ++i) {
      const std::size_t number = ring.first + i;
      if (number >= sonars_.size()) continue;
      const Sonar& sonar = sonars_[number];
      const double range = ring.echoes[i] == 0 ? std::numeric_limits<double>::infinity()
                                               : static_cast<double>(ring.echoes[i]) / 1000.0;
      readings.push_back({sonar.feature, {ConeData::encode(range, sonar.maxRange)}, time});
    }
  }

  std::string name_;
  int baud_;
  LineCutter lines_;
  std::unique_ptr<Port> port_;
  std::optional<std::size_t> odometry_;
  std::vector<Sonar> sonars_;
  std::uint64_t damaged_ = 0;
  std::optional<std::int64_t> time_;  ///< newest of the base [ms], counted on beyond 2^32
  BaseVoice voice_;
  Clock::time_point nextCommand_ = Clock::time_point::min();
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("base_device", ortung::provide<ortung::DeviceDriver, ortung::BaseDevice>("base"));
