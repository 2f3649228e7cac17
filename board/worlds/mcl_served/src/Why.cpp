#include "ortung/mcl_served/Why.hpp"

#include <cmath>
#include <utility>

#include "ortung/mcl_served/HeatMap.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostValues = 2048;  // of a feature: beams of any scanner

/// A feature, and what it says at the pose that was asked for.
struct Asked {
  const SensorData* feature = nullptr;
  std::shared_ptr<const Weigher> weigher;
  std::vector<ReadingValue> values;
};

}  // namespace

Why whyAt(const Robot& robot, const std::vector<std::string>& queries, const Pose2& pose) {
  const std::vector<const SensorData*> features = chosenFeatures(robot, queries);
  const auto x = static_cast<float>(pose.x);
  const auto y = static_cast<float>(pose.y);
  const auto theta = static_cast<float>(pose.theta);
  const SampleView one{{&x, 1}, {&y, 1}, {&theta, 1}};
  std::vector<Asked> asked;
  {
    const SensorContainer::ReadLock lock = robot.container.read();
    for (const SensorData* feature : features)
      asked.push_back({feature, feature->weigher(), readingValues(*feature, pose)});
  }
  Why why;
  double sum = 0.0;
  bool any = false;
  for (auto& [feature, weigher, values] : asked) {
    if (weigher) {
      float logProbability = 0.0F;
      weigher->getProbability(one, {&logProbability, 1});
      sum += static_cast<double>(logProbability);
      any = true;
    }
    if (values.size() > kMostValues) values.resize(kMostValues);
    why.features.push_back({feature->id(), weigher ? weigher->getProbability(pose) : kNoExpectation,
                            std::move(values)});
  }
  why.p = any ? std::exp(sum) : kNoExpectation;
  return why;
}

}  // namespace ortung
