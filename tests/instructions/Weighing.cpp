#include <memory>

#include "HotCall.hpp"
#include "SmallField.hpp"
#include "ortung/base/InstructionSet.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung::instructions {
namespace {

constexpr std::size_t kWeighed = 2'000;  // samples

/// Six posts on the field's long sides.
std::shared_ptr<SensorData> learnedLandmarks() {
  LandmarksData::Config config;
  for (std::uint32_t i = 0; i < 6; ++i) config.identities.push_back(i);
  auto feature =
      std::make_shared<LandmarksData>(SensorId{"Hot", "Camera", "Landmarks"}, Pose2{}, config);
  const auto read = [&](const Pose2& pose) {
    LandmarksData::Reading reading;
    for (std::uint32_t i = 0; i < 6; ++i) {
      const double dx = 5.0 * (static_cast<int>(i % 3) - 1) - pose.x;
      const double dy = (i < 3 ? 6.5 : -6.5) - pose.y;
      reading.push_back({i, std::hypot(dx, dy), wrapAngle(std::atan2(dy, dx) - pose.theta)});
    }
    feature->setData(0, LandmarksData::encode(reading));
  };
  const FieldRegion& region = smallRegion();
  feature->beginLearning(region, 2 * bench::kRadiansADegree);
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    if (region.open[cell] == 0) continue;
    const Pose2 pose{region.grid.centreX(cell), region.grid.centreY(cell), 0.0};
    read(pose);
    feature->learnProbability(pose);
  }
  feature->endLearning();
  read(bench::kRobot);
  return feature;
}

void addOne(HotCalls& calls, const char* name, const std::shared_ptr<SensorData>& feature,
            InstructionSet set) {
  const SampleSet samples = samplesOnIt(kWeighed);
  calls.push_back({name, [=] {
                     std::vector<float> logProbability(kWeighed);
                     useInstructionSet(set);
                     feature->getProbability(samples.view(), logProbability);
                     useInstructionSet(std::nullopt);
                   }});
}

}  // namespace

void addWeighing(HotCalls& calls) {
  using enum InstructionSet;
  addOne(calls, "weigh_rays_portable", scannerWith(ScanData::Perception::kRays), kPortable);
  addOne(calls, "weigh_rays", scannerWith(ScanData::Perception::kRays), kAvx2);
  addOne(calls, "weigh_end_points", scannerWith(ScanData::Perception::kEndPoints), kAvx2);
  addOne(calls, "weigh_landmarks", learnedLandmarks(), kAvx2);
}

}  // namespace ortung::instructions
