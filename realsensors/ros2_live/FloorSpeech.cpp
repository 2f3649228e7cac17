#include "FloorSpeech.hpp"

#include <iostream>

#include "NodeMessages.hpp"
#include "ortung/formats/SamplesData.hpp"
#include "ortung/ros2/RobotTopics.hpp"

namespace ortung::ros2 {

void FloorSpeech::tell(const std::string& floor, Participant& node, bool isActive) {
  if (floor != said_ && !floor.empty())
    std::cout << "ortung-ros2: the robot is on floor " << floor << '\n' << std::flush;
  said_ = floor;
  if (floor == told_ || !isActive) return;
  if (!send_) send_ = node.publish("floor", Text::kType, Qos::kLatched);
  send_(cdrOf(Text{floor}));
  told_ = floor;
}

std::optional<ParticleCloud> particlesOn(const std::optional<Floor>& floor,
                                         const SensorContainer& container, const Header& header) {
  const SensorData* const data = container.findExactly({"mcl", "LOCALIZATION", "samples"});
  if (data == nullptr) return std::nullopt;
  ParticleCloud cloud{header, {}};
  double sum = 0.0;
  for (const auto& sample : static_cast<const SamplesData*>(data)->reading()) {
    if (floor && !(sample.pose.x >= floor->xLow && sample.pose.x < floor->xHigh)) continue;
    const Pose2 pose = floor ? floor->fromField(sample.pose) : sample.pose;
    cloud.particles.push_back({fromPose2(pose), sample.weight});
    sum += sample.weight;
  }
  if (cloud.particles.empty() || !(sum > 0.0)) return std::nullopt;  // nothing was weighed yet
  for (Particle& particle : cloud.particles) particle.weight /= sum;
  return cloud;
}

}  // namespace ortung::ros2
