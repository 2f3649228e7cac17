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

/// A player that executes the learner's actions and gives it observations of what its robot senses.
/// It is owned by the supervisor of players and lives as long as its robot.
class Agent : public Player {
 public:
  /// @param robot borrowed
  Agent(const Settings& settings, bool kicks, double speed, const SimRobot& robot);

  bool needsTables() const override { return settings_.sight == Sight::kLocalized; }
  void begin(PlayerSeat& seat) override;
  bool senseAndAct(PlayerSeat& seat) override;

  /// Sets the action that holds until the next one. @param action forward, turn, kick @pre finite
  void setAction(std::span<const float> action);
  /// Takes over new readings; to be called whenever its robot has sensed.
  void look(Timestamp now);
  /// Writes the observation. @param timeLeft time until the episode's end [s]
  /// @param out array of the size of the environment's observation
  void observe(Timestamp now, double timeLeft, std::span<float> out);

 private:
  struct Seen {
    Timestamp stamp = 0;
    double x = 0.0;  ///< x in the goal's frame [m]
    double y = 0.0;  ///< y in the goal's frame [m]
  };

  /// MCL's belief at a time.
  struct Believed {
    Timestamp stamp = 0;
    std::optional<PoseEstimate> estimate;
  };

  const std::optional<PoseEstimate>& beliefAt(Timestamp stamp);
  Pose2 poseAt(Timestamp stamp);
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
  std::array<std::optional<Seen>, kSights> sights_;  ///< last sights of the ball, the newest first
  std::optional<Seen> other_;
  std::optional<SelfLocalization> self_;
  std::optional<Believed> believed_;  ///< what was asked last since readings were taken over
  std::array<float, 3> action_{};
  bool hasNewAction_ = false;
};

}  // namespace ortung::learning
