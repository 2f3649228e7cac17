// A motion network: read, driven, written and read again.
#include <cmath>

#include "Fuzz.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/robot/MotionNetworkFile.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace ortung;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  fuzz::refusedOrDone<ConfigError>([&] {
    const MotionNetwork network = parseMotionNetwork(text, "network");
    NeuralRobot robot(network);
    for (int i = 0; i < 3; ++i) {
      const Pose2 change = robot.step({0.5 * i, -0.2});
      fuzz::require(isFinite(change));
      fuzz::require(std::abs(robot.velocity().translational) <= network.limit.translational);
      fuzz::require(std::abs(robot.velocity().rotational) <= network.limit.rotational);
    }
    const MotionNetwork again = parseMotionNetwork(toJson(network), "again");
    fuzz::require(again.step == network.step && again.layers.size() == network.layers.size());
  });
  return 0;
}
