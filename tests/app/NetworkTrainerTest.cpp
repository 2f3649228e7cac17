#include <gtest/gtest.h>

#include <cmath>

#include "NetworkTrainer.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/robot/MotionNetworkFile.hpp"

namespace ortung::app {
namespace {

std::vector<MotionExample> randomExamples(std::size_t n, std::size_t inputs) {
  Random random(7);
  std::vector<MotionExample> examples(n);
  for (MotionExample& e : examples) {
    for (std::size_t k = 0; k < inputs; ++k) e.input.push_back(random.uniform(-1, 1));
    for (std::size_t k = 0; k < 5; ++k) e.output.push_back(random.uniform(-1, 1));
  }
  return examples;
}

// One layer, one input, one example: prediction 2 * 0.5 + 0.1 = 1.1 where 1.0 is right, others
// right.
TEST(NetworkTrainer, LossAndSlopeAreThoseOfAHand) {
  const std::vector<MotionExample> one = {{{0.5}, {1.0, 0, 0, 0, 0}}};
  const std::vector<double> parameters = {2.0, 0, 0, 0, 0, 0.1, 0, 0, 0, 0};
  std::vector<double> slope(10);
  EXPECT_NEAR(lossOf({1, 5}, parameters, one, 0.0, &slope), 0.1 * 0.1 / 5, 1e-15);
  EXPECT_NEAR(slope[0], 2 * 0.1 * 0.5 / 5, 1e-15);  // d/dw of (w x + b - y)^2 / 5
  EXPECT_NEAR(slope[5], 2 * 0.1 / 5, 1e-15);
  EXPECT_EQ(slope[1], 0.0);
}

TEST(NetworkTrainer, SlopeIsTheQuotientOfDifferences) {
  const std::vector<std::size_t> widths = {4, 6, 3, 5};
  const auto examples = randomExamples(20, 4);
  std::vector<double> parameters;
  Random random(8);
  for (std::size_t i = 0; i < 6 * 5 + 3 * 7 + 5 * 4; ++i)
    parameters.push_back(random.uniform(-1, 1));
  std::vector<double> slope(parameters.size());
  lossOf(widths, parameters, examples, 0.1, &slope);
  constexpr double kStep = 1e-6;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    auto more = parameters;
    auto less = parameters;
    more[i] += kStep;
    less[i] -= kStep;
    const double quotient = (lossOf(widths, more, examples, 0.1, nullptr) -
                             lossOf(widths, less, examples, 0.1, nullptr)) /
                            (2 * kStep);
    EXPECT_NEAR(slope[i], quotient, 1e-7) << i;
  }
}

/// A base that follows commands with a time constant and loses way in curves.
std::vector<MotionExample> base(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<MotionExample> examples;
  for (std::size_t i = 0; i < n; ++i) {
    const double v = random.uniform(0, 0.5), w = random.uniform(-1, 1);
    const double cv = random.uniform(0, 0.5), cw = random.uniform(-1, 1);
    const double dv = 0.3 * (cv * (1 - 0.3 * std::abs(w)) - v), dw = 0.4 * (cw - w);
    examples.push_back({{v, w, cv, cw}, {0.05 * dv, 0.02 * v * w, 0.05 * dw, dv, dw}});
  }
  return examples;
}

TEST(NetworkTrainer, LearnsABaseAndIsTheSameForASeed) {
  MotionNetwork first;
  first.commands = 1;
  first.limit = {1, 2};
  MotionNetwork second = first;
  MotionNetwork other = first;
  TrainingOptions options;
  options.hidden = {16};
  options.iterations = 200;
  double heldOut = 1.0;
  const auto look = [&](const TrainingState& state) {
    heldOut = state.heldOutLoss;
    return true;
  };
  trainNetwork(first, base(1000, 1), base(200, 2), options, look);
  EXPECT_LT(heldOut, 0.01);
  trainNetwork(second, base(1000, 1), {}, options, look);
  EXPECT_EQ(toJson(first), toJson(second));
  options.seed = 2;
  trainNetwork(other, base(1000, 1), {}, options, look);
  EXPECT_NE(toJson(first), toJson(other));
}

TEST(NetworkTrainer, StopsWhenAsked) {
  MotionNetwork network;
  network.commands = 1;
  network.limit = {1, 2};
  std::size_t reports = 0;
  trainNetwork(network, base(100, 1), {}, {}, [&](const TrainingState&) { return ++reports < 2; });
  EXPECT_EQ(reports, 2U);
}

}  // namespace
}  // namespace ortung::app
