#include "NetworkTrainer.hpp"

#include <dlib/optimization.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ortung/base/Random.hpp"

// This is the only file that uses dlib.
namespace ortung::app {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = dlib::matrix<double, 0, 1>;

constexpr std::size_t kReportEvery = 25;  // iterations between two reports
constexpr std::size_t kMemory = 20;       // steps that L-BFGS remembers
constexpr double kSmallestSpread = 1e-6;  // least scale of a value

std::size_t parametersOf(const std::vector<std::size_t>& widths) {
  std::size_t n = 0;
  for (std::size_t i = 1; i < widths.size(); ++i) n += widths[i] * (widths[i - 1] + 1);
  return n;
}

/// Examples as matrices with a row for each.
struct Batch {
  Matrix input;
  Matrix output;
};

Batch batchOf(const std::vector<MotionExample>& examples) {
  Batch batch;
  if (examples.empty()) return batch;
  const auto rows = static_cast<Eigen::Index>(examples.size());
  batch.input.resize(rows, static_cast<Eigen::Index>(examples[0].input.size()));
  batch.output.resize(rows, static_cast<Eigen::Index>(examples[0].output.size()));
  for (Eigen::Index i = 0; i < rows; ++i) {
    const MotionExample& example = examples[static_cast<std::size_t>(i)];
    batch.input.row(i) =
        Eigen::Map<const Eigen::RowVectorXd>(example.input.data(), batch.input.cols());
    batch.output.row(i) =
        Eigen::Map<const Eigen::RowVectorXd>(example.output.data(), batch.output.cols());
  }
  return batch;
}

/// The layers within one vector of parameters.
struct LayerView {
  Eigen::Map<const Matrix> weights;
  Eigen::Map<const Eigen::RowVectorXd> bias;
  std::size_t at;
};

std::vector<LayerView> layersOf(const std::vector<std::size_t>& widths, const double* parameters) {
  std::vector<LayerView> layers;
  std::size_t at = 0;
  for (std::size_t i = 1; i < widths.size(); ++i) {
    const auto in = static_cast<Eigen::Index>(widths[i - 1]);
    const auto out = static_cast<Eigen::Index>(widths[i]);
    layers.push_back({{parameters + at, out, in}, {parameters + at + out * in, out}, at});
    at += static_cast<std::size_t>(out * (in + 1));
  }
  return layers;
}

/// Computes the mean squared error and, by back-propagation, its gradient.
double lossOf(const std::vector<std::size_t>& widths, const double* parameters, const Batch& batch,
              double decay, double* slope) {
  const std::vector<LayerView> layers = layersOf(widths, parameters);
  std::vector<Matrix> signals = {batch.input};
  for (std::size_t i = 0; i < layers.size(); ++i) {
    Matrix next = signals.back() * layers[i].weights.transpose();
    next.rowwise() += layers[i].bias;
    if (i + 1 < layers.size()) next = next.array().tanh();
    signals.push_back(std::move(next));
  }
  const double values = static_cast<double>(batch.output.size());
  Matrix error = signals.back() - batch.output;
  double loss = error.squaredNorm() / values;
  for (const LayerView& layer : layers) loss += decay * layer.weights.squaredNorm() / values;
  if (slope == nullptr) return loss;
  error *= 2.0 / values;
  for (std::size_t i = layers.size(); i-- > 0;) {
    const LayerView& layer = layers[i];
    Eigen::Map<Matrix> weightSlope(slope + layer.at, layer.weights.rows(), layer.weights.cols());
    Eigen::Map<Eigen::RowVectorXd> biasSlope(slope + layer.at + layer.weights.size(),
                                             layer.bias.size());
    weightSlope = error.transpose() * signals[i] + (2.0 * decay / values) * layer.weights;
    biasSlope = error.colwise().sum();
    if (i == 0) break;
    error = ((error * layer.weights).array() * (1.0 - signals[i].array().square())).matrix().eval();
  }
  return loss;
}

/// Computes means and scales, so that all values are of similar size.
void findScales(MotionNetwork& network, const std::vector<MotionExample>& examples) {
  const auto moments = [&](auto member, std::size_t k) {
    double mean = 0.0;
    double square = 0.0;
    for (const MotionExample& example : examples) mean += (example.*member)[k];
    mean /= static_cast<double>(examples.size());
    for (const MotionExample& example : examples)
      square += std::pow((example.*member)[k] - mean, 2);
    return std::pair(
        mean, std::max(std::sqrt(square / static_cast<double>(examples.size())), kSmallestSpread));
  };
  network.inputMean.clear();
  network.inputScale.clear();
  network.outputScale.clear();
  for (std::size_t k = 0; k < network.inputs(); ++k) {
    const auto [mean, spread] = moments(&MotionExample::input, k);
    network.inputMean.push_back(mean);
    network.inputScale.push_back(1.0 / spread);
  }
  for (std::size_t k = 0; k < MotionNetwork::kOutputs; ++k) {
    network.outputScale.push_back(moments(&MotionExample::output, k).second);
  }
}

std::vector<MotionExample> scaled(const MotionNetwork& network,
                                  std::vector<MotionExample> examples) {
  for (MotionExample& example : examples) {
    for (std::size_t k = 0; k < example.input.size(); ++k) {
      example.input[k] = (example.input[k] - network.inputMean[k]) * network.inputScale[k];
    }
    for (std::size_t k = 0; k < example.output.size(); ++k)
      example.output[k] /= network.outputScale[k];
  }
  return examples;
}

/// Draws initial weights so small that signals keep their size (Glorot and Bengio, 2010).
Vector startingPoint(const std::vector<std::size_t>& widths, std::uint64_t seed) {
  Vector parameters(static_cast<long>(parametersOf(widths)));
  Random random(seed);
  long at = 0;
  for (std::size_t i = 1; i < widths.size(); ++i) {
    const double reach = std::sqrt(6.0 / static_cast<double>(widths[i - 1] + widths[i]));
    for (std::size_t k = 0; k < widths[i] * widths[i - 1]; ++k)
      parameters(at++) = random.uniform(-reach, reach);
    for (std::size_t k = 0; k < widths[i]; ++k) parameters(at++) = 0.0;
  }
  return parameters;
}

/// Ends the search after the greatest number of steps, or if the loss no longer falls; reports.
class Watch {
 public:
  Watch(std::size_t most, std::function<bool(std::size_t, double, const Vector&)> report)
      : most_(most), report_(std::move(report)) {}
  template <class Point>  // NOLINTNEXTLINE(readability-identifier-naming): dlib's name
  bool should_continue_search(const Point& point, double loss, const Point&) {
    const bool stuck = iteration_ > 0 && std::abs(last_ - loss) < 1e-10 * loss;
    const bool ends = iteration_ >= most_ || stuck || !std::isfinite(loss);
    if (iteration_ % kReportEvery == 0 || ends) {
      if (!report_(iteration_, loss, point)) return false;
    }
    last_ = loss;
    ++iteration_;
    return !ends;
  }

