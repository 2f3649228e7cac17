#pragma once

#include <span>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"

namespace ortung {

/// Velocities of a robot, measured or commanded.
struct Velocities {
  double translational = 0.0;  ///< v_t, forwards [m/s]
  double rotational = 0.0;     ///< v_r, counter-clockwise [rad/s]
};

/// A neural network that predicts how a robot answers to commands (paper, section 4): (x, y, theta,
/// v_r, v_t) at t1 = t0 + step from the state and the commanded velocities at t0. Since bases
/// answer with a delay, commands of some earlier steps are inputs, too.
///
/// Layers are fully connected, with tanh between them and none behind the last. Inputs: v_t, v_r,
/// then v_t, v_r of each command, the newest first; outputs: the differences of x, y, theta (robot
/// frame at t0), v_t, v_r at t1 from those of a robot that keeps its velocities. Both are scaled.
/// Plain data; several threads may call predict() at once.
class ORTUNG_API MotionNetwork {
 public:
  struct Layer {
    std::size_t inputs = 0;
    std::size_t outputs = 0;
    std::vector<double> weights;  ///< row-major, outputs x inputs
    std::vector<double> bias;     ///< biases, one for each output
  };
  struct Prediction {
    Pose2 change;         ///< change of pose over a step, in the robot's old frame
    Velocities velocity;  ///< velocities at the end of the step
  };
  static constexpr std::size_t kOutputs = 5;

  double step = 0.1;         ///< time step [s], in [0.01, 1]
  std::size_t commands = 4;  ///< number of newest commands among the inputs, in [1, 64]
  /// Whether the commands in a record are odometry's velocities; else they are the last two words
  /// of its motion data.
  bool fromVelocities = false;
  Velocities limit;                 ///< velocities never leave [-limit, limit]
  std::vector<double> inputMean;    ///< mean of each input
  std::vector<double> inputScale;   ///< scaled = (input - mean) * scale
  std::vector<double> outputScale;  ///< output = scaled * scale
  std::vector<Layer> layers;

  std::size_t inputs() const { return 2 + 2 * commands; }
  /// @throws std::invalid_argument saying what has a wrong shape or range, or is no number
  void check() const;

  /// Predicts one step. @param given commanded velocities, the newest first; at least `commands` of
  /// them
  Prediction predict(const Velocities& state, std::span<const Velocities> given) const;
};

/// A simulated robot that moves as a network predicts, with one command per step. Not thread-safe.
class ORTUNG_API NeuralRobot {
 public:
  /// @param network borrowed
  explicit NeuralRobot(const MotionNetwork& network);
  /// Starts anew with this velocity; all earlier commands count as zero.
  void reset(const Velocities& velocity = {});
  /// Moves by a step under @p command. Returns the change of pose in the robot's old frame.
  Pose2 step(const Velocities& command);
  const Velocities& velocity() const { return velocity_; }
  /// Sets the velocity after something pushed or held the robot.
  void setVelocity(const Velocities& velocity) { velocity_ = velocity; }

 private:
  const MotionNetwork& network_;
  Velocities velocity_;
  std::vector<Velocities> commands_;  ///< commands so far, the newest first
};

}  // namespace ortung
