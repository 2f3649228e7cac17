#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "ortung/motion/MotionNetwork.hpp"

namespace ortung::app {

/// An input of a network and the wanted output; both as MotionNetwork has them.
struct MotionExample {
  std::vector<double> input;
  std::vector<double> output;
};

/// The state of a training.
struct TrainingState {
  std::size_t iteration = 0;
  double loss = 0.0;  ///< mean squared error of the examples; 1: as good as without a network
  double heldOutLoss = 0.0;  ///< mean squared error of the examples that are held out
};

/// Settings of a training.
struct TrainingOptions {
  std::vector<std::size_t> hidden = {24, 24};  ///< widths of the hidden layers
  std::size_t iterations = 300;
  double decay = 1e-4;  ///< weight of the squared weights in the loss
  std::uint64_t seed = 1;
};

/// Trains the layers, means and scales of @p network by L-BFGS (dlib). The result depends on seed
/// and examples only.
/// @param report called repeatedly; ends the training by returning false
void trainNetwork(MotionNetwork& network, const std::vector<MotionExample>& examples,
                  const std::vector<MotionExample>& heldOut, const TrainingOptions& options,
                  const std::function<bool(const TrainingState&)>& report);

/// Computes the loss of the scaled examples and its gradient, whose elements are ordered by layer:
/// weights row-major, then biases.
/// @param slope out: the gradient, of the size of @p parameters; may be nullptr
double lossOf(const std::vector<std::size_t>& widths, const std::vector<double>& parameters,
              const std::vector<MotionExample>& scaled, double decay, std::vector<double>* slope);

}  // namespace ortung::app
