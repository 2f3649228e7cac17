#include "ortung/core/Plugin.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/motion/MotionModel.hpp"

namespace ortung {
namespace {

DeviceData makeGood(const Parameters& p) {
  DeviceData data;
  const auto count = p.integerOr("count", 2, {1, 10});
  for (std::int64_t i = 0; i < count; ++i) {
    data.push_back(std::make_unique<ScalarData>(
        SensorId{"good", "test", "distance" + std::to_string(i)}, Pose2{}, ScalarData::Config{}));
  }
  return data;
}

struct GoodMotion : MotionModel {
  explicit GoodMotion(const Parameters& p) : step(p.numberOr("step_m", 1.0)) {}
  void sampleMotion(const MovableSamples& samples, const Pose2&, std::uint64_t, std::uint64_t,
                    std::uint64_t) const override {
    for (float& x : samples.x) x += static_cast<float>(step);
  }
  double step;
};

}  // namespace
}  // namespace ortung

ORTUNG_PLUGINS("good", ortung::provideData<ortung::makeGood>("good"),
               ortung::provide<ortung::MotionModel, ortung::GoodMotion>("good"));