 private:
  std::size_t most_;
  std::size_t iteration_ = 0;
  double last_ = 0.0;
  std::function<bool(std::size_t, double, const Vector&)> report_;
};

void store(MotionNetwork& network, const std::vector<std::size_t>& widths,
           const Vector& parameters) {
  network.layers.clear();
  for (const LayerView& view : layersOf(widths, parameters.begin())) {
    MotionNetwork::Layer layer;
    layer.inputs = static_cast<std::size_t>(view.weights.cols());
    layer.outputs = static_cast<std::size_t>(view.weights.rows());
    layer.weights.assign(view.weights.data(), view.weights.data() + view.weights.size());
    layer.bias.assign(view.bias.data(), view.bias.data() + view.bias.size());
    network.layers.push_back(std::move(layer));
  }
}

}  // namespace

double lossOf(const std::vector<std::size_t>& widths, const std::vector<double>& parameters,
              const std::vector<MotionExample>& examples, double decay,
              std::vector<double>* slope) {
  return lossOf(widths, parameters.data(), batchOf(examples), decay,
                slope ? slope->data() : nullptr);
}

void trainNetwork(MotionNetwork& network, const std::vector<MotionExample>& examples,
                  const std::vector<MotionExample>& heldOut, const TrainingOptions& options,
                  const std::function<bool(const TrainingState&)>& report) {
  if (examples.empty()) throw std::runtime_error("found no examples to train from, expected some");
  findScales(network, examples);
  std::vector<std::size_t> widths = {network.inputs()};
  widths.insert(widths.end(), options.hidden.begin(), options.hidden.end());
  widths.push_back(MotionNetwork::kOutputs);
  const Batch batch = batchOf(scaled(network, examples));
  const Batch other = batchOf(scaled(network, heldOut));
  Vector parameters = startingPoint(widths, options.seed);
  Vector best = parameters;
  const auto loss = [&](const Vector& p) {
    return lossOf(widths, p.begin(), batch, options.decay, nullptr);
  };
  const auto slope = [&](const Vector& p) {
    Vector out(p.size());
    lossOf(widths, p.begin(), batch, options.decay, out.begin());
    return out;
  };
  Watch watch(options.iterations, [&](std::size_t iteration, double value, const Vector& p) {
    best = p;
    const double outside = heldOut.empty() ? 0.0 : lossOf(widths, p.begin(), other, 0.0, nullptr);
    return report({iteration, value, outside});
  });
  dlib::find_min(dlib::lbfgs_search_strategy(kMemory), watch, loss, slope, parameters, -1.0);
  store(network, widths, best);
  network.check();
}

}  // namespace ortung::app
