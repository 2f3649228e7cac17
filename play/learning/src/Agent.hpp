#pragma once

#include <array>
#include <optional>
#include <span>

#include "Observation.hpp"
#include "Settings.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/mcl_player/SelfLocalization.hpp"
#include "ortung/sim/SimRobot.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung::learning {

/// A player that does what somebody who learns says, and tells him what its robot senses. Who owns
/// it is whoever supervises players; it lives as long as its robot.
class Agent : public Player {
 public:
  /// @param robot borrowed
  Agent(const Settings& settings, bool kicks, double speed, const SimRobot& robot);

  bool needsTables() const override { return settings_.sight == Sight::localized; }
  void begin(PlayerSeat& seat) override;
  bool senseAndAct(PlayerSeat& seat) override;

  /// Until the next action. @param action forward, turn, kick @pre finite
  void setAction(std::span<const float> action);
  /// To be called whenever its robot has sensed.
  void look(Timestamp now);
  /// @param out of the size of the environment's observation
  void observe(Timestamp now, double timeLeft, std::span<float> out);

 private:
  struct Seen {
    Timestamp stamp = 0;
    double x = 0.0;  ///< in the goal's frame [m]
    double y = 0.0;
  };

  Pose2 poseAt(Timestamp stamp) const;
  void lookForBall(Timestamp now);
  void lookForOther(Timestamp now);
  void see(Timestamp stamp, double x, double y);
  static void write(const std::optional<Seen>& seen, Timestamp now, ObservationWriter& out);

  const Settings& settings_;
  bool kicks_;
  double speed_;
  const SimRobot& robot_;
  PlayerSeat* seat_ = nullptr;
  const SensorData* ball_ = nullptr;    ///< what its camera sees of it
  const SensorData* others_ = nullptr;  ///< null: it does not look for robots
  std::uint64_t ballSequence_ = 0;
  std::uint64_t othersSequence_ = 0;
  std::array<std::optional<Seen>, kSights> sights_;  ///< the newest first
  std::optional<Seen> other_;
  std::optional<SelfLocalization> self_;
  std::array<float, 3> action_{};
  bool hasNewAction_ = false;
};

}  // namespace ortung::learning
