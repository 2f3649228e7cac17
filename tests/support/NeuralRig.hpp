#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "Files.hpp"
#include "MotionRig.hpp"
#include "ortung/robot/MotionNetworkFile.hpp"

namespace ortung {

/// A network of one layer for steps of 0.1 s, of a base of at most 2 m/s and 3 rad/s.
/// @param weights of (v, w, commanded v and w) for what differs from keeping (v, w), 5 x 4
inline MotionNetwork linearNetwork(std::vector<double> weights, std::vector<double> bias,
                                   bool fromVelocities) {
  MotionNetwork n;
  n.step = 0.1;
  n.commands = 1;
  n.fromVelocities = fromVelocities;
  n.limit = {2.0, 3.0};
  n.inputMean.assign(4, 0.0);
  n.inputScale.assign(4, 1.0);
  n.outputScale.assign(5, 1.0);
  n.layers = {{4, 5, std::move(weights), std::move(bias)}};
  return n;
}

/// Of a base that has the commanded velocity at the end of each step, and drives at it in the step:
/// step * (c - v), nothing, step * (c_w - w), c - v, c_w - w.
inline MotionNetwork obedientNetwork(bool fromVelocities) {
  return linearNetwork({-0.1, 0, 0.1, 0, 0, 0, 0, 0, 0, -0.1, 0, 0.1, -1, 0, 1, 0, 0, -1, 0, 1},
                       {0, 0, 0, 0, 0}, fromVelocities);
}

/// Makes halves of the plugin "neural".
class NeuralRig : public testing::Test {
 protected:
  /// Settings that name a file with @p network.
  std::string settings(const MotionNetwork& network) {
    test::writeBytes(folder_ / "net.json", toJson(network));
    return "network_file = \"" + (folder_ / "net.json").string() + "\"\n";
  }
  test::TemporaryFolder folder_;
};

}  // namespace ortung
