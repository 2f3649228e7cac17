#pragma once

#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// Velocities of a robot, or those it is told to have.
struct Velocities {
  double translational = 0.0;  ///< v_t [m/s]
  double rotational = 0.0;     ///< v_r [rad/s]
};

/// A neural network that says how a robot answers to commands (paper, section 4): (x, y, theta,
/// v_r, v_t) at t1 = t0 + step() from the state and the commanded velocities at t0. Since bases
/// answer late, it also sees the commands of some steps before.
///
/// Layers are full, tanh between them, none behind the last. Inputs: v_t, v_r, then v_t, v_r of
/// each command, the newest first; outputs: what x, y, theta (robot frame at t0), v_t, v_r at t1
/// differ by from those of a robot that keeps its velocities. Both are scaled.
/// Plain data; several threads may call predict() at once.
class ORTUNG_API MotionNetwork {
 public:
  struct Layer {
    std::size_t inputs = 0;
    std::size_t outputs = 0;
    std::vector<double> weights;  ///< row-major, outputs x inputs
    std::vector<double> bias;     ///< by output
  };
  struct Prediction {
    Pose2 change;         ///< of pose over a step, in the robot's old frame
    Velocities velocity;  ///< at its end
  };
  static constexpr std::size_t kOutputs = 5;

  double step = 0.1;              ///< [s], in [0.01, 1]
  std::size_t commands = 4;       ///< newest ones that it sees, in [1, 64]
  bool fromVelocities = false;    ///< in a record, the commands are odometry's velocities; else the
                                  ///< last two words of its motion data
  Velocities limit;               ///< velocities never leave [-limit, limit]
  std::vector<double> inputMean;  ///< by input
  std::vector<double> inputScale;   ///< scaled = (input - mean) * scale
  std::vector<double> outputScale;  ///< output = scaled * scale
  std::vector<Layer> layers;

  std::size_t inputs() const { return 2 + 2 * commands; }
  /// @throws std::invalid_argument saying what has a wrong shape or range, or is no number
  void check() const;

  /// @param given commands, the newest first; at least `commands` of them
  Prediction predict(const Velocities& state, std::span<const Velocities> given) const;
};

/// A robot that moves as a network says: one command a step. Not thread-safe.
class ORTUNG_API NeuralRobot {
 public:
  explicit NeuralRobot(const MotionNetwork& network);
  /// Stands still and always was commanded to.
  void reset(const Velocities& velocity = {});
  /// The next step under @p command: the change of pose in the old frame.
  Pose2 step(const Velocities& command);
  const Velocities& velocity() const { return velocity_; }
  /// Something pushed or held the robot, so that it now moves like this.
  void setVelocity(const Velocities& velocity) { velocity_ = velocity; }

 private:
  const MotionNetwork& network_;
  Velocities velocity_;
  std::vector<Velocities> commands_;  ///< the newest first
};

}  // namespace ortung
