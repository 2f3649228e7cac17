// foreign FOLDER  loads the plugin of radar.cpp, which no library here knows, and asks what the
// main job asks of sensors: values beside what is expected, noise that is learned, faults.
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "ortung/base/Random.hpp"
#include "ortung/base/Words.hpp"
#include "ortung/core/PluginFactory.hpp"
#include "ortung/run/ReadingValues.hpp"
#include "ortung/study/Disturbed.hpp"
#include "ortung/study/NoiseLearner.hpp"

using namespace ortung;

namespace {

constexpr double kBeaconX = 1.0;
constexpr double kBeaconY = 0.5;

std::vector<std::uint32_t> echo(const Pose2& pose, double bias) {
  const double dx = kBeaconX - pose.x;
  const double dy = kBeaconY - pose.y;
  return {words::fromMetres(std::hypot(dx, dy) + bias),
          words::fromAngle(std::atan2(dy, dx) - pose.theta)};
}

/// Round and round, with a way of its own of looking about.
Pose2 poseAt(double seconds) {
  return {0.7 * std::cos(0.3 * seconds), 0.6 * std::sin(0.41 * seconds), std::sin(seconds)};
}

bool hasWhy(SensorData& radar) {
  const Pose2 pose{-0.5, 0.2, 0.4};
  radar.setData(1, echo(pose, 0.25));
  const std::vector<ReadingValue> values = readingValues(radar, pose);
  if (values.size() != 2 || values[0].isAngle || !values[1].isAngle) return false;
  return std::abs(*values[0].measured - *values[0].expected - 0.25) < 2e-3 &&
         std::abs(*values[1].measured - *values[1].expected) < 1e-3;
}

bool learnsNoise(SensorData& radar, const FieldRegion& region) {
  const TableInfo info{"hall", "hall-1", "robot", 0.1, region, {}};
  NoiseLog log;
  Random random(5);
  for (double t = 0.0; t < 60.0; t += 0.02) log.reference.emplace_back(fromSeconds(t), poseAt(t));
  for (double t = 1.0; t < 59.0; t += 0.1)
    log.readings[toText(radar.id())].push_back(
        {fromSeconds(t), echo(poseAt(t), 0.1 + 0.03 * random.gaussian())});
  SensorData* const features[] = {&radar};
  const LearnedNoise learned = learnNoise(features, info, {&log, 1}, {});
  const auto& bias = learned.fit.terms[static_cast<std::size_t>(NoiseTerm::kRangeBias)];
  return std::abs(bias.value - 0.1) < 4.0 * bias.error + 1e-3 && bias.error < 0.02;
}

class Repeated : public Source {
 public:
  explicit Repeated(const SensorId& id) : message_{0, id, echo({}, 0.0)} {}
  bool next(Message& message) override {
    message_.stamp += 100'000;
    message = message_;
    return message_.stamp < 100'000'000;
  }

 private:
  Message message_;
};

bool hasFaults(const SensorContainer& robot, const SensorId& id) {
  const auto source =
      disturbed(std::make_unique<Repeated>(id), {parseFault("readings=random:0.5")}, robot, 1);
  int altered = 0;
  for (Message message; source->next(message);) altered += message.words != echo({}, 0.0) ? 1 : 0;
  return altered > 400 && altered < 600;
}

}  // namespace

int main(int, char** arguments) {
  PluginFactory factory({arguments[1]});
  SensorContainer container;
  SensorData& radar = container.add(std::move(factory.makeData("radar", Parameters())[0]));
  FieldRegion region;
  region.grid = {-1.0, -1.0, 0.1, 20, 20};
  region.open.assign(region.grid.size(), 1);
  region.standable = region.open;
  radar.beginLearning(region, 0.1);
  for (std::size_t cell = 0; cell < region.grid.size(); ++cell) {
    const Pose2 pose{region.grid.centreX(cell), region.grid.centreY(cell), 0.0};
    radar.setData(0, echo(pose, 0.0));
    radar.learnProbability(pose);
  }
  radar.endLearning();
  const bool why = hasWhy(radar);
  const bool noise = learnsNoise(radar, region);
  const bool faults = hasFaults(container, radar.id());
  std::printf("%s: why %d, noise %d, faults %d\n", radar.format().toText().c_str(), why, noise,
              faults);
  return why && noise && faults ? 0 : 1;
}
