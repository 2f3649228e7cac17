#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Time.hpp"
#include "ortung/ros2/Messages.hpp"

namespace ortung::ros2 {

/// What a robot is told at /cmd_vel, as far as it may follow: nothing that is no number, no more
/// than its limits, and nothing for long after the last command. Thread-safe.
class VelocityCommand {
 public:
  struct Options {
    double mostForward = std::numeric_limits<double>::infinity();  ///< forwards and back [m/s]
    double mostTurn = std::numeric_limits<double>::infinity();     ///< either way [rad/s]
    Timestamp patience = 500'000;  ///< time without a command after which the robot stops [us]
  };
  struct Velocity {
    double forward = 0.0;  ///< [m/s]
    double turn = 0.0;     ///< to the left [rad/s]
    bool operator==(const Velocity&) const = default;
  };
  explicit VelocityCommand(Options options) : options_(options) {}

  // What arrives, as bytes (CDR); not trusted. The newest counts.
  void take(std::string_view twist);
  /// One that was stamped more than `patience` ago, by the robot's clock, is left out.
  void takeStamped(std::string_view twistStamped);

  /// What the robot has to be told, if that is not what it was told last. A clock that goes back
  /// forgets what was commanded.
  /// @param now by the robot's clock
  std::optional<Velocity> due(Timestamp now);

  /// What was left out or cut, in words and how often.
  std::map<std::string, std::uint64_t> leftOut() const;

 private:
  struct Arrived {
    Velocity velocity;
    std::optional<Timestamp> stamp;
  };
  void put(const Twist& twist, std::optional<Timestamp> stamp);
  double within(double value, double most);
  void refuse(const std::string& what);

  const Options options_;
  mutable std::mutex mutex_;
  std::optional<Arrived> arrived_;  ///< that due() has not seen
  Velocity wanted_;
  std::optional<Velocity> told_ = Velocity{};  ///< nothing: not known
  Timestamp since_ = 0;                        ///< when the last command was seen
  std::optional<Timestamp> now_;               ///< when due() was asked last
  std::map<std::string, std::uint64_t> leftOut_;
};

}  // namespace ortung::ros2
