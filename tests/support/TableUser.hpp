#pragma once

#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "ortung/core/SensorContainer.hpp"
#include "ortung/formats/BearingData.hpp"
#include "ortung/formats/ConeData.hpp"
#include "ortung/formats/LandmarksData.hpp"
#include "ortung/formats/PointsData.hpp"
#include "ortung/formats/ScalarData.hpp"
#include "ortung/formats/ScanData.hpp"

/// Whoever uses the tables of tests/data/tables1.ortung, damaged or not.
namespace ortung::test {

/// The features of the file, each with a reading.
inline void fillForTables(SensorContainer& container) {
  constexpr double kQuarter = std::numbers::pi / 2;
  const auto add = [&](std::unique_ptr<SensorData> data, const std::vector<std::uint32_t>& words) {
    container.add(std::move(data)).setData(1, words);
  };
  add(std::make_unique<ScalarData>(SensorId{"cam", "camera", "post1Distance"}, Pose2{},
                                   ScalarData::Config{}),
      {1500});
  add(std::make_unique<BearingData>(SensorId{"cam", "camera", "post1Bearing"}, Pose2{},
                                    BearingData::Config{}),
      {19000});
  add(std::make_unique<LandmarksData>(
          SensorId{"cam", "camera", "posts"}, Pose2{},
          LandmarksData::Config{.identities = {7, 4000000000}, .range = {}}),
      {7, 2000, 9000});
  add(std::make_unique<PointsData>(SensorId{"cam", "camera", "lines"}, Pose2{},
                                   PointsData::Config{.cell = 0.5}),
      {750, 18000});
  add(std::make_unique<ConeData>(SensorId{"Polaroid", "sonar", "front"}, Pose2{},
                                 ConeData::Config{}),
      {800});
  ScanData::Config scan{.beams = 4, .firstAngle = -kQuarter, .angleStep = kQuarter};
  add(std::make_unique<ScanData>(SensorId{"LMS200", "LRF", "rays"}, Pose2{}, scan),
      {1000, 2000, 0, 8001});
  scan.perception = ScanData::Perception::kEndPoints;
  scan.endPointCell = 0.5;
  add(std::make_unique<ScanData>(SensorId{"LMS200", "LRF", "points"}, Pose2{}, scan),
      {0, 750, 0, 8001});
}

/// Weighs poses inside and outside of the field by every feature, one by one and as a set.
/// Returns what is no probability, or "".
inline std::string complaintOfWeighing(const SensorContainer& container) {
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> theta;
  for (int i = 0; i < 24; ++i) {
    x.push_back(-2.0F + 0.7F * static_cast<float>(i % 6));
    y.push_back(-1.5F + static_cast<float>(i / 6));
    theta.push_back(0.9F * static_cast<float>(i));
  }
  std::vector<float> log(x.size(), 0.0F);
  container.getProbability(SampleView{x, y, theta}, log);
  for (const float l : log)
    if (!(l <= 0.0F)) return "ln p is " + std::to_string(l);
  for (std::size_t i = 0; i < x.size(); i += 5) {
    const double p = container.getProbability(Pose2{x[i], y[i], theta[i]});
    if (p != kNoExpectation && !(p >= 0.0 && p <= 1.0)) return "p is " + std::to_string(p);
    for (const auto& data : container.all()) data->expectation({x[i], y[i], theta[i]});
  }
  return "";
}

}  // namespace ortung::test
