#include "ortung/motion/MotionNetwork.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ortung {
namespace {

constexpr std::size_t kMostLayers = 8;
constexpr std::size_t kWidest = 512;  // most outputs of a layer
constexpr std::size_t kMostCommands = 64;
constexpr double kLargest = 1e6;    // greatest number of the file
constexpr double kFastest = 100.0;  // limit [m/s], [rad/s]

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

[[noreturn]] void refuse(const std::string& what, const std::string& found,
                         const std::string& expected) {
  throw std::invalid_argument(what + " is " + found + ", expected " + expected);
}

void checkNumbers(const std::string& what, const std::vector<double>& numbers, std::size_t count,
                  bool positive = false) {
  if (numbers.size() != count) {
    refuse(what, std::to_string(numbers.size()) + " numbers", std::to_string(count));
  }
  for (const double number : numbers) {
    if (!(std::abs(number) <= kLargest) || (positive && number <= 0.0)) {
      refuse(what, "not in range", positive ? "numbers above 0" : "finite numbers");
    }
  }
}

Eigen::Map<const Eigen::VectorXd> vectorOf(const std::vector<double>& numbers) {
  return {numbers.data(), static_cast<Eigen::Index>(numbers.size())};
}

Eigen::VectorXd forward(const MotionNetwork& network, const Eigen::VectorXd& input) {
  Eigen::VectorXd signal =
      (input - vectorOf(network.inputMean)).cwiseProduct(vectorOf(network.inputScale));
  for (std::size_t i = 0; i < network.layers.size(); ++i) {
    const MotionNetwork::Layer& layer = network.layers[i];
    const Eigen::Map<const Matrix> weights(layer.weights.data(),
                                           static_cast<Eigen::Index>(layer.outputs),
                                           static_cast<Eigen::Index>(layer.inputs));
    signal = (weights * signal + vectorOf(layer.bias)).eval();
    if (i + 1 < network.layers.size()) signal = signal.array().tanh().matrix().eval();
  }
  return signal.cwiseProduct(vectorOf(network.outputScale));
}

}  // namespace

void MotionNetwork::check() const {
  if (!(step >= 0.01 && step <= 1.0)) refuse("step_s", std::to_string(step), "0.01 to 1");
  if (commands < 1 || commands > kMostCommands) {
    refuse("commands", std::to_string(commands), "1 to " + std::to_string(kMostCommands));
  }
  for (const double most : {limit.translational, limit.rotational}) {
    if (!(most > 0.0 && most <= kFastest))
      refuse("limit", std::to_string(most), "above 0, up to 100");
  }
  checkNumbers("input_mean", inputMean, inputs());
  checkNumbers("input_scale", inputScale, inputs(), true);
  checkNumbers("output_scale", outputScale, kOutputs, true);
  if (layers.empty() || layers.size() > kMostLayers) {
    refuse("layers", std::to_string(layers.size()), "1 to " + std::to_string(kMostLayers));
  }
  std::size_t before = inputs();
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string name = "layer " + std::to_string(i);
    const bool isLast = i + 1 == layers.size();
    if (layers[i].inputs != before) {
      refuse(name, std::to_string(layers[i].inputs) + " inputs wide", std::to_string(before));
    }
    if (layers[i].outputs < 1 || layers[i].outputs > kWidest ||
        (isLast && layers[i].outputs != kOutputs)) {
      refuse(name, std::to_string(layers[i].outputs) + " outputs wide",
             isLast ? std::to_string(kOutputs) : "1 to " + std::to_string(kWidest));
    }
    checkNumbers(name + ": weights", layers[i].weights, layers[i].inputs * layers[i].outputs);
    checkNumbers(name + ": bias", layers[i].bias, layers[i].outputs);
    before = layers[i].outputs;
  }
}

MotionNetwork::Prediction MotionNetwork::predict(const Velocities& state,
                                                 std::span<const Velocities> given) const {
  Eigen::VectorXd input(static_cast<Eigen::Index>(inputs()));
  input[0] = state.translational;
  input[1] = state.rotational;
  for (std::size_t i = 0; i < commands; ++i) {
    const auto at = static_cast<Eigen::Index>(2 + 2 * i);
    input[at] = given[i].translational;
    input[at + 1] = given[i].rotational;
  }
  const Eigen::VectorXd out = forward(*this, input);
  const auto limited = [](double value, double most) { return std::clamp(value, -most, most); };
  const double farthest = limit.translational * step;
  Prediction p;
  p.change = {limited(state.translational * step + out[0], farthest), limited(out[1], farthest),
              wrapAngle(limited(state.rotational * step + out[2], limit.rotational * step))};
  p.velocity = {limited(state.translational + out[3], limit.translational),
                limited(state.rotational + out[4], limit.rotational)};
  return p;
}

NeuralRobot::NeuralRobot(const MotionNetwork& network) : network_(network) { reset(); }

void NeuralRobot::reset(const Velocities& velocity) {
  velocity_ = velocity;
  commands_.assign(network_.commands, Velocities{});
}

Pose2 NeuralRobot::step(const Velocities& command) {
  std::rotate(commands_.rbegin(), commands_.rbegin() + 1, commands_.rend());
  commands_.front() = command;
  const MotionNetwork::Prediction p = network_.predict(velocity_, commands_);
  velocity_ = p.velocity;
  return p.change;
}

}  // namespace ortung
