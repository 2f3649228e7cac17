#pragma once

#include <memory>
#include <string>

#include "FakeRoom.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/mcl/Mcl.hpp"
#include "ortung/motion/OdometryMotion.hpp"

namespace ortung::test {

/// A robot in a large hall with features that say nothing new about the pose, to see where MCL
/// takes the samples.
struct MovingRobot {
  MovingRobot() {
    container.add(std::make_unique<OdometryData>(SensorId{"base", "odometry", "pose"}));
    for (const std::string name : {"early", "late"}) {
      SensorData& data = container.add(std::make_unique<ScalarData>(
          SensorId{"cam", "camera", name}, Pose2{}, ScalarData::Config{.model = {.sigma = 100}}));
      learnEverywhere(data, region, 1.0, [](const Pose2&) { return ScalarData::encode(1.0); });
    }
  }
  void odometry(double seconds, const OdometryData::Reading& reading) {
    container.set(
        {fromSeconds(seconds), {"base", "odometry", "pose"}, OdometryData::encode(reading)});
  }
  void feature(const std::string& name, double seconds) {
    container.set({fromSeconds(seconds), {"cam", "camera", name}, ScalarData::encode(1.0)});
  }
  std::unique_ptr<Mcl> mcl(const OdometryNoise& noise = {0, 0, 0, 0, 0, 0},
                           std::size_t samples = 600) const {
    MclConfig config;
    config.maxSamples = config.minSamples = samples;
    return mcl(config, noise);
  }
  std::unique_ptr<Mcl> mcl(const MclConfig& config, const OdometryNoise& noise) const {
    return std::make_unique<Mcl>(config, region, std::make_unique<OdometryMotion>(noise));
  }
  const FieldRegion region = Room{20, 20}.region(0.5, 0.2);
  SensorContainer container;
};

}  // namespace ortung::test
