#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "ortung/motion/MotionNetwork.hpp"

namespace ortung::app {

/// What a network is to say for an input; both as MotionNetwork has them.
struct MotionExample {
  std::vector<double> input;
  std::vector<double> output;
};

/// Where training is.
struct TrainingState {
  std::size_t iteration = 0;
  double loss = 0.0;  ///< mean squared error of the examples, where 1 is as good as no network
  double heldOutLoss = 0.0;  ///< of those held out
};

struct TrainingOptions {
  std::vector<std::size_t> hidden = {24, 24};  ///< widths of the layers between
  std::size_t iterations = 300;
  double decay = 1e-4;  ///< weight of the squared weights in the loss
  std::uint64_t seed = 1;
};

/// Trains the layers, means and scales of @p network by L-BFGS (dlib). Same seed and examples, same
/// network.
/// @param report called now and then; false: ends the training
void trainNetwork(MotionNetwork& network, const std::vector<MotionExample>& examples,
                  const std::vector<MotionExample>& heldOut, const TrainingOptions& options,
                  const std::function<bool(const TrainingState&)>& report);

/// Loss of the scaled examples and its slope along every parameter, layer by layer: weights
/// row-major, then bias.
/// @param slope out, as large as @p parameters; may be nullptr
double lossOf(const std::vector<std::size_t>& widths, const std::vector<double>& parameters,
              const std::vector<MotionExample>& scaled, double decay, std::vector<double>* slope);

}  // namespace ortung::app
